#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#ifdef __AVX__
#include <immintrin.h>
#endif

#include "base/math/fused.h"

/// Numbers that are computed side by side in vector registers. Where the level of the processor has registers for all lanes, they are a
/// vector of the compiler. Elsewhere they are two halves, because g++ 12 keeps wider vectors in memory. The bits are the same either way,
/// since no operation adds across lanes. A comparison gives all ones or zero in each lane. Libraries for this were measured and rejected,
/// see docs/adr/0021-lanes-are-the-compilers-vectors.md. Any thread.
namespace reachlab {

namespace lanesDetail {
#if defined __AVX512F__
inline constexpr int kRegister = 8;
#elif defined __AVX__
inline constexpr int kRegister = 4;
#else
inline constexpr int kRegister = 2;
#endif

template <int Width>
struct Vectors;  // written out: g++ 12 drops a vector size that depends on a parameter
template <>
struct Vectors<2> {
  using Numbers = double __attribute__((vector_size(16)));
  using Marks = std::int64_t __attribute__((vector_size(16)));
};
template <>
struct Vectors<4> {
  using Numbers = double __attribute__((vector_size(32)));
  using Marks = std::int64_t __attribute__((vector_size(32)));
};
template <>
struct Vectors<8> {
  using Numbers = double __attribute__((vector_size(64)));
  using Marks = std::int64_t __attribute__((vector_size(64)));
};

/// Lanes in two parts, each a vector of the compiler or again two halves.
template <class Part>
struct Halves {
  using Number = std::remove_cvref_t<decltype(std::declval<const Part&>()[0])>;
  static constexpr int kPart = sizeof(Part) / sizeof(Number);
  Part low, high;

  Halves() = default;
  Halves(const Part& first, const Part& second) noexcept : low(first), high(second) {}
  template <class... Each>
  requires(sizeof...(Each) == 2 * kPart && (std::is_arithmetic_v<Each> && ...)) Halves(Each... each)
  noexcept : Halves(std::array<Number, 2 * kPart>{each...}, std::make_index_sequence<kPart>()) {}

  Number& operator[](int i) noexcept { return reinterpret_cast<Number*>(this)[i]; }
  Number operator[](int i) const noexcept { return i < kPart ? low[i] : high[i - kPart]; }

 private:
  template <std::size_t... I>
  Halves(const std::array<Number, 2 * kPart>& all, std::index_sequence<I...>) noexcept : low{all[I]...}, high{all[kPart + I]...} {}
};

template <int Width>
struct Of {
  using Numbers = Halves<typename Of<Width / 2>::Numbers>;
  using Marks = Halves<typename Of<Width / 2>::Marks>;
};
template <int Width>
requires(Width <= kRegister) struct Of<Width> : Vectors<Width> {
};

template <class T>
inline constexpr bool kInHalves = false;
template <class Part>
inline constexpr bool kInHalves<Halves<Part>> = true;
template <class B, class A>
concept HalvesWith = kInHalves<A> || kInHalves<B>;
template <class L>
concept Lanes = kInHalves<L> ||(!std::is_class_v<L> && requires(L x) { x[0], x* x; });

template <class T>
const auto& lowOf(const T& x) noexcept {
  if constexpr (kInHalves<T>) return x.low;
  else return x;
}
template <class T>
const auto& highOf(const T& x) noexcept {
  if constexpr (kInHalves<T>) return x.high;
  else return x;
}
/// `operation` on the low halves and on the high halves. A number counts for both.
template <class Operation, class... Operands>
[[gnu::always_inline]] inline auto byHalves(const Operation& operation, const Operands&... x) noexcept {
  using Part = decltype(operation(lowOf(x)...));
  return Halves<Part>(operation(lowOf(x)...), operation(highOf(x)...));
}
#define REACHLAB_OPERATOR(op)                                                       \
  template <class A, HalvesWith<A> B>                                               \
  [[gnu::always_inline]] inline auto operator op(const A& a, const B& b) noexcept { \
    return byHalves([](const auto& x, const auto& y) { return x op y; }, a, b);     \
  }
REACHLAB_OPERATOR(+)
REACHLAB_OPERATOR(-)
REACHLAB_OPERATOR(*)
REACHLAB_OPERATOR(/)
REACHLAB_OPERATOR(<)
REACHLAB_OPERATOR(<=)
REACHLAB_OPERATOR(>)
REACHLAB_OPERATOR(>=)
REACHLAB_OPERATOR(==)
REACHLAB_OPERATOR(|)
REACHLAB_OPERATOR(&)
#undef REACHLAB_OPERATOR
template <class Part>
[[gnu::always_inline]] inline Halves<Part> operator-(const Halves<Part>& a) noexcept {
  return {-a.low, -a.high};
}
template <class Part>
[[gnu::always_inline]] inline Halves<Part> operator~(const Halves<Part>& a) noexcept {
  return {~a.low, ~a.high};
}
#define REACHLAB_ASSIGNMENT(op)                                                                      \
  template <class Part, class B>                                                                     \
  [[gnu::always_inline]] inline Halves<Part>& operator op##=(Halves<Part>& a, const B& b) noexcept { \
    return a = a op b;                                                                               \
  }
REACHLAB_ASSIGNMENT(+)
REACHLAB_ASSIGNMENT(-)
REACHLAB_ASSIGNMENT(*)
REACHLAB_ASSIGNMENT(|)
#undef REACHLAB_ASSIGNMENT
}  // namespace lanesDetail

template <int Width>
using Lanes = typename lanesDetail::Of<Width>::Numbers;
/// What a comparison of Lanes<Width> gives.
template <int Width>
using LaneMarks = typename lanesDetail::Of<Width>::Marks;

/// A batch: the numbers that a kernel computes side by side in one pass (masses on a curve, columns of a matrix).
inline constexpr int kBatchLanes = 8;
using LaneBatch = Lanes<kBatchLanes>;

template <int Width>
constexpr int lanesFor(int count) noexcept {
  return (count + Width - 1) / Width;
}

template <class Lanes>
Lanes broadcast(double value) noexcept {
  return value - Lanes{};  // nothing to compute; 0 + value would be an addition, for the sign of -0
}
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L loadLanes(const double* from) noexcept {
  if constexpr (lanesDetail::kInHalves<L>) {
    using Part = decltype(L::low);
    return {loadLanes<Part>(from), loadLanes<Part>(from + L::kPart)};
  } else {
    L x;
    std::memcpy(&x, from, sizeof x);
    return x;
  }
}
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline void storeLanes(const L& x, double* to) noexcept {
  if constexpr (lanesDetail::kInHalves<L>) storeLanes(x.low, to), storeLanes(x.high, to + L::kPart);
  else std::memcpy(to, &x, sizeof x);
}

/// a b + c with one rounding in each lane, see fused.h. It calls the instruction of the processor, because g++ 12 takes a loop over the
/// lanes apart, lane by lane, where much other code is inlined around it.
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L mulAdd(const L& a, const L& b, const L& c) noexcept {
  if constexpr (lanesDetail::kInHalves<L>) {
    return {mulAdd(a.low, b.low, c.low), mulAdd(a.high, b.high, c.high)};
  } else {
#ifdef __AVX512F__
    if constexpr (sizeof(L) == 64) return L(_mm512_fmadd_pd(__m512d(a), __m512d(b), __m512d(c)));
#endif
#ifdef __FMA__
    if constexpr (sizeof(L) == 32) return L(_mm256_fmadd_pd(__m256d(a), __m256d(b), __m256d(c)));
    if constexpr (sizeof(L) == 16) return L(_mm_fmadd_pd(__m128d(a), __m128d(b), __m128d(c)));
#endif
    L sum;
    for (std::size_t i = 0; i < sizeof(L) / sizeof(double); ++i) sum[i] = __builtin_fma(a[i], b[i], c[i]);
    return sum;
  }
}
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L mulAdd(double a, const L& b, const L& c) noexcept {
  return mulAdd(broadcast<L>(a), b, c);
}

/// `yes` in the marked lanes, `no` in the rest.
template <class Marks, lanesDetail::Lanes L>
[[gnu::always_inline]] inline L choose(const Marks& marks, const L& yes, const L& no) noexcept {
  if constexpr (lanesDetail::kInHalves<L>) return {choose(marks.low, yes.low, no.low), choose(marks.high, yes.high, no.high)};
  else return marks ? yes : no;
}
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L magnitude(const L& x) noexcept {
  return choose(x < 0.0, L(-x), x);
}
/// Correctly rounded, as std::sqrt.
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L squareRoot(const L& x) noexcept {
  if constexpr (lanesDetail::kInHalves<L>) {
    return {squareRoot(x.low), squareRoot(x.high)};
  } else {
#ifdef __AVX512F__
    if constexpr (sizeof(L) == 64) return L(_mm512_maskz_sqrt_pd(__mmask8(-1), __m512d(x)));
#endif
#ifdef __AVX__
    if constexpr (sizeof(L) == 32) return L(_mm256_sqrt_pd(__m256d(x)));
#endif
    L root;
    for (std::size_t i = 0; i < sizeof(L) / sizeof(double); ++i) root[i] = std::sqrt(x[i]);
    return root;
  }
}

namespace lanesDetail {
template <int First, lanesDetail::Lanes L, std::size_t... I>
[[gnu::always_inline]] inline L window(const L& x, const L& y, std::index_sequence<I...>) noexcept {
  return __builtin_shufflevector(x, y, (First + static_cast<int>(I))...);
}
}  // namespace lanesDetail
/// Lanes 1 … of x, then the first lane of `after`.
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L next(const L& x, const L& after) noexcept {
  if constexpr (lanesDetail::kInHalves<L>) return {next(x.low, x.high), next(x.high, after.low)};
  else return lanesDetail::window<1>(x, after, std::make_index_sequence<sizeof(L) / sizeof(double)>());
}
/// The last lane of `before`, then all lanes of x except the last.
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L previous(const L& before, const L& x) noexcept {
  constexpr int kWidth = sizeof(L) / sizeof(double);
  if constexpr (lanesDetail::kInHalves<L>) return {previous(before.high, x.low), previous(x.low, x.high)};
  else return lanesDetail::window<kWidth - 1>(before, x, std::make_index_sequence<kWidth>());
}
/// The upper half of the lanes in the lower half, and zeros in the upper.
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L upperHalf(const L& x) noexcept {
  constexpr int kWidth = sizeof(L) / sizeof(double);
  if constexpr (lanesDetail::kInHalves<L>) return {x.high, decltype(x.high){}};
  else return lanesDetail::window<kWidth / 2>(x, L{}, std::make_index_sequence<kWidth>());
}

/// True if some lane is marked. Computed by halves, since lanes that are taken out one by one cost more than the arithmetic of a step.
template <class Marks>
bool anyLane(Marks marks) noexcept {
  if constexpr (lanesDetail::kInHalves<Marks>) {
    return anyLane(marks.low | marks.high);
  } else {
    constexpr int kWidth = sizeof(Marks) / sizeof(std::int64_t);
    if constexpr (kWidth == 8) marks |= __builtin_shufflevector(marks, marks, 4, 5, 6, 7, 0, 1, 2, 3);
    if constexpr (kWidth == 8) marks |= __builtin_shufflevector(marks, marks, 2, 3, 0, 1, 6, 7, 4, 5);
    if constexpr (kWidth == 4) marks |= __builtin_shufflevector(marks, marks, 2, 3, 0, 1);
    return (marks[0] | marks[1]) != 0;
  }
}

/// True for a sum of `x * 0.0` when nothing in it was infinite or not a number.
template <lanesDetail::Lanes L>
bool allZero(const L& x) noexcept {
  if constexpr (lanesDetail::kInHalves<L>) {
    return allZero(x.low + x.high);
  } else {
#ifdef __AVX__
    if constexpr (sizeof(L) == 32) return _mm256_movemask_pd(_mm256_cmp_pd(__m256d(x), _mm256_setzero_pd(), _CMP_NEQ_UQ)) == 0;
#endif
    double sum = 0;
    for (std::size_t i = 0; i < sizeof(L) / sizeof(double); ++i) sum += x[i];
    return sum == 0;
  }
}

}  // namespace reachlab
