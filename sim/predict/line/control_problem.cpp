#include "sim/predict/line/control_problem.h"

#include <algorithm>
#include <cmath>

namespace reachlab::predict {
namespace {

using std::sqrt;
using Real = DoubleDouble;

// A linear combination of the states and, last, of the control.
using Row = std::vector<Real>;

// One of them.
struct Term {
  size_t place;
  Real factor;
};

void add(Row& to, const Row& row, Real factor) {
  for (size_t i = 0; i < to.size(); ++i)
    if (row[i].hi != 0) to[i] += factor * row[i];
}
void add(Row& to, const Term& term, Real factor) { to[term.place] += factor * term.factor; }

/// Collects the equations of one object, state by state.
class Builder {
 public:
  Builder(const LineObject& line, Criterion criterion) : o(line), n(line.count()), kind(criterion) {}

  ControlProblem byHand(int order, double distance) {
    const int rest = 2 * n;  // h, h', … after elongations and relative velocities
    begin(n, n, order);
    const Term speed = state(rest + 1), acceleration = state(rest + 2);
    pullBySprings(zero());
    for (int i = 0; i < n; ++i) {
      add(force[i], speed, Real(-o.viscosity[i]));
      add(force[i], acceleration, Real(-o.masses[i]));
    }
    finishVelocities();
    for (int k = 0; k + 1 < order; ++k) setRate(rest + k, row(state(rest + k + 1)), Real(1));
    setRate(rest + order - 1, row(control()), Real(1));
    s.target[rest] = distance;
    s.output = positions(row(state(rest)));
    return finish();
  }

  ControlProblem byForce(double distance) {
    if (o.handMass > 0) return withHeavyHand(distance);
    const double hubDamping = hubDampers() + o.handDamping;
    const bool hub = o.parallel && n > 1;
    // A massless hand that meets a damper has its own rate; it must come to rest only if the masses would feel it afterwards.
    if (hubDamping > 0 && (o.handDamping > 0 || hub)) return withSlowHand(hubDamping, distance);
    return hub ? withHub(distance) : withFreeEnd(hubDamping, distance);
  }

 private:
  // The hand is node 0 of N+1.
  ControlProblem withHeavyHand(double distance) {
    begin(n, n + 1, 1 + forceStates());
    pullBySprings({});
    add(force[0], velocity(0), Real(-o.handDamping));
    add(force[0], drivingForce(), Real(1));
    return finishWithElongations(distance);
  }

  // Hand without mass behind a damper: (sum b + b_hand) h' = F - sum k e + sum b v.
  ControlProblem withSlowHand(double hubDamping, double distance) {
    begin(n, n, 1 + forceStates());
    Row speed = drivingForce();
    for (int i = 0; i < n; ++i)
      if (fromOf(i) < 0) {
        add(speed, state(i), -sqrt(Real(o.springs[i])));
        add(speed, velocity(i), Real(o.dampers[i]));
      }
    for (Real& c : speed) c /= Real(hubDamping);
    pullBySprings(speed);
    s.handVelocityJumps = kind != Criterion::MinHandForceChange;
    return finishWithElongations(distance);
  }

  // Massless hand, no damper at it: the force acts on mass 1 of the chain at once, and h = x1 + F/k. A damper in the coupling
  // makes the hand follow the force instead, without a say in the problem.
  ControlProblem withFreeEnd(double hubDamping, double distance) {
    const bool follower = hubDamping > 0;
    begin(n - 1, n, 1 + forceStates() + (follower ? 1 : 0));
    s.controlled = s.size - (follower ? 1 : 0);
    const Row drive = drivingForce();
    for (int i = 0; i < n; ++i) {
      add(force[i], velocity(i), Real(-o.viscosity[i]));
      if (i == 0) continue;
      const Row stretching = difference(velocity(i - 1), velocity(i));
      setRate(i - 1, stretching, sqrt(Real(o.springs[i])));
      applySpring(i, i - 1, i, stretching, i - 1);
    }
    add(force[0], drive, Real(1));
    finishByForce(distance);

    Row first = row(centre());  // x1 = Xc + sum of what lies behind it
    for (int i = 1; i < n; ++i) {
      double behind = 0;
      for (int j = i; j < n; ++j) behind += o.masses[j];
      add(first, state(i - 1), Real(behind) / Real(o.totalMass()) / sqrt(Real(o.springs[i])));
    }
    Row hand = first;
    const Real k = o.springs[0];
    if (follower) {
      const int last = s.size - 1;  // its stretch h - x1 [m]: b e' = F - k e
      Row rate = drive;
      add(rate, state(last), -k);
      setRate(last, rate, Real(1) / Real(hubDamping));
      add(hand, state(last), Real(1));
      s.handVelocityJumps = kind != Criterion::MinHandForceChange;
    } else {
      add(hand, drive, Real(1) / k);
      s.handVelocityJumps = true;
      s.handJumps = kind != Criterion::MinHandForceChange;
    }
    s.output = {hand, first};
    for (int i = 1; i < n; ++i) {
      Row mass = s.output.back();
      add(mass, state(i - 1), Real(-1) / sqrt(Real(o.springs[i])));
      s.output.push_back(mass);
    }
    return finish();
  }

  // Massless hub of parallel springs: sum k e = F always, so that the scaled elongations are q F / sqrt(sum k) + B y with q =
  // sqrt(k) of unit length and B an orthonormal basis of what is perpendicular to it (columns of a Householder reflection).
  ControlProblem withHub(double distance) {
    begin(n - 1, n, 1 + forceStates());
    Real total = 0;
    for (const double k : o.springs) total += Real(k);
    std::vector<Real> q, axis;
    for (const double k : o.springs) q.push_back(sqrt(Real(k) / total));
    axis = q;
    axis[0] += Real(1);
    const auto basis = [&](int i, int j) {  // i-th spring, j-th column after q
      const Real reflected = axis[i] * axis[j + 1] / axis[0];
      return i == j + 1 ? Real(1) - reflected : -reflected;
    };
    const Row drive = drivingForce();
    std::vector<Row> stretch(n, zero());  // sqrt(k) e
    for (int i = 0; i < n; ++i) {
      add(stretch[i], drive, q[i] / sqrt(total));
      for (int j = 0; j + 1 < n; ++j) add(stretch[i], state(j), basis(i, j));
      add(force[i], stretch[i], sqrt(Real(o.springs[i])));
      add(force[i], velocity(i), Real(-o.viscosity[i]));
    }
    for (int j = 0; j + 1 < n; ++j) {
      Row rate = zero();
      for (int i = 0; i < n; ++i) add(rate, velocity(i), -sqrt(Real(o.springs[i])) * basis(i, j));
      setRate(j, rate, Real(1));
    }
    finishByForce(distance);
    Row hand = row(centre());
    for (int i = 0; i < n; ++i) add(hand, stretch[i], Real(o.masses[i]) / Real(o.totalMass()) / sqrt(Real(o.springs[i])));
    s.output = {hand};
    for (int i = 0; i < n; ++i) {
      Row mass = hand;
      add(mass, stretch[i], Real(-1) / sqrt(Real(o.springs[i])));
      s.output.push_back(mass);
    }
    s.handVelocityJumps = true;
    s.handJumps = kind != Criterion::MinHandForceChange;
    return finish();
  }

  void begin(int elongations, int velocities, int others) {
    s.elongations = elongations;
    s.velocities = velocities;
    s.size = s.controlled = elongations + velocities + others;
    s.a.assign(static_cast<size_t>(s.size) * s.size, Real(0));
    s.b.assign(s.size, Real(0));
    s.target.assign(s.size, Real(0));
    force.assign(velocities, zero());
    nodeMass = o.masses;
    if (o.handMass > 0) nodeMass.insert(nodeMass.begin(), o.handMass);
  }

  int handNodes() const { return s.velocities - n; }  // 1 for a hand with mass
  int forceStates() const { return kind == Criterion::MinHandForceChange ? 1 : 0; }
  int centreIndex() const { return s.elongations + s.velocities; }
  int forceIndex() const { return centreIndex() + 1; }
  int fromOf(int spring) const { return o.parallel ? -1 : spring - 1; }
  double hubDampers() const {
    double sum = o.dampers[0];
    for (int i = 1; o.parallel && i < n; ++i) sum += o.dampers[i];
    return sum;
  }

  Row zero() const { return Row(static_cast<size_t>(s.size) + 1, Real(0)); }
  Row row(const Term& term) const {
    Row single = zero();
    single[term.place] = term.factor;
    return single;
  }
  Term state(int i) const { return {static_cast<size_t>(i), Real(1)}; }
  Term control() const { return state(s.size); }
  Term centre() const { return state(centreIndex()); }
  Term velocity(int node) const { return {static_cast<size_t>(s.elongations + node), Real(1) / sqrt(Real(nodeMass[node]))}; }
  static Row difference(Row a, const Term& b) {
    add(a, b, Real(-1));
    return a;
  }
  Row difference(const Term& a, const Term& b) const { return difference(row(a), b); }

  // F in terms of states and control; for criterion 6 the control is the acceleration of the centre of mass.
  Row drivingForce() const {
    if (kind == Criterion::MinHandForceChange) return row(state(forceIndex()));
    Row drive = row(control());
    if (kind == Criterion::MinHandForce) return drive;
    for (Real& c : drive) c *= Real(o.totalMass());
    if (handNodes() > 0) add(drive, velocity(0), Real(o.handDamping));
    for (int i = 0; i < n; ++i) add(drive, velocity(handNodes() + i), Real(o.viscosity[i]));
    return drive;
  }

  void setRate(int i, const Row& rate, Real factor) {
    for (int j = 0; j < s.size; ++j) s.a[static_cast<size_t>(i) * s.size + j] = factor * rate[j];
    s.b[i] = factor * rate[s.size];
  }

  void applySpring(int spring, int from, int to, const Row& stretching, int stateIndex = -1) {
    Row pull = zero();
    add(pull, state(stateIndex < 0 ? spring : stateIndex), sqrt(Real(o.springs[spring])));
    add(pull, stretching, Real(o.dampers[spring]));
    add(force[to], pull, Real(1));
    if (from >= 0) add(force[from], pull, Real(-1));
  }

  // Every spring, and the drag on the mass behind it. `hub`: the velocity of a hand without mass.
  void pullBySprings(const Row& hub) {
    for (int i = 0; i < n; ++i) {
      const int from = handNodes() + fromOf(i), to = handNodes() + i;
      const Row stretching = from < 0 ? difference(hub, velocity(to)) : difference(velocity(from), velocity(to));
      setRate(i, stretching, sqrt(Real(o.springs[i])));
      applySpring(i, from, to, stretching);
      add(force[to], velocity(to), Real(-o.viscosity[i]));
    }
  }

  void finishVelocities() {
    for (int i = 0; i < s.velocities; ++i) setRate(s.elongations + i, force[i], Real(1) / sqrt(Real(nodeMass[i])));
  }

  void finishByForce(double distance) {
    finishVelocities();
    Row momentum = zero();
    for (int i = 0; i < s.velocities; ++i) add(momentum, velocity(i), Real(nodeMass[i]));
    setRate(centreIndex(), momentum, Real(1) / Real(o.totalMass()));
    if (forceStates() > 0) setRate(forceIndex(), row(control()), Real(1));
    s.target[centreIndex()] = distance;
  }

  // Where every spring has its elongation state: from the centre of mass to the hand each mass adds its share of the springs before it.
  ControlProblem finishWithElongations(double distance) {
    finishByForce(distance);
    Row hand = row(centre());
    for (int mass = 0; mass < n; ++mass) {
      const Real share = Real(o.masses[mass]) / Real(o.totalMass());
      for (int i = o.parallel ? mass : 0; i <= mass; ++i) add(hand, state(i), share / sqrt(Real(o.springs[i])));
    }
    s.output = positions(hand);
    return finish();
  }

  // Hand and masses from the hand's row when every spring has its elongation state.
  std::vector<Row> positions(const Row& hand) const {
    std::vector<Row> rows{hand};
    rows.reserve(static_cast<size_t>(n) + 1);
    for (int i = 0; i < n; ++i) {
      Row mass = o.parallel ? hand : rows.back();
      add(mass, state(i), Real(-1) / sqrt(Real(o.springs[i])));
      rows.push_back(mass);
    }
    return rows;
  }

  ControlProblem finish() { return std::move(s); }

  const LineObject& o;
  int n;
  Criterion kind;
  ControlProblem s;
  std::vector<double> nodeMass;
  std::vector<Row> force;  // on each node [N]
};

}  // namespace

ControlProblem makeControlProblem(const LineObject& object, Criterion criterion, double distance) {
  LineObject line = object;
  const bool byHand = criterion == Criterion::MinHandJerk || criterion == Criterion::MinHandCrackle;
  if (byHand) line.handMass = line.handDamping = 0;  // the hand's motion is given: what it takes to move it does not matter
  // The centre of mass does not feel what a massless hand loses to its own damping.
  if (criterion == Criterion::MinComAcceleration && line.handMass == 0) line.handDamping = 0;
  Builder builder(line, criterion);
  return byHand ? builder.byHand(criterion == Criterion::MinHandJerk ? 3 : 5, distance) : builder.byForce(distance);
}

}  // namespace reachlab::predict
