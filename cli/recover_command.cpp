#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addRecoverCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("recover", "");
  command->callback([] { throw UsageError("recover: not there yet"); });
}

}  // namespace reachlab
