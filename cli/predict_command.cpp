#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addPredictCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("predict", "");
  command->callback([] { throw UsageError("predict: not there yet"); });
}

}  // namespace reachlab
