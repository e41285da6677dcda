#pragma once
#include <array>
#include <atomic>
#include <memory>
#include <vector>

#include "sim/experiment/task_plane.h"
#include "sim/subjects/environment_learner.h"
#include "sim/subjects/feedback_gains.h"
#include "sim/subjects/feedback_subject.h"
#include "sim/subjects/model_learner.h"
#include "sim/subjects/prepared_hand.h"
#include "sim/subjects/reach_way.h"
#include "sim/subjects/plans/subject_draws.h"

namespace reachlab::subjects {

/// A subject's properties beyond its kind, and its learnt model. It is passed from block to block.
struct SubjectState {
  FeedbackSpec person;  // with the values drawn for this person
  LearntModel model;
  LearntEnvironment environment;
};

/// The task as the controller sees it, and the data from which its gains are computed. The subjects of an experiment share it.
struct FeedbackTask {
  ReachWay way;
  predict::LineObject object;
  CostSpec cost;                   // at the task's own duration, with the criterion's weight
  double onTheWayStiffness = 300;  // [N/m] across the path
  Vec3 normal{0, 1, 0};            // of the task's plane
  bool bare = false;               // there is no object: a force along the way is one of a field
  bool pushed = false;             // a force may act on the hand: there is no object, or the experiment has an environment
  bool cursor = false;             // the subject sees a cursor and aims with it
};

/// A reach of one trial, prepared before it.
struct FeedbackReach {
  FeedbackGains gains;
  ModelError used;
  EnvironmentModel believed;
  std::vector<double> draws;  // of every step: senses, then two for the command
  int reactionTicks = 0;
  bool ready = false;
};

/// A hand that its arm moves. It feels the written force and sees the shown object. Haptic thread: `read` advances the arm by a tick with
/// the latest written force, which stays constant. At every tenth tick estimator and controller take a step. No call allocates there.
class FeedbackHand final : public PreparedHand<FeedbackReach> {
 public:
  FeedbackHand(std::shared_ptr<const FeedbackTask> task, std::shared_ptr<SubjectState> state, std::uint64_t seed);

  void prepareTrial(int index, int scene = 0) override;
  haptics::DeviceSample read() noexcept override;
  void see(std::span<const dynamics::MassState> masses) noexcept override;

  /// The latest command [N], before its noise. For tests.
  double command() const noexcept { return command_; }
  /// Adds a disturbance [N] along the path to the felt force from now on. For tests.
  void push(double force) noexcept { push_ = force; }

 private:
  void placeAtStart() noexcept override;
  void step() noexcept;
  bool isPushed() const noexcept;
  void learnFromTrace();
  Vec3 aimed(const Vec3& v) const noexcept;

  std::shared_ptr<const FeedbackTask> task_;
  std::shared_ptr<SubjectState> state_;
  std::uint64_t seed_;
  SteppedArm arm_;
  TrialTrace trace_;                            // entries below traceSteps_ keep their values until the next Cue::Place
  EnvironmentTrace errors_;                     // so far
  std::vector<EnvironmentTrace> errorsAtStep_;  // kept as the entries of the trace
  std::atomic<int> traceSteps_{0};
  experiment::PlaneRotation aim_;              // by which the way is turned against the cursor's angle
  int ticks_ = 0, steps_ = 0;                  // since the go signal; steps of the controller
  std::array<double, 4> body_{};               // h, h', f, g
  Vec3 aside_, asideSpeed_;                    // [m], [m/s] across the path
  double push_ = 0, command_ = 0, noisy_ = 0;  // [N]
  double against_ = 0;                         // [N] to the right, against the believed field
  std::vector<double> estimate_, next_, error_, sensed_;
  std::vector<double> touched_, seen_;  // of the last steps, in a ring
  std::vector<double> sight_;           // [m] hand and masses, as shown latest
};

/// Prepares the shared part. Throws FaultError, RefusedError.
std::shared_ptr<const FeedbackTask> makeFeedbackTask(const experiment::CompiledExperiment& experiment, const FeedbackSpec& spec);

}  // namespace reachlab::subjects
