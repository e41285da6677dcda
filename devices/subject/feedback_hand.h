#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "devices/subject/feedback_gains.h"
#include "devices/subject/feedback_subject.h"
#include "devices/subject/model_learner.h"
#include "devices/subject/reach_way.h"
#include "devices/subject/subject_draws.h"
#include "sim/haptics/device.h"

namespace reachlab::devices {

/// What a subject is beyond its kind, and what it has learnt; goes from block to block.
struct SubjectState {
  FeedbackSpec person;  // with what was drawn for this one
  LearntModel model;
};

/// The task as the controller sees it, and what its gains are computed from. Shared by the subjects of an experiment.
struct FeedbackTask {
  ReachWay way;
  predict::LineObject object;
  CostSpec cost;                   // at the task's own duration, with the criterion's weight
  double onTheWayStiffness = 300;  // [N/m] across the way
};

/// A hand that is moved by its arm: what is written is felt, what is shown is seen. Haptic thread: `read` advances the arm by a tick with the
/// force that was written last, held; every tenth tick estimator and controller take a step. Nothing is allocated there.
class FeedbackHand final : public haptics::HapticDevice {
 public:
  FeedbackHand(std::shared_ptr<const FeedbackTask> task, std::shared_ptr<SubjectState> state, std::uint64_t seed);

  haptics::DeviceInfo info() const override;
  void prepareTrial(int index) override;
  void cue(haptics::Cue cue) noexcept override;
  haptics::DeviceSample read() noexcept override;
  void write(const Vec3& force) noexcept override;
  void see(std::span<const dynamics::MassState> masses) noexcept override;

  /// The command that was chosen last [N], before its noise, and the model that it is chosen by; for tests.
  double command() const noexcept { return command_; }
  const ModelError& model() const noexcept { return playing_.used; }
  /// Adds to the force that is felt from now on [N] along the way: a disturbance, for tests.
  void push(double force) noexcept { push_ = force; }

 private:
  struct Reach {
    FeedbackGains gains;
    ModelError used;
    std::vector<double> draws;  // of every step: senses, then two of the command
    int reactionTicks = 0;
    bool ready = false;
  };
  void placeAtStart() noexcept;
  void step() noexcept;
  void learnFromTrace();

  std::shared_ptr<const FeedbackTask> task_;
  std::shared_ptr<SubjectState> state_;
  std::uint64_t seed_;
  SteppedArm arm_;
  Reach prepared_, playing_;
  bool firstIsThere_ = false;  // `playing_` is what trial 0 would be prepared as
  TrialTrace trace_;           // entries below traceSteps_ stay as they are until the next Cue::Place
  std::atomic<int> traceSteps_{0};
  bool going_ = false;
  int ticks_ = 0, steps_ = 0;                  // since the go signal; of the controller
  std::array<double, 4> body_{};               // h, h', f, g
  Vec3 aside_, asideSpeed_, felt_;             // [m], [m/s] across the way; [N]
  double push_ = 0, command_ = 0, noisy_ = 0;  // [N]
  std::vector<double> estimate_, next_, error_, sensed_;
  std::vector<double> touched_, seen_;  // of the last steps, in a ring
  std::vector<double> sight_;           // [m] hand and masses, as shown last
};

/// Prepares the shared part. Throws FaultError, RefusedError.
std::shared_ptr<const FeedbackTask> makeFeedbackTask(const experiment::CompiledExperiment& experiment, const FeedbackSpec& spec);

}  // namespace reachlab::devices
