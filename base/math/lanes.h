#pragma once
#include <cstdint>
#include <cstring>
#include <type_traits>
#ifdef __AVX__
#include <immintrin.h>
#endif

#include "base/math/fused.h"

/// Numbers that are computed side by side: vectors of the compiler, kept in registers and split where the processor has narrower registers.
/// The compiler provides the operators and comparisons. A comparison sets all bits or no bit in each lane. Libraries for this were measured
/// and rejected, see docs/adr/0021-lanes-are-the-compilers-vectors.md. Any thread.
namespace reachlab {

namespace lanesDetail {
template <int Width>
struct Of;  // written out: g++ 12 drops a vector size that depends on a parameter
template <>
struct Of<2> {
  using Numbers = double __attribute__((vector_size(16)));
  using Marks = std::int64_t __attribute__((vector_size(16)));
};
template <>
struct Of<4> {
  using Numbers = double __attribute__((vector_size(32)));
  using Marks = std::int64_t __attribute__((vector_size(32)));
};
template <>
struct Of<8> {
  using Numbers = double __attribute__((vector_size(64)));
  using Marks = std::int64_t __attribute__((vector_size(64)));
};
template <class L>
concept Lanes = !std::is_class_v<L> && requires(L x) {
  x[0], x* x;
};
}  // namespace lanesDetail

template <int Width>
using Lanes = typename lanesDetail::Of<Width>::Numbers;
/// The result of a comparison of Lanes<Width>. It also says which lane of two vectors a shuffle takes.
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
template <class Lanes>
Lanes loadLanes(const double* from) noexcept {
  Lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
template <class Lanes>
void storeLanes(const Lanes& x, double* to) noexcept {
  std::memcpy(to, &x, sizeof x);
}

/// a b + c with one rounding in each lane, see fused.h. It uses the processor's instruction of this width where there is one, because g++
/// 12 splits a loop over the lanes into single operations where much else is inlined around it.
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L mulAdd(const L& a, const L& b, const L& c) noexcept {
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
template <lanesDetail::Lanes L>
[[gnu::always_inline]] inline L mulAdd(double a, const L& b, const L& c) noexcept {
  return mulAdd(broadcast<L>(a), b, c);
}

template <lanesDetail::Lanes L>
L magnitude(const L& x) noexcept {
  return x < 0 ? -x : x;
}

/// Some lane is marked: by halves, since lanes taken out one by one cost more than the step's arithmetic.
template <class Marks>
bool anyLane(Marks marks) noexcept {
  constexpr int kWidth = sizeof(Marks) / sizeof(std::int64_t);
  if constexpr (kWidth == 8) marks |= __builtin_shufflevector(marks, marks, 4, 5, 6, 7, 0, 1, 2, 3);
  if constexpr (kWidth == 8) marks |= __builtin_shufflevector(marks, marks, 2, 3, 0, 1, 6, 7, 4, 5);
  if constexpr (kWidth == 4) marks |= __builtin_shufflevector(marks, marks, 2, 3, 0, 1);
  return (marks[0] | marks[1]) != 0;
}

/// True for a sum of `x * 0.0` when nothing in it was infinite or not a number.
template <lanesDetail::Lanes L>
bool allZero(const L& x) noexcept {
#ifdef __AVX__
  if constexpr (sizeof(L) == 32) return _mm256_movemask_pd(_mm256_cmp_pd(__m256d(x), _mm256_setzero_pd(), _CMP_NEQ_UQ)) == 0;
#endif
  double sum = 0;
  for (std::size_t i = 0; i < sizeof(L) / sizeof(double); ++i) sum += x[i];
  return sum == 0;
}

}  // namespace reachlab
