#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/dynamics/shared_plant.h"

namespace reachlab::network {

inline constexpr int kMaxStations = experiment::kMaxHands;
inline constexpr int kMaxCoordinates = 64;  // largest number of coordinates of a shared object in a sample

/// One station's hand and copy at one tick, as the other stations receive them. A plain struct that crosses memory and network unchanged.
struct CopySample {
  std::uint32_t sequence = 0;                             // counts every sent sample; 0: no sample
  double time = 0;                                        // [s] when it was taken, on the reader's clock
  Vec3 hand, handVelocity;                                // [m], [m/s] HIP as the coupling at its station sees it
  double work = 0;                                        // [J] work of this hand on its copy in this trial
  std::array<double, kMaxCoordinates> places{}, rates{};  // generalised coordinates and their rates
};

/// The settings that keep the copies together. The defaults are the design's. A study varies them.
struct CopySettings {
  double frequency = 3;        // [rad/s] omega_o: 3 for chains, whose inner modes hardly lose energy, 1 for other objects
  double loopShare = 0.25;     // omega <= loopShare/(RTT + 3 ms)
  double mostGuessed = 0.06;   // [s] largest extrapolation of a remote hand beyond its newest sample
  double fadeAfter = 0.05;     // [s] silence beyond the usual age until a peer fades
  double fadeDuration = 0.05;  // [s] from holding to lost
  bool ledger = true;          // no copy holds more energy than the hands have put in
  double ledgerTime = 0.05;    // [s] time in which the excess is taken out
  double ledgerMost = 20;      // [1/s] largest damping
};
/// The settings for an experiment's object.
CopySettings copySettingsFor(const experiment::Experiment& experiment);
/// [rad/s] upper limit of omega for every copy over such a link, whatever omega_o is.
double synchronisationLimit(const CopySettings& settings, double roundTrip) noexcept;

/// The state of this copy towards one peer, after a tick.
struct PeerLink {
  bool heard = false;                // some sample has come in this trial
  bool lost = false;                 // silent for too long, until the next trial
  double age = 0;                    // [s] tau of the newest sample
  double usualAge = 0;               // [s] the median of ages on arrival
  double fade = 0;                   // phi: 1 held … 0 let go
  double roundTrip = 0;              // [s] filtered over a second
  double frequency = 0;              // [rad/s] omega now
  double apart = 0;                  // [m] RMS over the masses: this copy at the sample's time against the peer's copy
  double loss = -1;                  // share of unused samples in the latest whole second: lost, or overtaken; -1: not known yet
  std::uint64_t taken = 0, old = 0;  // used samples; samples that were not newer than an earlier sample (duplicates, replays, overtaken)
};

/// One station's full copy of an object that several stations move. The copy is coupled to its station's hand directly, and to every other
/// hand by its latest sample. For station i with coordinates X and peers j, tau is the age of j's newest sample and phi is its fade:
///   remote hand     r_j(t) = r_j + v_j min(tau, mostGuessed), coupled by phi (k_h, b_h)
///   synchronisation M phi (omega^2 (X_j(t_s) - X_i) + 2 omega (X'_j(t_s) - X'_i)) / peers
///   ledger          O = W_i + sum W_j - E(X_i); where O < 0 the copy is damped by min(ledgerMost, -O/(ledgerTime X'MX')) M X'
/// A peer that is silent for longer than its usual age and fadeAfter fades and is then lost. Its hand lets go, and `step` answers PeerLost
/// until the object is placed again. Before its first sample of a trial a peer may take a quarter of a second longer. As a Plant it is the
/// object that this station's hand holds. It is a function of its calls alone. Call `beginTick` and `take` before each step.
class CoupledCopy final : public dynamics::Plant {
 public:
  /// `own` is the hand of the experiment at this station. The peers are the other hands in their order. Throws RefusedError: one hand only,
  /// an object with more coordinates than a sample holds, and the cases that makeSharedPlant refuses.
  CoupledCopy(const experiment::Experiment& experiment, const constraints::Constraint& constraint, int own, const CopySettings& settings);

  int peerCount() const noexcept { return static_cast<int>(peers_.size()); }
  /// The time [s] at the end of the next step, on this station's clock.
  void beginTick(double now) noexcept { now_ = now; }
  /// Takes a sample of a peer. A sample older than the newest is counted and dropped. `roundTrip` [s] is the measured value. A negative
  /// value means unknown.
  void take(int peer, const CopySample& sample, double roundTrip) noexcept;
  /// The peer has broken the trial off. It is lost from the next step on.
  void breakOff(int peer) noexcept;
  /// Sets another omega_o [rad/s]. Call it between trials.
  void setFrequency(double frequency) noexcept;

  const PeerLink& link(int peer) const noexcept { return peers_[static_cast<std::size_t>(peer)].link; }
  bool anyLost() const noexcept;
  /// [J] energy that the hands have put in, as far as this station knows, less the energy of this copy.
  double ledger() const noexcept { return ledger_; }
  int placeCount() const noexcept { return plant_->placeCount(); }
  int rateCount() const noexcept { return plant_->rateCount(); }
  Vec3 ownFixedPoint() const noexcept { return plant_->fixedPoint(0); }
  double ownWork() const noexcept { return plant_->work(0); }
  double objectEnergy() const noexcept { return plant_->objectEnergy(); }
  /// This station's sample for the other stations, after a step. `hand` is the hand as the coupling saw it.
  void fill(CopySample& sample, const dynamics::HandSample& hand) const noexcept;

  int massCount() const noexcept override { return plant_->massCount(); }
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
  static constexpr int kAges = 63;      // number of arrivals in the median
  static constexpr int kHistory = 512;  // ticks of this copy's past
  struct Peer {
    CopySample newest;
    PeerLink link;
    std::array<double, kAges> ages{};
    int ageCount = 0;
    dynamics::HandSample guessed;  // assumed position of its hand at the tick before
    bool held = false;             // `guessed` is of the tick before
    double silentSince = 0;        // [s] begin of the trial, until the first sample is heard
    /// For the second under way.
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
  double now_ = 0;      // [s]
  bool begun_ = false;  // a step was made since the object was placed
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
