#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/dynamics/shared_plant.h"

namespace reachlab::network {

inline constexpr int kMaxStations = experiment::kMaxHands;
inline constexpr int kMaxCoordinates = 64;  // of a shared object: what a sample has room for

/// One station's hand and copy at one tick, as the others get it. Plain; it crosses memory and network as it is.
struct CopySample {
  std::uint32_t sequence = 0;                             // counts up with every sample sent; 0: none
  double time = 0;                                        // [s] when it was taken, on the reader's clock
  Vec3 hand, handVelocity;                                // [m], [m/s] HIP as its own coupling sees it
  double work = 0;                                        // [J] that this hand has done on its own copy in this trial
  std::array<double, kMaxCoordinates> places{}, rates{};  // generalised coordinates and their rates
};

/// What keeps the copies together. The defaults are the design's; a study varies them.
struct CopySettings {
  double frequency = 3;        // [rad/s] omega_o: 3 for chains, whose inner modes hardly lose anything, 1 for other objects
  double loopShare = 0.25;     // omega <= loopShare/(RTT + 3 ms)
  double mostGuessed = 0.06;   // [s] that a remote hand is moved on beyond its newest sample
  double fadeAfter = 0.05;     // [s] of silence beyond the usual age until a peer fades
  double fadeDuration = 0.05;  // [s] from holding to lost
  bool ledger = true;          // no copy holds more energy than the hands have put in
  double ledgerTime = 0.05;    // [s] in which what is too much is taken out
  double ledgerMost = 20;      // [1/s] damping at most
};
/// The settings for an experiment's object.
CopySettings copySettingsFor(const experiment::Experiment& experiment);
/// [rad/s] beyond which no copy is synchronised over such a link, whatever omega_o.
double synchronisationLimit(const CopySettings& settings, double roundTrip) noexcept;

/// How this copy stands to one peer, after a tick.
struct PeerLink {
  bool heard = false;    // some sample has come in this trial
  bool lost = false;     // silent for too long; until the next trial
  double age = 0;        // [s] tau of the newest sample
  double usualAge = 0;   // [s] the median of ages on arrival
  double fade = 0;       // phi: 1 held … 0 let go
  double roundTrip = 0;  // [s] filtered over a second
  double frequency = 0;  // [rad/s] omega now
  double apart = 0;      // [m] RMS over the masses: this copy at the sample's time against the peer's
  double loss = -1;      // share of its samples of the latest whole second that were not used: lost, or overtaken; -1: not known yet
  std::uint64_t taken = 0, old = 0;  // samples used; such that were no newer than one before (duplicates, replays, overtaken)
};

/// One station's full copy of an object that several stations move: its own hand coupled directly, every other by its last sample.
/// With station i's X and peers j, tau the age of j's newest sample and phi its fade:
///   remote hand     r_j(t) = r_j + v_j min(tau, mostGuessed), coupled by phi (k_h, b_h)
///   synchronisation M phi (omega^2 (X_j(t_s) - X_i) + 2 omega (X'_j(t_s) - X'_i)) / peers
///   ledger          O = W_i + sum W_j - E(X_i); where O < 0 the copy is damped by min(ledgerMost, -O/(ledgerTime X'MX')) M X'
/// A peer silent for longer than its usual age and fadeAfter fades and is then lost: its hand lets go, and `step` answers PeerLost from
/// then on, until the object is put up again. Before its first sample of a trial a peer may take a quarter of a second longer.
/// As a Plant it is the object that this station's one hand holds; a function of its calls alone. `beginTick` and `take` before each step.
class CoupledCopy final : public dynamics::Plant {
 public:
  /// `own`: which of the experiment's hands is at this station; the peers are the others in their order. Throws RefusedError: one hand only, an object with more
  /// coordinates than a sample holds, and what makeSharedPlant refuses.
  CoupledCopy(const experiment::Experiment& experiment, const constraints::Constraint& constraint, int own, const CopySettings& settings);

  int peerCount() const noexcept { return static_cast<int>(peers_.size()); }
  /// The time at the end of the step to come [s], on this station's clock.
  void beginTick(double now) noexcept { now_ = now; }
  /// A sample of a peer has come; an older one than the newest is counted and dropped. `roundTrip` [s] as measured; below 0: not known.
  void take(int peer, const CopySample& sample, double roundTrip) noexcept;
  /// That peer has broken the trial off: it is lost from the next step on.
  void breakOff(int peer) noexcept;
  /// Another omega_o [rad/s]: between trials.
  void setFrequency(double frequency) noexcept;
  /// Holds omega where it is: at the end of a trial.
  void freeze(bool frozen) noexcept { frozen_ = frozen; }

  const PeerLink& link(int peer) const noexcept { return peers_[static_cast<std::size_t>(peer)].link; }
  bool anyLost() const noexcept;
  /// [J] what the hands have put in, as far as is known here, less what this copy holds.
  double ledger() const noexcept { return ledger_; }
  int placeCount() const noexcept { return plant_->placeCount(); }
  int rateCount() const noexcept { return plant_->rateCount(); }
  Vec3 ownFixedPoint() const noexcept { return plant_->fixedPoint(0); }
  double ownWork() const noexcept { return plant_->work(0); }
  double objectEnergy() const noexcept { return plant_->objectEnergy(); }
  /// This station as the others get it: after a step. `hand` as the coupling saw it.
  void fill(CopySample& sample, const dynamics::HandSample& hand) const noexcept;

  int massCount() const noexcept override { return plant_->massCount(); }
  void placeAtRest(std::span<const double> q) noexcept override;
  void place(std::span<const double> q, std::span<const double> qRate) noexcept override;
  void setAngularVelocity(const Vec3& velocity) noexcept override { plant_->setAngularVelocity(velocity); }
  void setExtraForce(const Vec3& force) noexcept override { plant_->setExtraForce(force); }
  void setCoupled(bool coupled) noexcept override { plant_->setCoupled(coupled); }
  [[nodiscard]] dynamics::StepStatus step(const dynamics::HandSegment& hand, double dt) noexcept override;
  double lastStepFraction() const noexcept override { return plant_->lastStepFraction(); }
  void restart() noexcept override { plant_->restart(); }
  void observe(const dynamics::HandSample& hand, std::span<dynamics::MassState> masses) const noexcept override {
    plant_->observe(hand, masses);
  }
  Vec3 couplingForce(const dynamics::HandSample& hand) const noexcept override { return plant_->couplingForce(hand); }
  double energy(const dynamics::HandSample& hand) const noexcept override { return plant_->energy(hand); }
  dynamics::BodyState body() const noexcept override { return plant_->body(); }
  std::uint64_t rhsEvaluations() const noexcept override { return plant_->rhsEvaluations(); }
  std::string stopReason() const override { return plant_->stopReason(); }

 private:
  static constexpr int kAges = 63;      // arrivals that the median is of
  static constexpr int kHistory = 512;  // ticks of this copy's own past
  struct Peer {
    CopySample newest;
    PeerLink link;
    std::array<double, kAges> ages{};
    int ageCount = 0;
    dynamics::HandSample guessed;  // where its hand was taken to be at the tick before
    bool held = false;             // `guessed` is of the tick before
    double silentSince = 0;        // [s] when the trial began, where nothing has been heard yet
    /// Of the second under way.
    struct Count {
      double since = 0;                                        // [s]
      std::uint32_t first = 0, last = 0, stride = 0xffffffff;  // sequence numbers; not every tick need be sent
      int came = 0;
    } count;
  };
  void resetPeers() noexcept;
  void noteAge(Peer& peer, double age) noexcept;
  void noteLoss(Peer& peer, std::uint32_t sequence) noexcept;
  void guessHand(Peer& peer, int hand) noexcept;
  void updateLink(Peer& peer, double dt) noexcept;
  void synchronise() noexcept;
  void remember() noexcept;
  double apartAt(const CopySample& sample) const noexcept;

  CopySettings settings_;
  std::unique_ptr<dynamics::SharedPlant> plant_;
  std::vector<Peer> peers_;
  double now_ = 0;  // [s]
  bool frozen_ = false;
  bool begun_ = false;  // a step was made since the object was put up
  double ledger_ = 0;   // [J]
  std::array<double, kMaxCoordinates> push_{}, difference_{};
  struct Past {
    double time = -1;
    std::array<double, kMaxCoordinates> places{};
  };
  std::vector<Past> past_;
  int pastAt_ = 0;
};

}  // namespace reachlab::network
