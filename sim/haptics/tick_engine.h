#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/dynamics/hand/hand_path.h"
#include "sim/dynamics/object/end_masses.h"
#include "sim/dynamics/scene.h"
#include "sim/environment/cursor_law.h"
#include "sim/environment/force_field.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/haptics/device.h"
#include "sim/haptics/force_safety.h"
#include "sim/haptics/tick_state.h"
#include "sim/haptics/velocity_estimator.h"
#include "sim/trial/protocol.h"

namespace reachlab::haptics {

/// All that comes from outside in one tick. Logged, and with the configuration enough to compute the run again bit for bit.
struct TickInput {
  std::array<DeviceSample, experiment::kMaxHands> devices;  // of each hand, the first at index 0
  trial::Command command = trial::Command::None;
  trial::PlannedTrial planned;    // of the trial that NextTrial queues
  std::uint32_t missedTicks = 0;  // whole periods that were skipped before this tick
  std::int64_t measuredNs = 0;    // for the record only
  bool deviceFault = false;       // latched on a device; its samples are then not valid
};

struct EngineOptions {
  /// The devices of the hands, the first hand's at index 0. A virtual hand moves by tick count. After a gap it has not moved, so the engine
  /// does not anchor it again. An experiment's force limit lowers the limit of a device that renders force, and replaces that of other devices.
  std::vector<DeviceInfo> hands{DeviceInfo{}};
};
/// Those of the device's hands.
EngineOptions engineOptions(HapticDevice& device);

/// Everything deterministic of one tick, from device sample to device force: estimate the hand, step the object, judge the trial, limit
/// the force. Physics and protocol advance by one tick per tick, whatever the clock did. After a gap of more than kGapTicks the device's
/// force is zero and rises again by a ramp. A real hand has moved in the gap, but the object sees it where it was before. The difference
/// is blended out over kReanchorTicks, so the object feels neither a jump nor a burst.
/// Its state is a pure function of construction and inputs so far. One thread at a time.
/// Where several hands hold the object (experiment::Hand), each has all of this for itself, and one that is lost takes the force from all.
class TickEngine {
 public:
  static constexpr std::uint32_t kGapTicks = 5;
  static constexpr int kReanchorTicks = 250;
  static constexpr int kManyMasses = 32;  // fewer are observed whole at every tick that somebody may look at: it hardly costs more

  /// Throws FaultError without a task, or unless each hand has a device. Throws RefusedError from compileScene.
  TickEngine(const experiment::Experiment& experiment, const EngineOptions& options);
  /// The same, with the constraint that is compiled already.
  TickEngine(const experiment::CompiledExperiment& experiment, const EngineOptions& options);
  /// The same with several scenes. Each trial is done in the scene of its number (PlannedTrial::scene). Throws FaultError where the scenes
  /// cannot share one record (experiment/same_record.h).
  TickEngine(std::span<const experiment::CompiledExperiment> scenes, const EngineOptions& options);
  TickEngine(const experiment::Experiment& experiment, dynamics::Scene scene, const EngineOptions& options);
  TickEngine(std::span<const experiment::CompiledExperiment> experiments, std::vector<dynamics::Scene> scenes,
             const EngineOptions& options);

  /// Two stages of a tick (tick_order.h). `step` estimates the hands, steps the object and judges the trial. `limit` then limits the
  /// forces. Haptic thread: neither allocates, locks, waits nor throws.
  void step(const TickInput& input) noexcept;
  void limit(const TickInput& input) noexcept;
  /// After the latest tick. Before the first tick, the object is at rest at the start.
  const TickState& state() const noexcept { return state_; }
  /// The cue to a virtual hand after the latest tick.
  std::optional<Cue> cue() const noexcept { return cue_; }
  /// Counts that only the loop knows: late ticks, longest gap, dropped records.
  LoopFaults& faults() noexcept { return state_.faults; }

  /// If observing all masses costs far more than a step (EndMasses), it is done only at multiples of `ticks` and where the trial's
  /// verdict needs it. Force, hand and verdict keep the same bits. Before the first tick.
  void setMassesEvery(std::uint32_t ticks) noexcept { massesEvery_ = ticks; }
  /// For runs that nobody watches. Everything is observed only at multiples of `ticks` (0: never). At other ticks the energy is left out
  /// and only the masses that the verdict needs are observed. Force, hand and verdict keep the same bits. Before the first tick.
  void setLookedAtEvery(std::uint32_t ticks) noexcept { lookedAtEvery_ = ticks; }
  /// False after a tick in which the energy and the inner masses may not have been observed.
  bool sawAllMasses() const noexcept { return sawAll_; }

  /// The scenes, for another engine of the same experiments: as good as compiled anew, since an engine begins by putting its object at
  /// rest. This engine is then of no use any more.
  std::vector<dynamics::Scene> takeScenes() &&;

  const dynamics::MethodChoice& choice(std::size_t scene = 0) const { return stages_.at(scene).scene.choice; }
  const constraints::Constraint& constraint() const { return *now_->scene.constraint; }
  /// Of the trial that was queued last.
  const trial::ProtocolSettings& protocol() const { return now_->settings; }

 private:
  /// A scene with its task, ready for a trial.
  struct Stage {
    Stage(const experiment::Experiment& experiment, dynamics::Scene compiled);

    dynamics::Scene scene;
    const dynamics::EndMasses* ends;  // the plant, if it offers them
    bool needsVelocity;               // the plant, of the hand
    std::vector<double> start;        // constraint parameters
    trial::ProtocolSettings settings;
    std::optional<environment::ForceField> field;  // of the only hand
    std::optional<environment::CursorLaw> cursor;  // of the only hand
    Vec3 fpInBody;                                 // [m] from `fixedPoint` to the FP when the object is placed
  };
  /// The state of one hand: its estimate, where it holds the object, and the limits of its device.
  struct Hand {
    Hand(const experiment::Experiment& experiment, const DeviceInfo& device);

    bool virtualHand;
    VelocityEstimator estimator;
    dynamics::HandPath path;
    ForceSafety safety;
    GuardSettings guards;
    bool guarded;  // energy is observed, or a guard may act
    PassivityObserver observer;
    Vec3 fpOffset;           // [m] HIP minus FP at arming, fixed in world axes
    Vec3 anchor;             // [m] the hand after a gap: seen minus true, at the gap
    int anchorTicks = 0;     // left of the blend
    Vec3 lastSeen, lastRaw;  // [m] where the hand was last seen by the coupling, and by the device
    bool broken = false;     // the device gave something that is not finite; until the next trial
    bool lost = true;        // at the tick before
    bool clamped = false;    // at the tick before, by the force limit
  };

  void takeHand(Hand& hand, const DeviceSample& device, std::uint32_t missedTicks, dynamics::HandSample& hip) noexcept;
  void tellSharedHands() noexcept;
  void begin(const experiment::Experiment& experiment, const EngineOptions& options);
  void queueTrial(int scene) noexcept;
  dynamics::StepStatus stepObject() noexcept;
  void observeMasses() noexcept;
  void placeFixedPoints() noexcept;
  bool allValid() const noexcept;
  trial::ProtocolInput protocolInput(const TickInput& input, dynamics::StepStatus status) noexcept;
  void exertCoupling(bool acts) noexcept;
  void exertEnvironment(bool acts) noexcept;
  void limitForce(Hand& hand, HandState& out, bool held, std::uint32_t missedTicks) noexcept;
  Vec3 guardForce(Hand& hand, HandState& out, bool engaged) noexcept;
  DeviceState deviceState(const Hand& hand, const DeviceSample& device, bool fault) const noexcept;

  std::vector<Stage> stages_;  // of every scene, the first at index 0
  Stage* now_ = nullptr;       // of the trial that was queued last
  std::uint32_t massesEvery_ = 1, lookedAtEvery_ = 1;
  bool sawAll_ = true;
  dynamics::MassState judged_;                      // the cursor, where it is judged in place of the hand
  std::vector<Hand> hands_;                         // the first hand at index 0
  std::array<Vec3, experiment::kMaxHands> hips_{};  // [m] raw
  trial::ProtocolState protocol_;
  dynamics::StepStatus forceStatus_ = dynamics::StepStatus::Ok;
  std::optional<Cue> cue_;
  TickState state_;
};

}  // namespace reachlab::haptics
