#pragma once
#include <memory>

#include "sim/dynamics/compile.h"
#include "sim/dynamics/methods/abm.h"
#include "sim/dynamics/methods/adaptive.h"
#include "sim/dynamics/methods/rk4.h"
#include "sim/dynamics/methods/stiff.h"
#include "sim/dynamics/system_plant.h"

namespace reachlab::dynamics {

template <template <class> class SubSteps>
struct Multistep {
  template <class System>
  using Method = AbmWith<System, SubSteps>;
};

// Each maps the name of a method to its type. `Base` is a SystemPlant, or a class derived from it.

/// For every method except stiff. `SubSteps` is the adaptive method.
template <class Base, template <class> class SubSteps = Adaptive>
std::unique_ptr<Plant> makeExplicitPlant(const ObjectModel& model, const typename Base::System& system, const MethodRequest& request) {
  if (request.method == "rk4") return std::make_unique<SteppedPlant<Base, Rk4>>(model, system, request.tolerance);
  if (request.method == "adaptive") return std::make_unique<SteppedPlant<Base, SubSteps>>(model, system, request.tolerance);
  return std::make_unique<SteppedPlant<Base, Multistep<SubSteps>::template Method>>(model, system, request.tolerance);
}

/// For method stiff. Its dense matrices cost far more than a size known to the compiler would save, so that systems of any size use one form.
template <class Base>
std::unique_ptr<Plant> makeStiffPlant(const ObjectModel& model, const typename Base::System& system, const MethodRequest& request) {
  return std::make_unique<SteppedPlant<Base, Stiff>>(model, system, request.tolerance);
}

template <class Base>
std::unique_ptr<Plant> makePlant(const ObjectModel& model, const typename Base::System& system, const MethodRequest& request) {
  return request.method == "stiff" ? makeStiffPlant<Base>(model, system, request) : makeExplicitPlant<Base>(model, system, request);
}

}  // namespace reachlab::dynamics
