#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addBenchCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("bench", "");
  command->callback([] { throw UsageError("bench: not there yet"); });
}

}  // namespace reachlab
