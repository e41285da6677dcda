#include <cmath>

#include "base/fault.h"
#include "base/ticks.h"
#include "bench/visit_system.h"
#include "tests/bench/limit_forms.h"
#include "tests/bench/limit_sincos.h"

namespace reachlab::bench {
namespace {

/// Adams-Bashforth-Moulton, PECE of order 6 at 1 ms: two right-hand sides a tick, both at its end, so the hand is needed there only.
/// The first five ticks are RK4 in four parts. Model: `T q'' = rate(q, q', F)` with F = k r_HIP + b v_HIP.
template <class T, int K, class Model>
struct AdamsForm {
  static constexpr int kRhsPerStep = 2, kOrder = 6, kStates = Model::kStates, kMasses = Model::kMasses;
  Model model;
  T q[K]{}, v[K]{};
  T oldV[kOrder][K]{}, oldA[kOrder][K]{};  // newest first
  int started = 0;

  void step(const dynamics::HandSegment& hand) {
    if (started < kOrder - 1) {
      startUp(hand);
      return;
    }
    const Vec3 force = driving(hand);
    static constexpr double h = kTickSeconds / 1440;
    static constexpr double predict[kOrder] = {4277 * h, -7923 * h, 9982 * h, -7298 * h, 2877 * h, -475 * h};
    static constexpr double correct[kOrder] = {475 * h, 1427 * h, -798 * h, 482 * h, -173 * h, 27 * h};
    T qp[K], vp[K], a[K];
    for (int i = 0; i < K; ++i) {
      // Oldest first, so that the newest value is waited for last.
      T dq = predict[5] * oldV[5][i] + predict[4] * oldV[4][i], dv = predict[5] * oldA[5][i] + predict[4] * oldA[4][i];
      for (int j = 3; j >= 0; --j) dq += predict[j] * oldV[j][i], dv += predict[j] * oldA[j][i];
      qp[i] = q[i] + dq, vp[i] = v[i] + dv;
    }
    model.rate(qp, vp, force, a);
    for (int i = 0; i < K; ++i) {
      T dq = correct[5] * oldV[4][i] + correct[4] * oldV[3][i], dv = correct[5] * oldA[4][i] + correct[4] * oldA[3][i];
      for (int j = 3; j >= 1; --j) dq += correct[j] * oldV[j - 1][i], dv += correct[j] * oldA[j - 1][i];
      q[i] += dq + correct[0] * vp[i], v[i] += dv + correct[0] * a[i];
    }
    if constexpr (requires { model.settle(q, v); }) model.settle(q, v);
    model.rate(q, v, force, a);
    remember(a);
  }

  double probe() const {
    double s[kStates];
    state(s);
    return s[0];
  }
  void state(double* out) const { model.state(q, v, out); }
  void positions(double* r) const {
    double s[kStates];
    state(s);
    model.positions(s, r);
  }

 private:
  Vec3 driving(const dynamics::HandSegment& hand, double s) const {
    Vec3 r, w;
    for (int k = dynamics::HandSegment::kMaxDegree; k >= 0; --k) r = hand.position[k] + s * r, w = hand.velocity[k] + s * w;
    return model.kHand * r + model.bHand * w;
  }
  Vec3 driving(const dynamics::HandSegment& hand) const {
    Vec3 r = hand.position[0], w = hand.velocity[0];
    for (int k = 1; k <= Model::kHandDegree; ++k) r += hand.position[k], w += hand.velocity[k];
    return model.kHand * r + model.bHand * w;
  }
  void remember(const T* a) {
    for (int j = kOrder - 1; j > 0; --j)
      for (int i = 0; i < K; ++i) oldV[j][i] = oldV[j - 1][i], oldA[j][i] = oldA[j - 1][i];
    for (int i = 0; i < K; ++i) oldV[0][i] = v[i], oldA[0][i] = a[i];
  }
  void startUp(const dynamics::HandSegment& hand) {
    constexpr int kParts = 4;
    constexpr double h = kTickSeconds / kParts;
    T a[K];
    if (started == 0) {
      model.rate(q, v, driving(hand, 0), a);
      remember(a);
    }
    for (int part = 0; part < kParts; ++part) {
      T a1[K], a2[K], a3[K], a4[K], q2[K], v2[K], q3[K], v3[K], q4[K], v4[K];
      const double s = static_cast<double>(part) / kParts;
      const Vec3 middle = driving(hand, s + 0.5 / kParts);
      model.rate(q, v, driving(hand, s), a1);
      for (int i = 0; i < K; ++i) q2[i] = q[i] + h / 2 * v[i], v2[i] = v[i] + h / 2 * a1[i];
      model.rate(q2, v2, middle, a2);
      for (int i = 0; i < K; ++i) q3[i] = q[i] + h / 2 * v2[i], v3[i] = v[i] + h / 2 * a2[i];
      model.rate(q3, v3, middle, a3);
      for (int i = 0; i < K; ++i) q4[i] = q[i] + h * v3[i], v4[i] = v[i] + h * a3[i];
      model.rate(q4, v4, driving(hand, s + 1.0 / kParts), a4);
      for (int i = 0; i < K; ++i) {
        q[i] += h / 6 * (v[i] + 2.0 * (v2[i] + v3[i]) + v4[i]);
        v[i] += h / 6 * (a1[i] + 2.0 * (a2[i] + a3[i]) + a4[i]);
      }
    }
    model.rate(q, v, driving(hand, 1), a);
    remember(a);
    ++started;
  }
};

/// On (0, a cos phi, b sin phi): with D = a^2 - b^2, m g phi'' = r_phi.F + D sin cos (k - m phi'^2) - (b_h + lambda) g phi'.
struct EllipseModel {
  static constexpr int kStates = 2, kMasses = 1, kHandDegree = 7;
  double a, b, mass, kHand, bHand, drag;  // drag = (b_h + lambda) / m
  void rate(const double* q, const double* v, const Vec3& f, double* acceleration) const {
    double s, c;
    sinCos(q[0], s, c);
    const double dy = -a * s, dz = b * c, difference = (a * a - b * b) * s * c;
    acceleration[0] = (dy * f.y + dz * f.z + difference * (kHand - mass * v[0] * v[0])) / (mass * (dy * dy + dz * dz)) - drag * v[0];
  }
  void state(const double* q, const double* v, double* out) const { out[0] = q[0], out[1] = v[0]; }
  void positions(const double* s, double* r) const { r[0] = 0, r[1] = a * std::cos(s[0]), r[2] = b * std::sin(s[0]); }
};

/// On the torus the first form is diagonal (r^2, w^2), w = R + r cos u; u about the tube, v about the ring.
struct TorusModel {
  static constexpr int kStates = 4, kMasses = 1, kHandDegree = 5;
  double bigR, small, mass, kHand, bHand, drag;
  void rate(const double* q, const double* v, const Vec3& f, double* acceleration) const {
    double su, cu, sv, cv;
    sinCos(q[0], su, cu);
    sinCos(q[1], sv, cv);
    const double w = bigR + small * cu, inverse = 1 / w, du = v[0], dv = v[1];
    acceleration[0] = (cu * f.z - su * (cv * f.x + sv * f.y - kHand * bigR)) / (mass * small) - drag * du - w * su / small * dv * dv;
    acceleration[1] = (cv * f.y - sv * f.x) * inverse / mass - drag * dv + 2 * small * su * inverse * du * dv;
  }
  void state(const double* q, const double* v, double* out) const { out[0] = q[0], out[1] = q[1], out[2] = v[0], out[3] = v[1]; }
  void positions(const double* s, double* r) const {
    const double w = bigR + small * std::cos(s[0]);
    r[0] = w * std::cos(s[1]), r[1] = w * std::sin(s[1]), r[2] = small * std::sin(s[0]);
  }
};

/// On (a u, a v, h (u^3 - 3 u v^2)): G = a^2 1 + h^2 p p^T with p the slope of the height, inverted by Sherman and Morrison.
struct SaddleModel {
  static constexpr int kStates = 4, kMasses = 1, kHandDegree = 5;
  double a, h, mass, kHand, bHand, drag;
  void rate(const double* q, const double* v, const Vec3& f, double* acceleration) const {
    const double x = q[0], y = q[1], du = v[0], dv = v[1], u2 = x * x, v2 = y * y, uv = x * y, inverseMass = 1 / mass;
    const double pu = 3 * (u2 - v2), pv = -6 * uv;
    const double fx = (f.x - kHand * a * x) * inverseMass, fy = (f.y - kHand * a * y) * inverseMass;
    const double fz = (f.z - kHand * h * x * (u2 - 3 * v2)) * inverseMass - 6 * h * (x * (du * du - dv * dv) - 2 * y * du * dv);
    const double left = a * fx + h * pu * fz, right = a * fy + h * pv * fz;
    const double common = h * h * (pu * left + pv * right) / (a * a + h * h * (pu * pu + pv * pv)), inverse = 1 / (a * a);
    acceleration[0] = (left - pu * common) * inverse - drag * du;
    acceleration[1] = (right - pv * common) * inverse - drag * dv;
  }
  void state(const double* q, const double* v, double* out) const { out[0] = q[0], out[1] = q[1], out[2] = v[0], out[3] = v[1]; }
  void positions(const double* s, double* r) const { r[0] = a * s[0], r[1] = a * s[1], r[2] = h * s[0] * (s[0] * s[0] - 3 * s[1] * s[1]); }
};

/// On a sphere about the origin, in world coordinates: m r'' = F - (k_h + b_h d/dt) r less its part along r, and v.v towards the middle.
struct SphereModel {
  static constexpr int kStates = 6, kMasses = 1, kHandDegree = 5;
  double inverse, mass, kHand, bHand, drag;  // 1/R^2
  void rate(const double* q, const double* v, const Vec3& f, double* acceleration) const {
    const double inverseMass = 1 / mass, pull[3] = {f.x, f.y, f.z};
    double a[3], inward = 0;
    for (int i = 0; i < 3; ++i) a[i] = (pull[i] - kHand * q[i]) * inverseMass - drag * v[i];
    for (int i = 0; i < 3; ++i) inward += q[i] * a[i] + v[i] * v[i];
    inward *= inverse;
    for (int i = 0; i < 3; ++i) acceleration[i] = a[i] - inward * q[i];
  }
  /// One Newton step back onto the sphere: a force inwards drives the mass from it, by a factor of 1e8 within the reach.
  void settle(double* q, double* v) const {
    double square = 0, outward = 0;
    for (int i = 0; i < 3; ++i) square += q[i] * q[i], outward += v[i] * q[i];
    for (int i = 0; i < 3; ++i) v[i] -= outward * inverse * q[i], q[i] += (0.5 - 0.5 * square * inverse) * q[i];
  }
  void state(const double* q, const double* v, double* out) const {
    for (int i = 0; i < 3; ++i) out[i] = q[i], out[3 + i] = v[i];
  }
  void positions(const double* s, double* r) const { r[0] = s[0], r[1] = s[1], r[2] = s[2]; }
};

/// Five masses on the ellipse in the lanes of one vector; lanes 5 to 7 rest at phi = 0 and pull on nothing.
struct EllipseChainModel {
  static constexpr int kStates = 10, kMasses = 5, kHandDegree = 7;
  double a, b, mass, k, damping, kHand, bHand;
  void rate(const V8* q, const V8* v, const Vec3& f, V8* acceleration) const {
    constexpr I8 kNext{1, 2, 3, 4, 5, 6, 7, 7}, kBefore{0, 0, 1, 2, 3, 4, 5, 6};
    constexpr V8 kSprung{1, 1, 1, 1, 0, 0, 0, 0};
    V8 s, c;
    sinCos(q[0], s, c);
    const V8 w = v[0], y = a * c, z = b * s, dy = -a * s, dz = b * c;
    const V8 pullY = k * y + damping * dy * w, pullZ = k * z + damping * dz * w;
    const V8 springY = (pullY - __builtin_shuffle(pullY, kNext)) * kSprung, springZ = (pullZ - __builtin_shuffle(pullZ, kNext)) * kSprung;
    V8 leftY = __builtin_shuffle(springY, kBefore), leftZ = __builtin_shuffle(springZ, kBefore);
    leftY[0] = f.y - kHand * y[0] - bHand * dy[0] * w[0];
    leftZ[0] = f.z - kHand * z[0] - bHand * dz[0] * w[0];
    const V8 force = dy * (leftY - springY) + dz * (leftZ - springZ);
    acceleration[0] = (force - mass * (a * a - b * b) * s * c * w * w) / (mass * (dy * dy + dz * dz));
  }
  void state(const V8* q, const V8* v, double* out) const {
    for (int i = 0; i < 5; ++i) out[i] = q[0][i], out[5 + i] = v[0][i];
  }
  void positions(const double* s, double* r) const {
    for (int i = 0; i < 5; ++i) r[3 * i] = 0, r[3 * i + 1] = a * std::cos(s[i]), r[3 * i + 2] = b * std::sin(s[i]);
  }
};

template <class T, int K, class Model>
Contender makeAdams(const BenchScene& scene, const Model& model) {
  AdamsForm<T, K, Model> form{.model = model};
  if constexpr (K == 2)
    for (int i = 0; i < K; ++i) form.q[i] = scene.start[i];
  if constexpr (K == 3) {
    double ru[3], rv[3], ruu[3], ruv[3], rvv[3];
    SphereShape{scene.experiment.constraint.shape.at("R")}.evaluate(scene.start[0], scene.start[1], form.q, ru, rv, ruu, ruv, rvv);
  }
  return makeLimitContender(scene, form);
}

}  // namespace

Contender makeMultistepLimit(const BenchScene& scene) {
  return visitSystem(scene, [&]<class System>(const System& s) -> Contender {
    if constexpr (std::is_same_v<System, CurveBead<EllipseShape, 6>>)
      return makeAdams<double, 1>(scene, EllipseModel{s.shape.a, s.shape.b, s.mass, s.kHand, s.bHand, (s.bHand + s.lambda) / s.mass});
    else if constexpr (std::is_same_v<System, SurfaceBead<TorusShape, true>>)
      return makeAdams<double, 2>(scene, TorusModel{s.shape.bigR, s.shape.small, s.mass, s.kHand, s.bHand, (s.bHand + s.lambda) / s.mass});
    else if constexpr (std::is_same_v<System, SurfaceBead<SaddleShape, true>>)
      return makeAdams<double, 2>(scene, SaddleModel{s.shape.a, s.shape.h, s.mass, s.kHand, s.bHand, (s.bHand + s.lambda) / s.mass});
    else if constexpr (std::is_same_v<System, SurfaceBead<SphereShape, true>>)
      return makeAdams<double, 3>(
          scene, SphereModel{1 / (s.shape.radius * s.shape.radius), s.mass, s.kHand, s.bHand, (s.bHand + s.lambda) / s.mass});
    else if constexpr (std::is_same_v<System, CurveChain<EllipseShape, 5, 6>>)
      return makeAdams<V8, 1>(scene, EllipseChainModel{s.shape.a, s.shape.b, s.mass, s.k, s.b, s.kHand, s.bHand});
    else throw FaultError(Fault{"scene", "is " + scene.name + ", which has no multistep form"});
  });
}

}  // namespace reachlab::bench
