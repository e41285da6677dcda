// A system whose list of hooks and whose functions differ is not stepped: it does not compile.
#include "sim/dynamics/systems/system.h"

namespace reachlab::dynamics {
namespace {

struct Resting {
  static constexpr int kStates = 2;
  static constexpr bool kSecondOrder = true;
  static constexpr Hooks kHas{};
  using State = Numbers<2>;
  using Hand = HandSample;
  static constexpr int states() noexcept { return kStates; }
  Hand handAt(const HandSegment& hand, double s) const noexcept { return sampleAt(hand, s); }
  Hand handOf(const HandSample& hand) const noexcept { return hand; }
  double scale(int) const noexcept { return 1; }
  void rate(const Hand&, const State&, State& dy) const noexcept { dy.assign(0.0, 0.0); }
};
static_assert(Equations<Resting>);

struct Settling : Resting {
  static constexpr Hooks kHas{.settling = true};
  Settled settle(const State&, State&) noexcept { return Settled::Same; }
};
static_assert(Equations<Settling>);

struct MisspeltHook : Resting {
  static constexpr Hooks kHas{.settling = true};
  Settled setle(const State&, State&) noexcept { return Settled::Same; }
};
static_assert(!Equations<MisspeltHook>);

struct UndeclaredHook : Resting {
  Settled settle(const State&, State&) noexcept { return Settled::Same; }
};
static_assert(!Equations<UndeclaredHook>);

struct OtherArguments : Resting {
  static constexpr Hooks kHas{.settling = true};
  Settled settle(State&) noexcept { return Settled::Same; }
};
static_assert(!Equations<OtherArguments>);

struct OtherResult : Resting {
  static constexpr Hooks kHas{.losing = true};
  void lost(const State&) const noexcept {}
};
static_assert(!Equations<OtherResult>);

struct HalfOfAGroup : Resting {
  static constexpr Hooks kHas{.care = true};
  bool wantsSubSteps(const State&, double) const noexcept { return true; }
};
static_assert(!Equations<HalfOfAGroup>);

static_assert(!ObjectSystem<Resting>, "a method integrates it, but it holds no masses");

}  // namespace
}  // namespace reachlab::dynamics
