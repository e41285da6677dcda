#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addRunCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("run", "");
  command->callback([] { throw UsageError("run: not there yet"); });
}

}  // namespace reachlab
