#pragma once
namespace CLI {
class App;
}

namespace reachlab::cli {

/// `reach adaptation`: how fast a person adapts and how much is kept, from a series of trials.
void addAdaptationCommand(CLI::App& app, int& exitCode);

}  // namespace reachlab::cli
