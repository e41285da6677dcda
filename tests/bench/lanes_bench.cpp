#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <experimental/simd>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/math/lanes.h"
#include "base/system/os.h"
#include "constraints/formula/sincos.h"
#include "bench/measure.h"

// lanes_bench: what a library for vectors of lanes costs beside the compiler's own vectors, on the loops that a tick spends its time in.
// Three forms of each: the compiler's vectors (what Reachlab is written in), std::experimental::simd, Highway (compiled for this processor).
// Nanoseconds of processor time for one call, median of rounds in turns; the forms' results agree to rounding, or the program says so.
namespace {

namespace stdx = std::experimental;
namespace hn = hwy::HWY_NAMESPACE;
using reachlab::os::threadProcessorTime;

constexpr int kRounds = 101, kCalls = 4000;

void use(const void* data) { asm volatile("" : : "r"(data) : "memory"); }

using V4 = reachlab::lanesDetail::Vectors<4>::Numbers;
using V8 = reachlab::lanesDetail::Vectors<8>::Numbers;
using I8 = reachlab::lanesDetail::Vectors<8>::Marks;
using S4 = stdx::simd<double, stdx::simd_abi::deduce_t<double, 4>>;
using S8 = stdx::simd<double, stdx::simd_abi::deduce_t<double, 8>>;
const hn::FixedTag<double, 4> h4;
const hn::FixedTag<double, 8> h8;
using H4 = hn::VFromD<decltype(h4)>;
using H8 = hn::VFromD<decltype(h8)>;

template <class V>
V load(const double* from) {
  if constexpr (std::is_same_v<V, H4>) return hn::LoadU(h4, from);
  else if constexpr (std::is_same_v<V, H8>) return hn::LoadU(h8, from);
  else if constexpr (std::is_same_v<V, S4> || std::is_same_v<V, S8>) return V(from, stdx::element_aligned);
  else {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
  }
}
template <class V>
void store(const V& v, double* to) {
  if constexpr (std::is_same_v<V, H4>) hn::StoreU(v, h4, to);
  else if constexpr (std::is_same_v<V, H8>) hn::StoreU(v, h8, to);
  else if constexpr (std::is_same_v<V, S4> || std::is_same_v<V, S8>) v.copy_to(to, stdx::element_aligned);
  else std::memcpy(to, &v, sizeof v);
}
template <class V>
V all(double x) {
  if constexpr (std::is_same_v<V, H4>) return hn::Set(h4, x);
  else if constexpr (std::is_same_v<V, H8>) return hn::Set(h8, x);
  else if constexpr (std::is_same_v<V, S4> || std::is_same_v<V, S8>) return V(x);
  else return V{} + x;
}

// The history of Adams-Bashforth-Moulton for eight states (sim/dynamics/methods/abm.h, Row::keep).
struct History {
  double sums[7][8], weighted[8], ahead[8], f[8];
};
template <class V>
void keepHistory(History& h) {
  constexpr double kGamma[7] = {1.0, 1.0 / 2, 5.0 / 12, 3.0 / 8, 251.0 / 720, 95.0 / 288, 19087.0 / 60480};
  const V deviation = load<V>(h.f) - load<V>(h.sums[0]);
  store<V>(load<V>(h.weighted) + all<V>(3.1) * deviation, h.ahead);
  V sum = all<V>(0), total = all<V>(0);
  for (int j = 6; j >= 0; --j) {
    sum = sum + (load<V>(h.sums[j]) + deviation);
    store<V>(sum, h.sums[j]);
    total = total + all<V>(kGamma[j]) * sum;
  }
  store<V>(all<V>(1e-3) * total, h.weighted);
}

// A whole tick of it for six states in eight lanes, around a right-hand side of nothing but sums: gathered with zeros behind, compared, one
// answer for all lanes, the rates' lanes moved to the places'.
struct Step {
  double y[6], sums[7][8], weighted[8], ahead[8], scale[8], next[6];
};
template <class V, std::size_t... I>
V gather(const double* from, std::index_sequence<I...>) {
  if constexpr (std::is_same_v<V, V8>) return V{(I < 6 ? from[I] : 0.0)...};
  else if constexpr (std::is_same_v<V, S8>) return S8([&](auto i) { return i < 6 ? from[i < 6 ? i : 0] : 0.0; });
  else return hn::MaskedLoad(hn::FirstN(h8, 6), h8, from);
}
template <class V>
void scatter(const V& row, double* to) {
  if constexpr (std::is_same_v<V, H8>) {
    hn::BlendedStore(row, hn::FirstN(h8, 6), h8, to);
  } else {
    for (int i = 0; i < 6; ++i) to[i] = row[i];
  }
}
template <class V>
bool anyBeyond(const V& x, const V& most) {
  if constexpr (std::is_same_v<V, V8>) return reachlab::anyLane(~(reachlab::magnitude(x) <= most));
  else if constexpr (std::is_same_v<V, S8>) return stdx::any_of(!(abs(x) <= most));
  else return !hn::AllTrue(h8, hn::Abs(x) <= most);
}
template <class V>
V ratesToPlaces(const V& x) {  // lanes 3, 4, 5 in lanes 0, 1, 2
  if constexpr (std::is_same_v<V, V8>) return __builtin_shuffle(x, V8{}, I8{3, 4, 5, 8, 8, 8, 8, 8});
  else if constexpr (std::is_same_v<V, S8>) return S8([&](auto i) { return i < 3 ? static_cast<double>(x[i < 3 ? i + 3 : 0]) : 0.0; });
  else
    return hn::IfThenElseZero(hn::FirstN(h8, 3),
                              hn::TableLookupLanes(x, hn::SetTableIndices(h8, std::array<std::int64_t, 8>{3, 4, 5, 5, 5, 5, 5, 5}.data())));
}
template <class V>
void step(Step& s) {
  constexpr auto kIndices = std::make_index_sequence<8>();
  constexpr double kGamma[7] = {1.0, 1.0 / 2, 5.0 / 12, 3.0 / 8, 251.0 / 720, 95.0 / 288, 19087.0 / 60480};
  double predicted[6], f[6];
  scatter<V>(gather<V>(s.y, kIndices) + all<V>(1e-3) * load<V>(s.ahead), predicted);
  for (int i = 0; i < 3; ++i) f[i] = predicted[3 + i], f[3 + i] = -40 * predicted[i];
  V deviation = gather<V>(f, kIndices) - load<V>(s.sums[0]);
  const V correction = all<V>(1e-3) * deviation, most = all<V>(1e6) * load<V>(s.scale);
  scatter<V>(gather<V>(predicted, kIndices) + all<V>(0.3) * correction, s.next);
  if (anyBeyond<V>(correction, all<V>(0.5) * most)) s.next[0] = 0;
  deviation = deviation + all<V>(3e-4) * ratesToPlaces<V>(deviation);
  store<V>(load<V>(s.weighted) + all<V>(3.1) * deviation, s.ahead);
  V sum = all<V>(0), total = all<V>(0);
  for (int j = 6; j >= 0; --j) {
    sum = sum + (load<V>(s.sums[j]) + deviation);
    store<V>(all<V>(0.1) * sum, s.sums[j]);
    total = total + all<V>(kGamma[j]) * sum;
  }
  store<V>(all<V>(1e-3) * total, s.weighted);
  std::memcpy(s.y, s.next, sizeof s.y);
}

// One exact step of a chain of five: ten columns of twelve rows (sim/dynamics/exact/dense_core.h).
struct Dense {
  double columns[10][12], state[12], next[12];
};
template <class V>
void stepDense(Dense& d) {
  V even[3], odd[3];
  for (int g = 0; g < 3; ++g) even[g] = load<V>(d.state + 4 * g), odd[g] = all<V>(0);
#pragma GCC unroll 16
  for (int j = 0; j < 10; j += 2)
    for (int g = 0; g < 3; ++g) {
      even[g] = even[g] + load<V>(d.columns[j] + 4 * g) * all<V>(d.state[j]);
      odd[g] = odd[g] + load<V>(d.columns[j + 1] + 4 * g) * all<V>(d.state[j + 1]);
    }
  for (int g = 0; g < 3; ++g) store<V>(even[g] + odd[g], d.next + 4 * g);
  std::memcpy(d.state, d.next, sizeof d.state);
}

// The springs between eight masses in lanes: each needs its neighbours' numbers (sim/dynamics/systems/batch_springs.h).
struct Springs {
  double x[8], v[8], stiffness[8], inverseMass[8];
};
template <class V>
V fromNext(const V& x) {  // lane i + 1 in lane i, zero in the last
  if constexpr (std::is_same_v<V, V8>) return __builtin_shuffle(x, V8{}, I8{1, 2, 3, 4, 5, 6, 7, 8});
  else if constexpr (std::is_same_v<V, S8>)
    return S8([&](auto i) { return i + 1 < 8 ? static_cast<double>(x[i + 1 < 8 ? i + 1 : 7]) : 0.0; });
  else
    return hn::IfThenElse(hn::FirstN(h8, 7),
                          hn::TableLookupLanes(x, hn::SetTableIndices(h8, std::array<std::int64_t, 8>{1, 2, 3, 4, 5, 6, 7, 7}.data())),
                          hn::Zero(h8));
}
template <class V>
V fromPrevious(const V& x) {
  if constexpr (std::is_same_v<V, V8>) return __builtin_shuffle(V8{}, x, I8{7, 8, 9, 10, 11, 12, 13, 14});
  else if constexpr (std::is_same_v<V, S8>) return S8([&](auto i) { return i > 0 ? static_cast<double>(x[i > 0 ? i - 1 : 0]) : 0.0; });
  else
    return hn::IfThenElse(hn::FirstN(h8, 1), hn::Zero(h8),
                          hn::TableLookupLanes(x, hn::SetTableIndices(h8, std::array<std::int64_t, 8>{0, 0, 1, 2, 3, 4, 5, 6}.data())));
}
template <class V>
void pushSprings(Springs& s) {
  const V x = load<V>(s.x), v = load<V>(s.v);
  const V tension = load<V>(s.stiffness) * (fromNext(x) - x);
  const V a = load<V>(s.inverseMass) * (tension - fromPrevious(tension));
  const V faster = v + all<V>(1e-3) * a;
  store<V>(faster, s.v);
  store<V>(x + all<V>(1e-3) * faster, s.x);
}

// Sine and cosine of eight angles (constraints/formula/sincos.h). The compiler's form is the plain loop that it puts in lanes itself.
struct Waves {
  double x[8], sine[8], cosine[8];
};
using namespace reachlab::constraints::sincosDetail;
void wavesPlain(Waves& w) {
  double s[8], c[8];
  std::uint64_t far = 0;
#pragma GCC unroll 1
  for (int i = 0; i < 8; ++i) far |= reachlab::constraints::sinCosNear(w.x[i], s[i], c[i]);
  std::memcpy(w.sine, s, sizeof s), std::memcpy(w.cosine, c, sizeof c);
  if (far != 0) w.sine[0] = 0;
}
template <class V, class MulAdd>
void series(const V& y, const MulAdd& mulAdd, V& s, V& c) {
  const V z = y * y, w = z * z;
  const auto k = [](double x) { return all<V>(x); };
  const V sinSeries =
      mulAdd(w, mulAdd(w, mulAdd(z, k(kSin[5]), k(kSin[4])), mulAdd(z, k(kSin[3]), k(kSin[2]))), mulAdd(z, k(kSin[1]), k(kSin[0])));
  const V cosSeries =
      mulAdd(w, mulAdd(w, mulAdd(z, k(kCos[5]), k(kCos[4])), mulAdd(z, k(kCos[3]), k(kCos[2]))), mulAdd(z, k(kCos[1]), k(kCos[0])));
  s = mulAdd(y * z, sinSeries, y);
  c = k(1.0) - mulAdd(k(0) - w, cosSeries, k(0.5) * z);
}
void wavesStd(Waves& w) {
  const S8 x = load<S8>(w.x);
  const auto mulAdd = [](const S8& a, const S8& b, const S8& c) { return stdx::fma(a, b, c); };
  const S8 quadrant = stdx::nearbyint(x * S8(kTwoOverPi)), minus = -quadrant;
  const S8 y = mulAdd(minus, S8(kHalfPi3), mulAdd(minus, S8(kHalfPi2), mulAdd(minus, S8(kHalfPi1), x)));
  S8 s, c;
  series<S8>(y, mulAdd, s, c);
  const auto rest = quadrant - S8(4) * stdx::floor(quadrant * S8(0.25));  // 0, 1, 2, 3
  const auto swap = rest == S8(1) || rest == S8(3);
  S8 sine = s, cosine = c;
  stdx::where(swap, sine) = c;
  stdx::where(swap, cosine) = s;
  stdx::where(rest >= S8(2), sine) = -sine;
  stdx::where(rest == S8(1) || rest == S8(2), cosine) = -cosine;
  store(sine, w.sine), store(cosine, w.cosine);
  if (stdx::any_of(stdx::abs(x) > S8(1e5))) w.sine[0] = 0;
}
void wavesHighway(Waves& w) {
  const hn::RebindToUnsigned<decltype(h8)> u8;
  const H8 x = load<H8>(w.x);
  const auto mulAdd = [](H8 a, H8 b, H8 c) { return hn::MulAdd(a, b, c); };
  const H8 shifted = mulAdd(x, all<H8>(kTwoOverPi), all<H8>(kRound)), quadrant = shifted - all<H8>(kRound);
  const auto q = hn::BitCast(u8, shifted);
  const H8 y =
      hn::NegMulAdd(quadrant, all<H8>(kHalfPi3), hn::NegMulAdd(quadrant, all<H8>(kHalfPi2), hn::NegMulAdd(quadrant, all<H8>(kHalfPi1), x)));
  H8 s, c;
  series<H8>(y, mulAdd, s, c);
  const auto swap = hn::MaskFromVec(hn::BitCast(h8, hn::Zero(u8) - hn::And(q, hn::Set(u8, 1))));
  const auto sineSign = hn::ShiftLeft<62>(hn::And(q, hn::Set(u8, 2)));
  const auto cosineSign = hn::ShiftLeft<62>(hn::And(q + hn::Set(u8, 1), hn::Set(u8, 2)));
  store(hn::Xor(hn::IfThenElse(swap, c, s), hn::BitCast(h8, sineSign)), w.sine);
  store(hn::Xor(hn::IfThenElse(swap, s, c), hn::BitCast(h8, cosineSign)), w.cosine);
  if (!hn::AllTrue(h8, hn::Abs(x) <= all<H8>(1e5))) w.sine[0] = 0;
}

struct Kernel {
  std::string name;
  std::array<std::function<double(std::array<double, 16>&)>, 3> forms;  // ns a call; results into the array
};

template <class Data, class Step>
double measure(const Data& start, const Step& step, const double* result, Data& data, std::array<double, 16>& out, int count) {
  data = start;
  const std::int64_t before = threadProcessorTime();
  for (int call = 0; call < kCalls; ++call) {
    step(data);
    use(&data);
  }
  const double ns = static_cast<double>(threadProcessorTime() - before) / kCalls;
  for (int i = 0; i < count; ++i) out[i] = result[i];
  return ns;
}

template <class Data>
Kernel kernel(const std::string& name, const Data& start, double* (*result)(Data&), int count, void (*a)(Data&), void (*b)(Data&),
              void (*c)(Data&)) {
  Kernel k{name, {}};
  const std::array<void (*)(Data&), 3> steps{a, b, c};
  for (int i = 0; i < 3; ++i)
    k.forms[i] = [=](std::array<double, 16>& out) {
      static Data data;
      return measure(start, steps[i], result(data), data, out, count);
    };
  return k;
}

}  // namespace

int main() {
  History history{};
  for (int i = 0; i < 8; ++i) history.f[i] = 0.1 * (i + 1);
  Step start{};
  for (int i = 0; i < 6; ++i) start.y[i] = 0.1 * i;
  for (double& scale : start.scale) scale = 1;
  Dense dense{};
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 10; ++i) dense.columns[j][i] = i == j ? -1e-3 : 1e-4 * std::sin(3 * i + 5 * j);
  for (int i = 0; i < 10; ++i) dense.state[i] = 0.1 * (i + 1);
  Springs springs{};
  for (int i = 0; i < 8; ++i) springs.x[i] = 0.01 * std::sin(i), springs.stiffness[i] = i < 7 ? 600 : 0, springs.inverseMass[i] = 1 / 0.6;
  Waves waves{};
  for (int i = 0; i < 8; ++i) waves.x[i] = 1.3 * i - 3;

  const std::vector<Kernel> kernels{
      kernel<History>(
          "Adams history, 8 states", history, [](History& h) { return h.ahead; }, 8, keepHistory<V8>, keepHistory<S8>, keepHistory<H8>),
      kernel<Step>(
          "Adams step, 6 states", start, [](Step& s) { return s.y; }, 6, step<V8>, step<S8>, step<H8>),
      kernel<Dense>(
          "exact step, chain of 5", dense, [](Dense& d) { return d.state; }, 10, stepDense<V4>, stepDense<S4>, stepDense<H4>),
      kernel<Springs>(
          "springs of 8 masses", springs, [](Springs& s) { return s.x; }, 8, pushSprings<V8>, pushSprings<S8>, pushSprings<H8>),
      kernel<Waves>(
          "sine and cosine of 8", waves, [](Waves& w) { return w.sine; }, 16, wavesPlain, wavesStd, wavesHighway)};
  std::printf("%-26s %10s %10s %8s %10s %8s\n", "ns a call", "compiler", "std simd", "ratio", "Highway", "ratio");
  bool agree = true;
  for (const Kernel& k : kernels) {
    std::array<std::vector<double>, 3> times;
    std::array<std::array<double, 16>, 3> results{};
    for (int round = 0; round < kRounds; ++round)
      for (int i = 0; i < 3; ++i) times[i].push_back(k.forms[i](results[i]));
    std::array<double, 3> median{};
    for (int i = 0; i < 3; ++i) {
      std::nth_element(times[i].begin(), times[i].begin() + kRounds / 2, times[i].end());
      median[i] = times[i][kRounds / 2];
      for (int n = 0; n < 16; ++n)
        if (!(std::abs(results[i][n] - results[0][n]) <= 1e-9 * (1 + std::abs(results[0][n])))) {
          std::printf("%s: form %d differs: %.17g, not %.17g\n", k.name.c_str(), i, results[i][n], results[0][n]);
          agree = false;
        }
    }
    std::printf("%-26s %10.2f %10.2f %8.2f %10.2f %8.2f\n", k.name.c_str(), median[0], median[1], median[1] / median[0], median[2],
                median[2] / median[0]);
  }
  return agree ? 0 : 1;
}
