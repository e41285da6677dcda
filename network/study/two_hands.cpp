#include "network/study/two_hands.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/math/minimum_jerk.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "network/study/copies_over_lines.h"
#include "network/study/growth.h"
#include "sim/experiment/experiment.h"

namespace reachlab::network {
namespace {

constexpr double kRelaxAt = 6.5, kEnd = 13;  // [s]
constexpr int kTicks = static_cast<int>(kEnd / kTickSeconds + 0.5);
constexpr int kSubsteps = 10;  // of a hand in a tick
constexpr double kStep = kTickSeconds / kSubsteps;
constexpr double kFarAway = 1;  // [m] a hand there has been thrown
// On this line a metre is a unit of phi.
constexpr double kStart = 0;

// Where person h means to be [m]: out together (the second 0.1 s later), back (the first later), a tug of war.
double intended(int h, double t) {
  constexpr double kReach = 0.2, kTug = 0.03, kLate = 0.1;
  const auto reach = [](double since, double duration) {
    return since <= 0 ? 0.0 : since >= duration ? 1.0 : minimumJerk(since / duration);
  };
  double place = kReach * (reach(t - 0.2 - (h == 1 ? kLate : 0), 1.35) - reach(t - 2.4 - (h == 0 ? kLate : 0), 1.0));
  if (t > 4) place += (h == 1 ? -kTug : kTug) * (reach(t - 4, 0.4) - reach(t - 5.2, 0.4));
  return place;
}
double intendedSpeed(int h, double t) {
  constexpr double kNear = 1e-5;
  return (intended(h, t + kNear) - intended(h, t - kNear)) / (2 * kNear);
}

dynamics::HandSegment between(double x0, double v0, double x1, double v1) {
  dynamics::HandSegment segment;
  segment.degree = 1;
  segment.position[0].x = x0, segment.position[1].x = x1 - x0;
  segment.velocity[0].x = v0, segment.velocity[1].x = v1 - v0;
  return segment;
}

/// A person's hand.
struct Body {
  double x = 0, v = 0;              // [m], [m/s] now
  double beforeX = 0, beforeV = 0;  // at the tick before
  double taken = 0;                 // [J] by the force on it

  // One tick under a held force.
  void advance(const StudyHand& hand, int h, double t, double force) {
    beforeX = x, beforeV = v;
    const bool limp = t >= kRelaxAt;
    const double k = limp ? hand.limpStiffness : hand.stiffness, b = limp ? hand.limpDamping : hand.damping;
    for (int i = 0; i < kSubsteps; ++i) {
      const double now = t + i * kStep, was = v;
      const double meant = limp ? 0 : intended(h, now), speed = limp ? 0 : intendedSpeed(h, now);
      v += (k * (meant - x) + b * (speed - v) + force) / hand.mass * kStep;
      const double moved = kStep * 0.5 * (was + v);
      x += moved;
      taken += force * moved;
    }
  }
  dynamics::HandSegment segment() const { return between(beforeX, beforeV, x, v); }
  dynamics::HandSample sample() const { return {{x, 0, 0}, {v, 0, 0}, true}; }
};
using Bodies = std::array<Body, 2>;

using Plant = std::unique_ptr<dynamics::SharedPlant>;
using Coordinates = std::vector<double>;

// Held by these hands alone, in this order, with masses and springs scaled.
Plant makePlant(const experiment::Experiment& experiment, const std::vector<int>& hands, double scale) {
  experiment::Experiment e = experiment;
  e.hands.clear();
  for (const int hand : hands) e.hands.push_back(experiment.hands[static_cast<std::size_t>(hand)]);
  for (double& mass : e.object.masses) mass *= scale;
  if (e.object.kind != experiment::ObjectKind::Parallel)
    for (auto* springs : {&e.object.stiffness, &e.object.damping})
      for (double& value : *springs) value *= scale;
  e.object.viscosity *= scale;
  Plant plant = dynamics::makeSharedPlant(e, constraints::makeConstraint(e.constraint));
  plant->placeAtRest(std::array{kStart});
  return plant;
}
Coordinates copyOf(std::span<const double> numbers) { return {numbers.begin(), numbers.end()}; }

/// One way of coupling, tick by tick.
class Stations {
 public:
  virtual ~Stations() = default;
  /// One tick that ends at `now`; the bodies are where they are then.
  virtual void tick(const Bodies& bodies, double now) = 0;
  /// Each station's object as its person sees it.
  virtual Coordinates places(int station) const = 0;
  virtual double speedSquares() const = 0;  // sum over both objects' masses [m^2/s^2]
  /// [J] the most that a copy holds above what the hands have put in.
  virtual double aboveLedger() const { return 0; }

  std::array<double, 2> force{};  // [N] on each hand, from this tick to the next

 protected:
  static double squares(std::span<const double> rates) {
    double sum = 0;
    for (const double rate : rates) sum += rate * rate;
    return sum;
  }
};

class OneSimulation final : public Stations {
 public:
  explicit OneSimulation(const StudySetup& setup) : plant_(makePlant(setup.experiment, {0, 1}, 1)) {}
  void tick(const Bodies& bodies, double) override {
    plant_->setHand(1, bodies[1].segment(), bodies[1].sample());
    (void)plant_->step(bodies[0].segment(), kTickSeconds);
    for (int h = 0; h < 2; ++h) force[static_cast<std::size_t>(h)] = -plant_->couplingForceOf(h).x;
  }
  Coordinates places(int) const override { return copyOf(plant_->places()); }
  double speedSquares() const override { return 2 * squares(plant_->rates()); }

 private:
  Plant plant_;
};

LineConditions conditionsOf(const StudySetup& setup) {
  constexpr double kLeastJitter = 0.0005;  // [s]
  const double delay = setup.roundTrip / 2;
  return {delay, setup.jitterShare * delay + (setup.roundTrip > 0 ? kLeastJitter : 0), setup.loss};
}

/// What the rivals send; each uses what it needs.
struct Packet {
  double time = 0;  // [s]
  double x = 0, v = 0, force = 0;
  Coordinates places, rates, wave;
};

/// The newest packet that has come to a station.
class Inbox {
 public:
  Inbox(const StudySetup& setup, int station) : line_(conditionsOf(setup), 2 * setup.seed + static_cast<std::uint64_t>(station)) {}
  void send(const Packet& packet) { line_.send(packet, packet.time); }
  void receive(double now) {
    fresh = false;
    line_.receive(now, [&](const Packet& packet) {
      if (any && packet.time <= newest.time) return;
      newest = packet;
      any = fresh = true;
    });
  }
  Packet newest;
  bool any = false, fresh = false;

 private:
  SimulatedLine<Packet> line_;
};

class Server final : public Stations {
 public:
  Server(const StudySetup& setup, bool sendsForce)
      : sendsForce_(sendsForce), plant_(makePlant(setup.experiment, {0, 1}, 1)), springs_(dynamics::handSpringsOf(setup.experiment)[1]),
        toServer_(setup, 0), toClient_(setup, 1) {
    toClient_.newest.places = copyOf(plant_->places());
    toClient_.newest.rates = copyOf(plant_->rates());
  }
  void tick(const Bodies& bodies, double now) override {
    toServer_.send({now, bodies[1].x, bodies[1].v, 0, {}, {}, {}});
    toServer_.receive(now);
    const Packet& hand = toServer_.newest;
    plant_->setHand(1, between(heldX_, heldV_, hand.x, hand.v), {{hand.x, 0, 0}, {hand.v, 0, 0}, true});
    heldX_ = hand.x, heldV_ = hand.v;
    (void)plant_->step(bodies[0].segment(), kTickSeconds);
    force[0] = -plant_->couplingForceOf(0).x;
    toClient_.send({now, 0, 0, -plant_->couplingForceOf(1).x, copyOf(plant_->places()), copyOf(plant_->rates()), {}});
    toClient_.receive(now);
    if (toClient_.any) force[1] = sendsForce_ ? toClient_.newest.force : -forceAtClient(bodies[1]);
  }
  Coordinates places(int station) const override { return station == 0 ? copyOf(plant_->places()) : toClient_.newest.places; }
  double speedSquares() const override { return squares(plant_->rates()) + squares(toClient_.newest.rates); }

 private:
  double forceAtClient(const Body& body) const {
    double sum = 0;
    for (std::size_t i = 0; i < springs_.stiffness.size(); ++i)
      sum += springs_.stiffness[i] * (body.x - toClient_.newest.places[i]) + springs_.damping[i] * (body.v - toClient_.newest.rates[i]);
    return sum;
  }
  bool sendsForce_;
  Plant plant_;
  dynamics::HandSprings springs_;
  Inbox toServer_, toClient_;
  double heldX_ = 0, heldV_ = 0;
};

/// The shipped copies, by whatever settings.
class Copies final : public Stations {
 public:
  Copies(const StudySetup& setup, const CopySettings& settings)
      : copies_(setup.experiment, constraints::makeConstraint(setup.experiment.constraint), std::array{kStart}, settings,
                conditionsOf(setup), setup.roundTrip, setup.seed) {}
  void tick(const Bodies& bodies, double now) override {
    const std::array hands{bodies[0].segment(), bodies[1].segment()};
    const std::array ends{bodies[0].sample(), bodies[1].sample()};
    copies_.tick(hands, ends, now);
    for (int h = 0; h < 2; ++h) force[static_cast<std::size_t>(h)] = -copies_.copy(h).couplingForce(ends[static_cast<std::size_t>(h)]).x;
  }
  Coordinates places(int station) const override {
    const CopySample& sample = copies_.sample(station);
    return {sample.places.begin(), sample.places.begin() + copies_.copy(0).massCount()};
  }
  double speedSquares() const override { return copies_.speedSquares(); }
  double aboveLedger() const override { return copies_.aboveLedger(); }

 private:
  CopiesOverLines copies_;
};

/// Copies of half the mass, each held by its own hand, joined over the line.
class HalfCopies final : public Stations {
 public:
  HalfCopies(const StudySetup& setup, Coupling coupling) : coupling_(coupling) {
    constexpr double kGain = 0.5, kLeastLoop = 0.002, kTicksAtBothEnds = 0.003, kFastest = 60;
    omega_ = std::min(kGain / std::max(kLeastLoop, setup.roundTrip + kTicksAtBothEnds), kFastest);
    for (int h = 0; h < 2; ++h) {
      plants_.push_back(makePlant(setup.experiment, {h}, 0.5));
      inboxes_.emplace_back(setup, h);
      const auto count = plants_.back()->places().size();
      set_.push_back(copyOf(plants_.back()->places()));
      wave_.emplace_back(count);
      heardWave_.emplace_back(count);
    }
    for (const double mass : setup.experiment.object.masses) masses_.push_back(0.5 * mass);
  }
  void tick(const Bodies& bodies, double now) override {
    for (std::size_t h = 0; h < 2; ++h) {
      inboxes_[h].receive(now);
      // A wave that did not come is none.
      if (coupling_ == Coupling::HalfWaves)
        for (std::size_t i = 0; i < masses_.size(); ++i) heardWave_[h][i] = inboxes_[h].fresh ? inboxes_[h].newest.wave[i] : 0;
      Coordinates push(masses_.size());
      if (inboxes_[h].any) {
        if (coupling_ == Coupling::HalfDelayed) pushByDelayed(h, push);
        if (coupling_ == Coupling::HalfProjected) pushByProjection(h, push);
        if (coupling_ == Coupling::HalfWaves) pushByWaves(h, push);
      }
      plants_[h]->setExtraAcceleration(push);
      (void)plants_[h]->step(bodies[h].segment(), kTickSeconds);
      force[h] = -plants_[h]->couplingForceOf(0).x;
    }
    for (std::size_t h = 0; h < 2; ++h)
      inboxes_[1 - h].send({now, 0, 0, 0, copyOf(plants_[h]->places()), copyOf(plants_[h]->rates()), wave_[h]});
  }
  Coordinates places(int station) const override { return copyOf(plants_[static_cast<std::size_t>(station)]->places()); }
  double speedSquares() const override { return squares(plants_[0]->rates()) + squares(plants_[1]->rates()); }

 private:
  void pushByDelayed(std::size_t h, Coordinates& push) {
    const Packet& other = inboxes_[h].newest;
    for (std::size_t i = 0; i < push.size(); ++i)
      push[i] = omega_ * omega_ * (other.places[i] - plants_[h]->places()[i]) + 2 * omega_ * (other.rates[i] - plants_[h]->rates()[i]);
  }
  double springEnergy(std::size_t h, const Coordinates& set) const {
    double sum = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
      const double stretch = set[i] - plants_[h]->places()[i];
      sum += 0.5 * masses_[i] * omega_ * omega_ * stretch * stretch;
    }
    return sum;
  }
  // Passive set-position modulation: the set place moves as far towards what was heard as the pool pays for.
  void pushByProjection(std::size_t h, Coordinates& push) {
    constexpr double kPoolMost = 2;  // [J]
    const Packet& other = inboxes_[h].newest;
    const double before = springEnergy(h, set_[h]);
    const auto moved = [&](double share) {
      Coordinates set = set_[h];
      for (std::size_t i = 0; i < set.size(); ++i) set[i] += share * (other.places[i] - set[i]);
      return set;
    };
    double share = 1;
    if (springEnergy(h, other.places) - before > pool_[h]) {
      double least = 0, most = 1;
      for (int round = 0; round < 20; ++round) {
        const double middle = 0.5 * (least + most);
        (springEnergy(h, moved(middle)) - before <= pool_[h] ? least : most) = middle;
      }
      share = least;
    }
    set_[h] = moved(share);
    pool_[h] -= springEnergy(h, set_[h]) - before;
    for (std::size_t i = 0; i < push.size(); ++i) {
      const double rate = plants_[h]->rates()[i];
      push[i] = omega_ * omega_ * (set_[h][i] - plants_[h]->places()[i]) - 2 * omega_ * rate;
      pool_[h] += 2 * masses_[i] * omega_ * rate * rate * kTickSeconds;
    }
    pool_[h] = std::min(pool_[h], kPoolMost);
  }
  void pushByWaves(std::size_t h, Coordinates& push) {
    for (std::size_t i = 0; i < push.size(); ++i) {
      const double b = masses_[i] * omega_, rate = plants_[h]->rates()[i], heard = heardWave_[h][i];
      push[i] = (std::sqrt(2 * b) * heard - b * rate) / masses_[i];
      wave_[h][i] = std::sqrt(2 * b) * rate - heard;
    }
  }

  Coupling coupling_;
  double omega_ = 0;  // [rad/s]
  std::vector<Plant> plants_;
  std::vector<Inbox> inboxes_;
  Coordinates masses_;
  std::vector<Coordinates> set_, wave_, heardWave_;
  std::array<double, 2> pool_{};  // [J]
};

std::unique_ptr<Stations> makeStations(const StudySetup& setup, Coupling coupling, const CopySettings& settings) {
  CopySettings alone = settings;
  alone.frequency = 0;
  alone.ledger = false;
  switch (coupling) {
    case Coupling::ServerForce: return std::make_unique<Server>(setup, true);
    case Coupling::ServerPlace: return std::make_unique<Server>(setup, false);
    case Coupling::CopiesHeld: alone.mostGuessed = 0; return std::make_unique<Copies>(setup, alone);
    case Coupling::CopiesGuessed: return std::make_unique<Copies>(setup, alone);
    case Coupling::Design: return std::make_unique<Copies>(setup, settings);
    case Coupling::HalfDelayed:
    case Coupling::HalfProjected:
    case Coupling::HalfWaves: break;
  }
  return std::make_unique<HalfCopies>(setup, coupling);
}

// Runs to the end, or until `look` says that it has gone far enough. Returns the growth.
double conduct(const StudySetup& setup, Stations& stations, const std::function<bool(int k, double t, const Bodies&)>& look) {
  Bodies bodies;
  Growth growth(kRelaxAt, kEnd);
  for (int k = 0; k < kTicks; ++k) {
    const double begin = secondsOf(k);
    for (int h = 0; h < 2; ++h)
      bodies[static_cast<std::size_t>(h)].advance(setup.hand, h, begin, stations.force[static_cast<std::size_t>(h)]);
    const double t = secondsOf(k + 1);
    stations.tick(bodies, t);
    growth.add(t, stations.speedSquares() + bodies[0].v * bodies[0].v + bodies[1].v * bodies[1].v);
    if (!look(k, t, bodies)) return std::numeric_limits<double>::infinity();
  }
  return growth.ratio();
}

bool isThrown(const Bodies& bodies) { return !(std::max(std::abs(bodies[0].x), std::abs(bodies[1].x)) < kFarAway); }

}  // namespace

std::string_view nameOf(Coupling coupling) {
  switch (coupling) {
    case Coupling::ServerForce: return "server-force";
    case Coupling::ServerPlace: return "server-place";
    case Coupling::CopiesHeld: return "copies-held";
    case Coupling::CopiesGuessed: return "copies-guessed";
    case Coupling::Design: return "design";
    case Coupling::HalfDelayed: return "half-delayed";
    case Coupling::HalfProjected: return "half-projected";
    case Coupling::HalfWaves: return "half-waves";
  }
  return "";
}

std::string_view describe(Coupling coupling) {
  switch (coupling) {
    case Coupling::ServerForce: return "server, force sent back";
    case Coupling::ServerPlace: return "server, places sent back, k_h at the client";
    case Coupling::CopiesHeld: return "copies, remote hand held";
    case Coupling::CopiesGuessed: return "copies, remote hand dead-reckoned";
    case Coupling::Design: return "this design";
    case Coupling::HalfDelayed: return "half-mass copies, delayed PD";
    case Coupling::HalfProjected: return "half-mass copies, PSPM";
    case Coupling::HalfWaves: return "half-mass copies, wave variables";
  }
  return "";
}

StudyReference makeReference(const StudySetup& setup) {
  StudyReference reference;
  OneSimulation one(setup);
  double squares = 0;
  int count = 0;
  for (auto& force : reference.force) force.reserve(kTicks);
  reference.growth = conduct(setup, one, [&](int, double t, const Bodies&) {
    for (std::size_t h = 0; h < 2; ++h) {
      reference.force[h].push_back(one.force[h]);
      if (t < kRelaxAt) squares += one.force[h] * one.force[h], ++count;
    }
    return true;
  });
  reference.rms = std::sqrt(squares / count);
  return reference;
}

StudyOutcome runTwoHands(const StudySetup& setup, Coupling coupling, const CopySettings& settings, const StudyReference& reference) {
  const auto stations = makeStations(setup, coupling, settings);
  StudyOutcome outcome;
  outcome.force = reference.rms;
  double apart = 0, error = 0, above = 0;
  int apartCount = 0, errorCount = 0;
  outcome.given = -std::numeric_limits<double>::infinity();
  outcome.growth = conduct(setup, *stations, [&](int k, double t, const Bodies& bodies) {
    outcome.given = std::max(outcome.given, bodies[0].taken + bodies[1].taken);
    const double held = stations->aboveLedger();
    outcome.ledgerWorst = std::max(outcome.ledgerWorst, held);
    above = held > kLedgerAmount ? above + kTickSeconds : 0;
    outcome.ledgerDuration = std::max(outcome.ledgerDuration, above);
    if (t < kRelaxAt) {
      const Coordinates one = stations->places(0), other = stations->places(1);
      for (std::size_t i = 0; i < one.size(); ++i) apart += (one[i] - other[i]) * (one[i] - other[i]), ++apartCount;
      for (std::size_t h = 0; h < 2; ++h) {
        const double by = stations->force[h] - reference.force[h][static_cast<std::size_t>(k)];
        error += by * by, ++errorCount;
      }
    }
    return !isThrown(bodies);
  });
  outcome.apart = std::sqrt(apart / std::max(1, apartCount));
  outcome.forceError = std::sqrt(error / std::max(1, errorCount));
  outcome.stable = outcome.given < kMostGiven && Growth::isStable(outcome.growth, reference.growth) && std::isfinite(outcome.forceError);
  return outcome;
}

experiment::Experiment makeStudyExperiment(StudyObject object, double handStiffness, double handDamping, double chainDamping) {
  experiment::Experiment e;
  e.name = object == StudyObject::Chain ? "chain" : "parallel";
  e.constraint.name.clear();
  e.constraint.curve = {"phi", "0", "0"};
  e.task = experiment::Task{};
  e.task->start = {kStart};
  e.task->target = {kStart + 0.2};
  if (object == StudyObject::Chain) {
    e.object.kind = experiment::ObjectKind::Chain;
    e.object.masses.assign(5, 0.6);
    e.object.stiffness.assign(4, 600);
    e.object.damping.assign(4, chainDamping);
    e.coupling = experiment::Coupling{handStiffness, handDamping};
    e.hands = {{1, {handStiffness}, {handDamping}, {}}, {5, {handStiffness}, {handDamping}, {}}};
  } else {
    e.object.kind = experiment::ObjectKind::Parallel;
    e.object.masses.assign(2, 3);
    e.object.stiffness = {50, 250};
    e.object.damping.assign(2, handDamping);
    e.hands = {{0, {50, 250}, {handDamping, handDamping}, {}}, {0, {250, 50}, {handDamping, handDamping}, {}}};
  }
  return e;
}

StudySetup makeRandomSetup(StudyObject object, std::uint64_t seed, int index) {
  const std::uint64_t own = seededBits(seed, static_cast<std::uint64_t>(2 * index + (object == StudyObject::Chain ? 0 : 1)));
  std::uint64_t drawn = 0;
  const auto uniform = [&](double least, double most) { return least + (most - least) * seededFraction(own, drawn++); };
  StudySetup setup;
  const double stiffness = uniform(200, 600), someDamping = uniform(0, 5);
  const double damping = index % 2 == 1 ? someDamping : 0, chainDamping = index % 3 == 0 ? 1 : 0;
  setup.hand.stiffness = uniform(100, 600);
  setup.hand.damping = uniform(5, 40);
  setup.hand.limpStiffness = uniform(0, 60);
  setup.hand.limpDamping = uniform(3, 10);
  setup.hand.mass = uniform(0.5, 2);
  setup.experiment = object == StudyObject::Chain ? makeStudyExperiment(object, stiffness, damping, chainDamping)
                                                  : makeStudyExperiment(object, 0, 0.5 * damping);
  setup.seed = 100 + static_cast<std::uint64_t>(index);
  return setup;
}

}  // namespace reachlab::network
