#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addListCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("list", "");
  command->callback([] { throw UsageError("list: not there yet"); });
}

}  // namespace reachlab
