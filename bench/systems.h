#pragma once
#include <array>
#include <cmath>
#include <type_traits>

#include "bench/quad.h"

/// The right-hand sides of the scenes, written by hand, in any arithmetic. In Quad they give the references. In double they are the
/// functions that a user of a library would hand to odeint or CVODE. They are deliberately independent of sim/dynamics. SI units. y holds
/// all coordinates, then all their rates. `r` and `v` are the position and the velocity of the hand in the world.
namespace reachlab::bench {

/// (0, a cos phi, b sin phi).
struct EllipseShape {
  double a, b;
  template <class T>
  void evaluate(const T& phi, T* r, T* d, T* dd) const {
    const auto [s, c] = sineCosine(phi);
    r[0] = 0, r[1] = a * c, r[2] = b * s;
    d[0] = 0, d[1] = -a * s, d[2] = b * c;
    dd[0] = 0, dd[1] = -a * c, dd[2] = -b * s;
  }
};

/// (R cos phi - d cos 4 phi, R sin phi - d sin 4 phi, 0): an epitrochoid, a cusp where d = R/4.
struct EpitrochoidShape {
  double bigR, small;
  template <class T>
  void evaluate(const T& phi, T* r, T* d, T* dd) const {
    const auto [s, c] = sineCosine(phi);
    const T phi4 = 4 * phi;
    const auto [s4, c4] = sineCosine(phi4);
    r[0] = bigR * c - small * c4, r[1] = bigR * s - small * s4, r[2] = 0;
    d[0] = -bigR * s + 4 * small * s4, d[1] = bigR * c - 4 * small * c4, d[2] = 0;
    dd[0] = -bigR * c + 16 * small * c4, dd[1] = -bigR * s + 16 * small * s4, dd[2] = 0;
  }
};

/// ((R + r cos u) cos v, (R + r cos u) sin v, r sin u): u about the tube, v about the ring.
struct TorusShape {
  double bigR, small;
  template <class T>
  void evaluate(const T& u, const T& v, T* r, T* ru, T* rv, T* ruu, T* ruv, T* rvv) const {
    const auto [su, cu] = sineCosine(u);
    const auto [sv, cv] = sineCosine(v);
    const T w = bigR + small * cu, wu = -small * su, wuu = -small * cu;
    r[0] = w * cv, r[1] = w * sv, r[2] = small * su;
    ru[0] = wu * cv, ru[1] = wu * sv, ru[2] = small * cu;
    rv[0] = -w * sv, rv[1] = w * cv, rv[2] = 0;
    ruu[0] = wuu * cv, ruu[1] = wuu * sv, ruu[2] = -small * su;
    ruv[0] = -wu * sv, ruv[1] = wu * cv, ruv[2] = 0;
    rvv[0] = -w * cv, rvv[1] = -w * sv, rvv[2] = 0;
  }
};

/// (a u, a v, h (u^3 - 3 u v^2)).
struct SaddleShape {
  double a, h;
  template <class T>
  void evaluate(const T& u, const T& v, T* r, T* ru, T* rv, T* ruu, T* ruv, T* rvv) const {
    r[0] = a * u, r[1] = a * v, r[2] = h * u * (u * u - 3 * v * v);
    ru[0] = a, ru[1] = 0, ru[2] = 3 * h * (u * u - v * v);
    rv[0] = 0, rv[1] = a, rv[2] = -6 * h * u * v;
    ruu[0] = 0, ruu[1] = 0, ruu[2] = 6 * h * u;
    ruv[0] = 0, ruv[1] = 0, ruv[2] = -6 * h * v;
    rvv[0] = 0, rvv[1] = 0, rvv[2] = -6 * h * u;
  }
};

/// R (sin v cos u, sin v sin u, cos v).
struct SphereShape {
  double radius;
  template <class T>
  void evaluate(const T& u, const T& v, T* r, T* ru, T* rv, T* ruu, T* ruv, T* rvv) const {
    const auto [su, cu] = sineCosine(u);
    const auto [sv, cv] = sineCosine(v);
    r[0] = radius * sv * cu, r[1] = radius * sv * su, r[2] = radius * cv;
    ru[0] = -r[1], ru[1] = r[0], ru[2] = 0;
    rv[0] = radius * cv * cu, rv[1] = radius * cv * su, rv[2] = -radius * sv;
    ruu[0] = -r[0], ruu[1] = -r[1], ruu[2] = 0;
    ruv[0] = -rv[1], ruv[1] = rv[0], ruv[2] = 0;
    rvv[0] = -r[0], rvv[1] = -r[1], rvv[2] = -r[2];
  }
  /// Position and velocity in the world for the numbers u, v and their rates.
  template <class T>
  void placeAndVelocity(const T& u, const T& v, const T& du, const T& dv, T* r, T* velocity) const {
    T ru[3], rv[3], ruu[3], ruv[3], rvv[3];
    evaluate(u, v, r, ru, rv, ruu, ruv, rvv);
    for (int i = 0; i < 3; ++i) velocity[i] = ru[i] * du + rv[i] * dv;
  }
};

template <class T>
T dot3(const T* a, const T* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// 1/x to the digits of T. A double is divided beforehand, as in code written by hand.
template <class T>
T inverseOf([[maybe_unused]] double x, [[maybe_unused]] double inverse) {
  if constexpr (std::is_same_v<T, double>) return inverse;
  else return T(1) / x;
}

/// Chain of N equal masses on the x axis. The coordinates are displacements from x0 [m]. The hand pulls mass 1.
template <int N>
struct LineChain {
  static constexpr int kCoordinates = N, kMasses = N, kHandDegree = 5;
  static constexpr unsigned kHandAxes = 1;
  double mass, k, b, kHand, bHand, x0;
  double inverseMass = 1 / mass;
  bool handVelocity() const { return bHand != 0; }

  template <class T>
  void rate(const T* __restrict y, const T* r, const T* v, T* __restrict dy) const {
    const T inverse = inverseOf<T>(mass, inverseMass);
    T tension[N + 1];  // before mass i
    tension[0] = kHand * (r[0] - x0 - y[0]);
    for (int i = 1; i < N; ++i) tension[i] = k * (y[i - 1] - y[i]);
    tension[N] = 0;
    if (b != 0 || bHand != 0) {
      tension[0] += bHand * (v[0] - y[N]);
      for (int i = 1; i < N; ++i) tension[i] += b * (y[N + i - 1] - y[N + i]);
    }
    for (int i = 0; i < N; ++i) dy[i] = y[N + i];
    for (int i = 0; i < N; ++i) dy[N + i] = (tension[i] - tension[i + 1]) * inverse;
  }
  template <class T>
  void positions(const T* y, T* r) const {
    for (int i = 0; i < N; ++i) r[3 * i] = x0 + y[i], r[3 * i + 1] = r[3 * i + 2] = 0;
  }
};

/// Two masses on the x axis, each held by the hand through a separate spring.
struct LineParallel {
  static constexpr int kCoordinates = 2, kMasses = 2, kHandDegree = 5;
  static constexpr unsigned kHandAxes = 1;
  double mass, k1, k2, x0;
  double inverseMass = 1 / mass;
  bool handVelocity() const { return false; }

  template <class T>
  void rate(const T* __restrict y, const T* r, const T*, T* __restrict dy) const {
    const T hand = r[0] - x0;
    dy[0] = y[2], dy[1] = y[3];
    const T inverse = inverseOf<T>(mass, inverseMass);
    dy[2] = k1 * inverse * (hand - y[0]);
    dy[3] = k2 * inverse * (hand - y[1]);
  }
  template <class T>
  void positions(const T* y, T* r) const {
    for (int i = 0; i < 2; ++i) r[3 * i] = x0 + y[i], r[3 * i + 1] = r[3 * i + 2] = 0;
  }
};

/// A bead on a surface, Eqs. (12), (13). `Driven` false: no hand, a geodesic with friction.
template <class Shape, bool Driven>
struct SurfaceBead {
  static constexpr int kCoordinates = 2, kMasses = 1, kHandDegree = 5;
  static constexpr unsigned kHandAxes = Driven ? 7 : 0;
  Shape shape;
  double mass, lambda, kHand, bHand;
  bool handVelocity() const { return Driven; }

  template <class T>
  void rate(const T* __restrict y, const T* r, const T* v, T* __restrict dy) const {
    T p[3], ru[3], rv[3], ruu[3], ruv[3], rvv[3];
    shape.evaluate(y[0], y[1], p, ru, rv, ruu, ruv, rvv);
    const T du = y[2], dv = y[3];
    T h[3];  // f/m - lambda/m rdot - w, whose projection on the tangents is G qddot
    for (int i = 0; i < 3; ++i) {
      const T velocity = ru[i] * du + rv[i] * dv;
      T f = -lambda * velocity;
      if (Driven) f += kHand * (r[i] - p[i]) + bHand * (v[i] - velocity);
      h[i] = f / mass - (ruu[i] * du * du + 2 * ruv[i] * du * dv + rvv[i] * dv * dv);
    }
    const T e = dot3(ru, ru), f = dot3(ru, rv), g = dot3(rv, rv), a = dot3(ru, h), b = dot3(rv, h);
    const T inverse = 1 / (e * g - f * f);
    dy[0] = du, dy[1] = dv;
    dy[2] = (g * a - f * b) * inverse;
    dy[3] = (e * b - f * a) * inverse;
  }
  template <class T>
  void positions(const T* y, T* r) const {
    T ru[3], rv[3], ruu[3], ruv[3], rvv[3];
    shape.evaluate(y[0], y[1], r, ru, rv, ruu, ruv, rvv);
  }
};

/// A chain of N equal masses on a curve, Eq. (11) with r_phi . f on the right for each. The springs run straight through space.
template <class Shape, int N, unsigned Axes>
struct CurveChain {
  static constexpr int kCoordinates = N, kMasses = N, kHandDegree = 7;
  static constexpr unsigned kHandAxes = Axes;
  Shape shape;
  double mass, lambda, k, b, kHand, bHand;
  bool handVelocity() const { return true; }

  template <class T>
  void rate(const T* __restrict y, const T* r, const T* v, T* __restrict dy) const {
    T p[N][3], d[N][3], dd[N][3];
    for (int i = 0; i < N; ++i) shape.evaluate(y[i], p[i], d[i], dd[i]);
    T left[3], right[3] = {0, 0, 0};
    for (int a = 0; a < 3; ++a) left[a] = Axes >> a & 1 ? kHand * (r[a] - p[0][a]) + bHand * (v[a] - d[0][a] * y[N]) : T(0);
    for (int i = 0; i < N; ++i) {
      const T w = y[N + i];
      for (int a = 0; a < 3; ++a)
        right[a] = i + 1 < N && (Axes >> a & 1) ? k * (p[i][a] - p[i + 1][a]) + b * (d[i][a] * w - d[i + 1][a] * y[N + i + 1]) : T(0);
      T f = 0;
      for (int a = 0; a < 3; ++a)
        if (Axes >> a & 1) f += d[i][a] * (left[a] - right[a]);
      const T g = dot3(d[i], d[i]);
      dy[i] = w;
      dy[N + i] = (f - lambda * g * w - mass * dot3(d[i], dd[i]) * w * w) / (mass * g);
      for (int a = 0; a < 3; ++a) left[a] = right[a];
    }
  }
  template <class T>
  void positions(const T* y, T* r) const {
    T d[3], dd[3];
    for (int i = 0; i < N; ++i) shape.evaluate(y[i], r + 3 * i, d, dd);
  }
};

}  // namespace reachlab::bench
