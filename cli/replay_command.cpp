#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addReplayCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("replay", "");
  command->callback([] { throw UsageError("replay: not there yet"); });
}

}  // namespace reachlab
