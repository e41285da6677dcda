#include "cli/commands.h"
#include "constraints/error.h"

namespace reachlab {

void addExportCommand(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("export", "");
  command->callback([] { throw UsageError("export: not there yet"); });
}

}  // namespace reachlab
