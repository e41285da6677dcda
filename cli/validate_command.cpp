#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addValidateCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("validate", "");
  command->callback([] { throw UsageError("validate: not there yet"); });
}

}  // namespace reachlab
