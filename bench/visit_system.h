#pragma once
#include <type_traits>

#include "base/fault.h"
#include "bench/scenes.h"
#include "bench/systems.h"

namespace reachlab::bench {

/// Calls f(system) with the hand-written right-hand side of the scene. Its numbers are those of the experiment of the scene.
template <class F>
auto visitSystem(const BenchScene& scene, F&& f) {
  const experiment::Object& o = scene.experiment.object;
  const experiment::Coupling coupling = scene.experiment.coupling.value_or(experiment::Coupling{});
  const auto& shape = scene.experiment.constraint.shape;
  const double mass = o.masses[0];
  const std::string& n = scene.name;
  const double x0 = scene.hand.from.x;
  const auto chain = [&]<int N>(std::integral_constant<int, N>) {
    return LineChain<N>{mass, o.stiffness[0], o.damping[0], coupling.stiffness, coupling.damping, x0};
  };
  const auto ellipse = [&] { return EllipseShape{shape.at("a_m"), shape.at("b_m")}; };
  if (n == "S1" || n == "S7a" || n == "S7b") return f(chain(std::integral_constant<int, 5>{}));
  if (n == "S1b50") return f(chain(std::integral_constant<int, 50>{}));
  if (n == "S1b500") return f(chain(std::integral_constant<int, 500>{}));
  if (n == "S6") return f(LineParallel{mass, o.stiffness[0], o.stiffness[1], x0});
  if (n == "S2a" || n == "S2b" || n == "S7c")
    return f(CurveChain<EllipseShape, 1, 6>{ellipse(), mass, o.viscosity, 0, 0, coupling.stiffness, coupling.damping});
  if (n == "S5" || n == "S5h")
    return f(CurveChain<EpitrochoidShape, 1, 3>{
        {shape.at("a_m"), shape.at("d_m")}, mass, o.viscosity, 0, 0, coupling.stiffness, coupling.damping});
  if (n == "S3")
    return f(
        SurfaceBead<TorusShape, true>{{shape.at("major_m"), shape.at("minor_m")}, mass, o.viscosity, coupling.stiffness, coupling.damping});
  if (n == "S4")
    return f(SurfaceBead<SaddleShape, true>{
        {shape.at("width_m"), shape.at("depth_m")}, mass, o.viscosity, coupling.stiffness, coupling.damping});
  if (n == "S7d" || n == "S7e") return f(SurfaceBead<SphereShape, false>{{shape.at("R")}, mass, 0, 0, 0});
  if (n == "S7f") return f(SurfaceBead<SphereShape, true>{{shape.at("R")}, mass, 0, coupling.stiffness, coupling.damping});
  if (n == "S8")
    return f(
        CurveChain<EllipseShape, 5, 6>{ellipse(), mass, o.viscosity, o.stiffness[0], o.damping[0], coupling.stiffness, coupling.damping});
  throw FaultError(Fault{"scene", "is " + n + ", which has no right-hand side here"});
}

}  // namespace reachlab::bench
