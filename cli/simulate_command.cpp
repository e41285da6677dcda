#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addSimulateCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("simulate", "");
  command->callback([] { throw UsageError("simulate: not there yet"); });
}

}  // namespace reachlab
