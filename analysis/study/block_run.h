#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/tick_engine.h"
#include "sim/record/configuration/channels.h"
#include "sim/record/log/trial_tracker.h"

namespace reachlab::study {

/// Runs the blocks of virtual subjects on one scene, one after another. Physics and judgement are those of a recorded run on the virtual
/// clock, tick for tick. Without samples, only the hand allocates memory in a trial, when it prepares for it. One thread.
class BlockRun {
 public:
  static constexpr std::uint64_t kSampleEvery = 10;  // [ticks] as recordings have it unless they are asked for more

  /// `withSamples`: keeps the latest trial's rows as a recording has them. `experiments` are the block's scenes, and
  /// outlive this. Throws as compileScene does.
  BlockRun(std::span<const experiment::CompiledExperiment> experiments, bool withSamples);

  /// Begins a block, as a new BlockRun with this hand would. Throws FaultError for a hand that is not virtual or that needs a watch.
  void begin(std::unique_ptr<haptics::HapticDevice> hand);
  /// Runs one trial to its end. Valid until the next call.
  const record::RecordedTrial& runTrial(const trial::PlannedTrial& planned);
  const record::ChannelTable& table() const { return table_; }
  const record::SampleRows& rows() const { return rows_; }  // of the latest trial

 private:
  struct Stages;  // of a tick (sim/haptics/tick_order.h)
  void tick(trial::Command command, const trial::PlannedTrial& planned);
  void keepRow(const haptics::TickState& state);

  std::span<const experiment::CompiledExperiment> experiments_;
  std::vector<dynamics::Scene> scenes_;  // until the first block begins; then the engine has them
  std::unique_ptr<haptics::HapticDevice> hand_;
  std::optional<haptics::TickEngine> engine_;
  record::TrialTracker tracker_;
  haptics::TickInput input_;
  std::vector<record::RecordedEvent> events_;
  std::int32_t trial_ = 0;
  bool withSamples_;
  record::ChannelTable table_;
  record::SampleRows rows_;
};

}  // namespace reachlab::study
