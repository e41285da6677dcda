#pragma once
#include <array>
#include <algorithm>
#include <string_view>
#include <utility>

#include "base/fault.h"
#include "sim/session/recorded_run.h"

namespace reachlab::cli {

/// Does something with a request that options gave; what is wrong with it is then told by the option: `trials` as `--trials`, a folder that
/// cannot be written to as `--data`.
template <class Action>
auto withOptionNames(Action&& action) {
  try {
    return std::forward<Action>(action)();
  } catch (const UsageError& error) {
    static constexpr std::array<std::string_view, 11> kOptions{"subject", "session", "trials", "run",    "seed", "day",
                                                               "data",    "device",  "fast",   "resume", "age"};
    std::vector<Fault> faults = faultsOf(error);
    for (Fault& fault : faults)
      if (!fault.place && std::find(kOptions.begin(), kOptions.end(), fault.key) != kOptions.end()) fault.key.insert(0, "--");
    throw FaultError(std::move(faults));
  } catch (const session::DatasetError& error) {
    throw ResourceError(std::string("--data: ") + error.what());
  }
}

}  // namespace reachlab::cli
