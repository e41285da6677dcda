#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addAnalyzeCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("analyze", "");
  command->callback([] { throw UsageError("analyze: not there yet"); });
}

}  // namespace reachlab
