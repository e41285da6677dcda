#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addConstraintCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("constraint", "");
  command->callback([] { throw UsageError("constraint: not there yet"); });
}

}  // namespace reachlab
