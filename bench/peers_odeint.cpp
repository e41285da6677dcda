#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>

#include "base/ticks.h"
#include "bench/peer_system.h"
#include "bench/peers.h"

namespace reachlab::bench {
namespace {

namespace odeint = boost::numeric::odeint;

template <class System>
using State = std::array<double, 2 * System::kCoordinates>;

template <class System>
struct Problem {
  BenchScene scene;
  System system;
  Segments segments;
};

// The state, the stepper and the system are locals of a run, so that the compiler may keep them where it likes. `fresh` has a stepper that
// no run has used.
template <class System, class Tick>
std::function<void(Trajectory*)> makeRun(const BenchScene& scene, const System& system, const Tick& fresh) {
  const auto problem = std::make_shared<const Problem<System>>(Problem<System>{scene, system, makeSegments(scene, kTickSeconds)});
  return [problem, fresh](Trajectory* trajectory) {
    PeerSystem<System> peer{problem->system};
    Tick tick = fresh;
    State<System> y{};
    setInitialState<System>(problem->scene, y.data());
    const auto rate = [&peer](const State<System>& at, State<System>& slope, double t) { peer.rate(at.data(), slope.data(), t); };
    std::uint64_t steps = 0;
    runReach(peer, *problem->segments, y.data(), trajectory, [&] { return tick(rate, y, steps); });
    if (trajectory) trajectory->steps = steps;
  };
}

template <class Stepper, class System>
Contender fixedStep(const std::string& method, const BenchScene& scene, const System& system, double step) {
  const int stepsPerTick = static_cast<int>(std::lround(kTickSeconds / step));
  const auto tick = [step, stepsPerTick, stepper = Stepper()](const auto& rate, State<System>& y, std::uint64_t& steps) mutable {
    for (int i = 0; i < stepsPerTick; ++i) stepper.do_step(rate, y, i * step, step);
    steps += stepsPerTick;
    return true;
  };
  return {.method = method, .step = step, .run = makeRun(scene, system, tick)};
}

template <class Stepper, class System>
Contender controlled(const std::string& method, const BenchScene& scene, const System& system, double tolerance) {
  const auto tick = [suggested = kTickSeconds, stepper = odeint::make_controlled(tolerance, tolerance, Stepper())](
                        const auto& rate, State<System>& y, std::uint64_t& steps) mutable {
    double t = 0;
    int tries = 0;
    while (t < kTickSeconds * (1 - 1e-12)) {
      double dt = std::min(suggested, kTickSeconds - t);
      const bool shortened = dt < suggested;
      if (stepper.try_step(rate, y, t, dt) == odeint::success) {
        ++steps;
        suggested = shortened ? std::max(suggested, dt) : dt;
      } else {
        suggested = dt;
      }
      if (++tries > 20'000 || !(suggested > 1e-15)) return false;
    }
    return true;
  };
  return {.method = method, .tolerance = tolerance, .run = makeRun(scene, system, tick)};
}

}  // namespace

std::vector<Contender> makeOdeintPeers(const BenchScene& scene) {
  std::vector<Contender> all;
  visitSystem(scene, [&]<class System>(const System& system) {
    using S = State<System>;
    for (double step : {1e-3, 5e-4, 2.5e-4, 1e-4, 5e-5, 2.5e-5})
      all.push_back(fixedStep<odeint::runge_kutta4<S>>("odeint-rk4", scene, system, step));
    for (double step : {1e-3, 5e-4, 2.5e-4}) {
      all.push_back(fixedStep<odeint::runge_kutta_dopri5<S>>("odeint-dopri5", scene, system, step));
      all.push_back(fixedStep<odeint::runge_kutta_fehlberg78<S>>("odeint-fehlberg78", scene, system, step));
    }
    for (int digits = 4; digits <= 13; ++digits) {
      const double tolerance = std::pow(10.0, -digits);
      all.push_back(controlled<odeint::runge_kutta_dopri5<S>>("odeint-dopri5", scene, system, tolerance));
      all.push_back(controlled<odeint::runge_kutta_fehlberg78<S>>("odeint-fehlberg78", scene, system, tolerance));
    }
  });
  return all;
}

}  // namespace reachlab::bench
