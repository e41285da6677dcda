#pragma once
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/fault.h"
#include "base/json/json_reader.h"
#include "sim/experiment/patch.h"

namespace reachlab::session {

/// A kind of trial: changes to the block's experiment, after those of the block itself.
struct TrialKind {
  std::string name;
  std::vector<experiment::Patch> changes;
};
/// So many trials of a kind in a row, in one cycle as it is written.
struct KindCount {
  std::string kind;
  int count = 1;
};
/// Targets at equal angles on a circle around the start, in the plane of the task.
struct TargetRing {
  int count = 8;
  double radius = 0.1;      // [m]
  double firstDegrees = 0;  // of target 1 from the right, counterclockwise for a viewer of the plane
};
/// The order of kinds and of targets. ShuffledCycles: shuffled within each cycle. Shuffled: over the whole block.
enum class TrialOrder : std::uint8_t { AsWritten, ShuffledCycles, Shuffled };
const std::vector<std::string>& trialOrderNames();

/// The kinds and targets of a block's trials. A block without kinds and targets does all its trials in one scene.
struct TrialMix {
  std::vector<TrialKind> kinds;
  std::vector<KindCount> cycle;  // key `mix`; empty: each kind once, in the order of `kinds`
  std::optional<TargetRing> ring;
  std::vector<std::vector<double>> targets;  // as task.target; empty: the ring's, or the experiment's own
  TrialOrder order = TrialOrder::AsWritten;
  std::vector<std::string> notFirst;  // kinds that the block does not begin with
  std::vector<std::string> notTwice;  // kinds that do not follow themselves
  bool wayBack = false;               // a trial to the target is followed by one back to the start

  bool isPlain() const { return kinds.empty() && !ring && targets.empty() && !wayBack; }
  int targetCount() const { return ring ? ring->count : targets.empty() ? 1 : static_cast<int>(targets.size()); }
};

/// The cycle, where it is not given each kind once.
std::vector<KindCount> cycleOf(const TrialMix& mix);
/// The kinds that the cycle has, each once, in its order. A block without kinds has one kind without a name.
std::vector<std::string> kindsInUse(const TrialMix& mix);

/// Reads `kinds`, `mix`, `targets`, `order`, `not_first`, `not_twice` and `return`. A key that is missing leaves its member as it is.
void readMix(ObjectReader& reader, TrialMix& mix);
void writeMix(nlohmann::ordered_json& block, const TrialMix& mix);
/// Every fault of a mix of so many trials, each under `key` and its own key.
std::vector<Fault> problems(const TrialMix& mix, int trials, const std::string& key);

}  // namespace reachlab::session
