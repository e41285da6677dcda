#include "sim/predict/peaks.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>

namespace reachlab::predict {
namespace {

constexpr double kEqual = 1e-12;        // relative difference below which two maxima are one and the same height
constexpr double kWorthRefining = 0.9;  // of the largest sample: a lower one cannot become the largest between samples

struct Peak {
  double value = 0, time = 0;
};

// Where |v| is largest within [lo, hi]; the error of the value is the square of that of the time.
Peak refine(const std::function<double(double)>& velocity, double lo, double hi) {
  constexpr int kBits = 27;  // of the time: half of those of the value
  const double time = boost::math::tools::brent_find_minima([&](double t) { return -std::abs(velocity(t)); }, lo, hi, kBits).first;
  return {velocity(time), time};
}

// Zero of the slope within [lo, hi] where it changes sign (Illinois variant of the false position).
double findTurn(const std::function<double(double)>& slope, double lo, double hi) {
  double flo = slope(lo), fhi = slope(hi);
  if (flo == 0) return lo;
  if (fhi == 0) return hi;
  if ((flo > 0) == (fhi > 0)) return std::abs(flo) < std::abs(fhi) ? lo : hi;
  int side = 0;
  for (int i = 0; i < 60 && hi - lo > 1e-15 * hi; ++i) {
    const double mid = std::clamp((lo * fhi - hi * flo) / (fhi - flo), lo, hi), f = slope(mid);
    if (f == 0) return mid;
    if ((f > 0) == (fhi > 0)) {
      hi = mid, fhi = f;
      if (side == 1) flo /= 2;
      side = 1;
    } else {
      lo = mid, flo = f;
      if (side == -1) fhi /= 2;
      side = -1;
    }
  }
  return (lo + hi) / 2;
}

template <class Refine>
Peak largest(const std::vector<double>& samples, double duration, const Refine& refined) {
  const auto last = static_cast<int>(samples.size()) - 1;
  double most = 0;
  for (const double v : samples) most = std::max(most, std::abs(v));
  Peak best{samples.front(), 0};
  for (int i = 0; i <= last; ++i) {
    const double here = std::abs(samples[i]);
    if (here < kWorthRefining * most || (i > 0 && std::abs(samples[i - 1]) > here) || (i < last && std::abs(samples[i + 1]) > here))
      continue;
    Peak peak{samples[i], duration * i / last};
    if (i > 0 && i < last) {
      const Peak between = refined(duration * (i - 1) / last, duration * (i + 1) / last);
      if (std::abs(between.value) >= here) peak = between;
    }
    if (std::abs(peak.value) > std::abs(best.value) * (1 + kEqual)) best = peak;
  }
  return best;
}

}  // namespace

void findPeaks(Prediction& prediction) {
  const double T = prediction.duration;
  const int count = prediction.scanCount();
  std::vector<double> hand(count + 1), mass(count + 1);
  const auto massVelocity = [&](double t) { return prediction.objectVelocityAt(t); };
  prediction.sampleVelocities(hand, mass);
  const Peak handPeak = largest(hand, T, [&](double lo, double hi) {
    const double t = findTurn([&](double s) { return prediction.handAt(s).acceleration; }, lo, hi);
    return Peak{prediction.handAt(t).velocity, t};
  });
  prediction.handPeak = handPeak.value;
  prediction.handPeakTime = handPeak.time;
  prediction.objectPeak = largest(mass, T, [&](double lo, double hi) { return refine(massVelocity, lo, hi); }).value;
}

}  // namespace reachlab::predict
