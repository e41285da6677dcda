#include <immintrin.h>
#include <sleef.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

#include "base/math/elementary.h"
#include "base/system/os.h"
#include "constraints/formula/sincos.h"
#include "bench/measure.h"
#include "bench/quad.h"

// elementary_bench: sine and cosine together, one angle at a time and eight: the C library, constraints/formula/sincos.h, and the forms of SLEEF
// that give the same bits at every width (cinz without fused operations, finz with). Nanoseconds of processor time an angle, median of
// rounds; the largest error against 34 digits, absolute and in units of the last place; what an angle costs that waits for the one before.
// Then the other functions of formulas: the C library's, and those of base/math/elementary.h, with their errors against 50 digits.
namespace {

using reachlab::bench::Quad;
using reachlab::os::threadProcessorTime;

constexpr int kAngles = 1024, kRounds = 41, kRepeats = 20;

struct Data {
  alignas(64) double x[kAngles];
  alignas(64) double sine[kAngles], cosine[kAngles];
};

template <class Compute>
void report(const char* name, Data& d, const Compute& compute) {
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const std::int64_t before = threadProcessorTime();
    for (int i = 0; i < kRepeats; ++i) {
      compute(d);
      asm volatile("" : : "r"(&d) : "memory");
    }
    times.push_back(static_cast<double>(threadProcessorTime() - before) / (kRepeats * kAngles));
  }
  std::nth_element(times.begin(), times.begin() + kRounds / 2, times.end());
  double largest = 0, ulps = 0;
  for (int i = 0; i < kAngles; ++i) {
    const auto exact = reachlab::bench::sineCosine(Quad(d.x[i]));
    for (const auto& [value, reference] : {std::pair{d.sine[i], exact.sine}, std::pair{d.cosine[i], exact.cosine}}) {
      const double error = static_cast<double>(reachlab::bench::absolute(Quad(value) - reference));
      const double size = std::abs(static_cast<double>(reference));
      largest = std::max(largest, error);
      ulps = std::max(ulps, error / (std::nextafter(size, INFINITY) - size));
    }
  }
  std::printf("  %-28s %8.2f ns %10.1e %8.2f ulp\n", name, times[kRounds / 2], largest, ulps);
}

// One by one; each result is waited for by memory, not by the next angle.
template <class SinCos>
void reportSingly(const char* name, Data& d, const SinCos& sinCos) {
  report(name, d, [&](Data& all) {
    for (int i = 0; i < kAngles; ++i) {
      sinCos(all.x[i], all.sine[i], all.cosine[i]);
      asm volatile("" : : "x"(all.sine[i]));
    }
  });
}
template <class SinCos>
void reportLatency(const char* name, const SinCos& sinCos) {
  constexpr int kChain = 5000;
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    double x = 0.7;
    const std::int64_t before = threadProcessorTime();
    for (int i = 0; i < kChain; ++i) {
      double s, c;
      sinCos(x, s, c);
      x = s + c + 0.1;
    }
    asm volatile("" : : "x"(x));
    times.push_back(static_cast<double>(threadProcessorTime() - before) / kChain);
  }
  std::nth_element(times.begin(), times.begin() + kRounds / 2, times.end());
  std::printf("  %-28s %8.2f ns\n", name, times[kRounds / 2]);
}

constexpr auto kLibm = [](double x, double& s, double& c) { s = std::sin(x), c = std::cos(x); };
constexpr auto kOwn = [](double x, double& s, double& c) { reachlab::constraints::sinCos(x, s, c); };
constexpr auto kCinz = [](double x, double& s, double& c) {
  const auto r = Sleef_cinz_sincosd1_u10purec(x);
  s = r.x, c = r.y;
};
constexpr auto kFinz = [](double x, double& s, double& c) {
  const auto r = Sleef_finz_sincosd1_u10purecfma(x);
  s = r.x, c = r.y;
};

void ownEight(Data& d) {
  for (int i = 0; i < kAngles; i += 8) {
    double s[8], c[8];
    std::uint64_t far = 0;
#pragma GCC unroll 1
    for (int k = 0; k < 8; ++k) far |= reachlab::constraints::sinCosNear(d.x[i + k], s[k], c[k]);
    std::memcpy(d.sine + i, s, sizeof s), std::memcpy(d.cosine + i, c, sizeof c);
    asm volatile("" : : "r"(far));
  }
}

using Real = boost::multiprecision::cpp_bin_float_50;

// ns a call, median of rounds, and the largest error in units of the last place.
template <class Function, class Exact>
std::pair<double, double> priceAndError(const std::vector<double>& places, const Function& function, const Exact& exact) {
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const std::int64_t before = threadProcessorTime();
    for (int i = 0; i < kRepeats; ++i)
      for (const double x : places) {
        const double y = function(x);
        asm volatile("" : : "x"(y));
      }
    times.push_back(static_cast<double>(threadProcessorTime() - before) / static_cast<double>(kRepeats * places.size()));
  }
  std::nth_element(times.begin(), times.begin() + kRounds / 2, times.end());
  double ulps = 0;
  for (const double x : places) {
    const Real right = exact(Real(x));
    const double size = std::abs(static_cast<double>(right));
    ulps = std::max(ulps, std::abs(static_cast<double>((Real(function(x)) - right) / (std::nextafter(size, INFINITY) - size))));
  }
  return {times[kRounds / 2], ulps};
}

template <class Theirs, class Ours, class Exact>
void reportFunction(const char* name, double lo, double hi, const Theirs& theirs, const Ours& ours, const Exact& exact) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(lo, hi);
  std::vector<double> places(kAngles);
  for (double& x : places) x = uniform(random);
  const auto [before, wrong] = priceAndError(places, theirs, exact);
  const auto [now, off] = priceAndError(places, ours, exact);
  std::printf("  %-10s %6.1f ns %5.2f ulp %10.1f ns %5.2f ulp\n", name, before, wrong, now, off);
}

}  // namespace

int main() {
  Data d;
  std::mt19937_64 random(1);
  for (const double range : {3.2, 100.0, 1e5}) {
    std::uniform_real_distribution<double> uniform(-range, range);
    for (double& x : d.x) x = uniform(random);
    std::printf("|x| < %g                        an angle   absolute    error\n", range);
    reportSingly("C library", d, kLibm);
    reportSingly("sincos.h", d, kOwn);
    reportSingly("SLEEF finz", d, kFinz);
    reportSingly("SLEEF cinz", d, kCinz);
    report("sincos.h, eight", d, ownEight);
#ifdef __AVX512F__
    report("SLEEF finz, eight (AVX-512)", d, [](Data& all) {
      for (int i = 0; i < kAngles; i += 8) {
        const auto r = Sleef_finz_sincosd8_u10avx512f(_mm512_load_pd(all.x + i));
        _mm512_store_pd(all.sine + i, r.x), _mm512_store_pd(all.cosine + i, r.y);
      }
    });
    report("SLEEF cinz, eight (AVX-512)", d, [](Data& all) {
      for (int i = 0; i < kAngles; i += 8) {
        const auto r = Sleef_cinz_sincosd8_u10avx512fnofma(_mm512_load_pd(all.x + i));
        _mm512_store_pd(all.sine + i, r.x), _mm512_store_pd(all.cosine + i, r.y);
      }
    });
#endif
#ifdef __AVX2__
    report("SLEEF finz, four (AVX2)", d, [](Data& all) {
      for (int i = 0; i < kAngles; i += 4) {
        const auto r = Sleef_finz_sincosd4_u10avx2(_mm256_load_pd(all.x + i));
        _mm256_store_pd(all.sine + i, r.x), _mm256_store_pd(all.cosine + i, r.y);
      }
    });
#endif
  }
  std::printf("one after the other\n");
  reportLatency("C library", kLibm);
  reportLatency("sincos.h", kOwn);
  reportLatency("SLEEF finz", kFinz);
  reportLatency("SLEEF cinz", kCinz);
  std::printf("functions of formulas      C library       base/math/elementary.h\n");
#define REPORT(name, lo, hi)                                                                                        \
  reportFunction(                                                                                                   \
      #name, lo, hi, [](double x) { return std::name(x); }, [](double x) { return reachlab::elementary::name(x); }, \
      [](const Real& x) { return Real(name(x)); })
  REPORT(exp, -3, 3);
  REPORT(log, 0.1, 10);
  REPORT(tan, -3, 3);
  REPORT(asin, -1, 1);
  REPORT(acos, -1, 1);
  REPORT(atan, -3, 3);
  REPORT(sinh, -3, 3);
  REPORT(cosh, -3, 3);
  REPORT(tanh, -3, 3);
  reportFunction(
      "x^1.7", 0.1, 10, [](double x) { return std::pow(x, 1.7); }, [](double x) { return reachlab::elementary::pow(x, 1.7); },
      [](const Real& x) { return Real(pow(x, Real(1.7))); });
}
