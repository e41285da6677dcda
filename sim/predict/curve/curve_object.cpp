#include "sim/predict/curve/curve_object.h"

#include <algorithm>
#include <cmath>

namespace reachlab::predict {

namespace {

/// The node from which spring i leads to node i + 1.
int innerOf(const LineObject& object, int i) { return object.parallel ? 0 : i; }

}  // namespace

double boundRate(const LineObject& object) {
  std::vector<double> stiffness(object.masses.size(), 0.0), decay = object.viscosity;
  for (int i = 0; i < object.count(); ++i)
    for (const int node : {innerOf(object, i), i + 1})
      if (node > 0) {
        const double rows = innerOf(object, i) > 0 ? 2 : 1;  // Gershgorin: what stands on the diagonal, and the same beside it
        stiffness[node - 1] += rows * object.springs[i], decay[node - 1] += rows * object.dampers[i];
      }
  double most = 0;
  for (int i = 0; i < object.count(); ++i) most = std::max(most, std::sqrt(stiffness[i] / object.masses[i]) + decay[i] / object.masses[i]);
  return most;
}

void expandAccelerations(const constraints::ArcCurve& curve, const LineObject& object, const double* s, const double* v, double* a,
                         Eigen::MatrixXd* jacobian, const double* weight, Eigen::MatrixXd* hessian) {
  const int nodes = object.count() + 1;
  std::vector<std::array<Vec3, 4>> at;  // place, tangent, curvature vector and its derivative of every node
  at.reserve(nodes);
  for (int i = 0; i < nodes; ++i) at.push_back(curve.expand<3>(s[i]));
  if (jacobian != nullptr) jacobian->setZero(nodes - 1, 2 * nodes);
  for (int i = 1; i < nodes; ++i) {
    const double drag = object.viscosity[i - 1] / object.masses[i - 1];
    a[i - 1] = -drag * v[i];
    if (jacobian != nullptr) (*jacobian)(i - 1, nodes + i) = -drag;
  }
  const auto pull = [&](int i, int j, double stiffness, double damping) {  // of node j on node i
    const auto &here = at[i], &there = at[j];
    const Vec3 &t = here[1], &c = here[2], &farT = there[1], &farC = there[2], chord = there[0] - here[0];
    const double lightness = 1 / object.masses[i - 1], k = lightness * stiffness, b = lightness * damping;
    const double along = dot(t, farT);
    a[i - 1] += k * dot(t, chord) + b * (along * v[j] - v[i]);
    if (jacobian != nullptr) {
      auto row = jacobian->row(i - 1);
      row(i) += k * (dot(c, chord) - 1) + b * dot(c, farT) * v[j];
      row(j) += k * along + b * dot(t, farC) * v[j];
      row(nodes + i) -= b;
      row(nodes + j) += b * along;
    }
    if (hessian != nullptr) {
      const double w = weight[i - 1], wk = w * k, wb = w * b;
      const auto add = [&](int p, int q, double value) {
        (*hessian)(p, q) += value;
        if (p != q) (*hessian)(q, p) += value;
      };
      add(i, i, wk * dot(here[3], chord) + wb * dot(here[3], farT) * v[j]);
      add(i, j, wk * dot(c, farT) + wb * dot(c, farC) * v[j]);
      add(j, j, wk * dot(t, farC) + wb * dot(t, there[3]) * v[j]);
      add(i, nodes + j, wb * dot(c, farT));
      add(j, nodes + j, wb * dot(t, farC));
    }
  };
  for (int i = 0; i + 1 < nodes; ++i) {
    const int inner = innerOf(object, i);
    pull(i + 1, inner, object.springs[i], object.dampers[i]);
    if (inner > 0) pull(inner, i + 1, object.springs[i], object.dampers[i]);
  }
}

}  // namespace reachlab::predict
