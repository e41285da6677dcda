#pragma once
#include <array>
#include <vector>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// The values of a tick that the recording needs besides its raw input and its row.
struct TickFacts {
  trial::Phase phase = trial::Phase::Idle;
  dynamics::StepStatus status = dynamics::StepStatus::Ok;
  std::int32_t trial = 0;
  bool clamped = false;  // the device gets less force than the object gives
  haptics::DeviceState deviceState = haptics::DeviceState::Off;
  std::uint8_t interventions = 0;  // bits of haptics::intervention
  bool deviceValid = true;         // the first hand's
  bool channelBroken = false;      // in the trial under way
  dynamics::HandSample hip;
  Vec3 couplingForce;         // [N]
  trial::TrialResult result;  // in phase Done
};
TickFacts factsOf(const haptics::TickState& state) noexcept;

/// Follows a run tick by tick and reports its events and the result of each trial. A function of the ticks alone, so that the recorder and
/// a reader of the log get the same trial. One thread.
class TrialTracker {
 public:
  /// Trials are numbered from `firstTrial`. The engine counts them from 1.
  explicit TrialTracker(int firstTrial = 1) : firstTrial_(firstTrial) {}
  /// The position of the next trials in the planned order.
  void announce(const TrialSetup& setup) { setups_.push_back(setup); }

  struct Step {
    bool started = false;   // this tick is the first of a trial
    bool finished = false;  // `trial()` is complete
  };
  /// Appends the events of this tick to `events`.
  Step add(const TickStamp& tick, const TickFacts& facts, std::vector<RecordedEvent>& events);

  /// The trial under way or just finished. Its number is 0 before trial 1.
  const RecordedTrial& trial() const { return trial_; }
  RecordedTrial& trial() { return trial_; }
  bool underWay() const { return underWay_; }
  /// The trial under way if the record breaks off here: interrupted by the program.
  RecordedTrial brokenOff() const;

 private:
  void begin(const TickStamp& tick, std::int32_t number);
  void measure(const TickFacts& facts);
  double meanForce() const noexcept { return moving_ > 0 ? forceSum_ / static_cast<double>(moving_) : 0; }
  void tellGuards(const TickStamp& tick, std::int32_t number, const TickFacts& facts, std::vector<RecordedEvent>& events);

  int firstTrial_;
  std::vector<TrialSetup> setups_;
  RecordedTrial trial_;
  bool underWay_ = false;
  trial::Phase phase_ = trial::Phase::Idle;
  bool clamped_ = false, valid_ = true;
  haptics::DeviceState deviceState_ = haptics::DeviceState::Off;
  std::array<std::uint64_t, haptics::intervention::kCount> lastActive_{};  // tick at which each bit was last set; 0: it is not under way
  bool intervened_ = false;                                                // one of them is under way
  dynamics::StepStatus status_ = dynamics::StepStatus::Ok;
  Vec3 lastPosition_;
  std::int64_t goNs_ = 0;  // clock at the go signal
  double forceSum_ = 0;
  std::uint64_t moving_ = 0;  // ticks of the movement so far
};

}  // namespace reachlab::record
