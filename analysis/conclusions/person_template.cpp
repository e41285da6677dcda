#include "analysis/conclusions/person_template.h"

#include <algorithm>
#include <cmath>

#include "analysis/measures/movement.h"
#include "analysis/measures/statistics.h"
#include "analysis/trials/trial_data.h"

namespace reachlab::analysis {
namespace {

constexpr double kStep = 1.0 / 200, kFirst = -0.6, kLast = 1.6;  // of s
constexpr double kSmoothing = 0.06;                              // of s: width over which the variance is averaged
constexpr double kMinScatter = 0.1;                              // of the largest
constexpr int kRounds = 3;
constexpr double kLeastSpread = 1e-6;  // variance of ln T below which the shape cannot change with it

std::size_t gridSize() { return static_cast<std::size_t>(std::lround((kLast - kFirst) / kStep)) + 1; }

/// The window on the template's grid; NaN where it has no samples.
void layOver(const FitWindow& window, const MovementFit& place, std::vector<double>& out) {
  out.assign(gridSize(), kNotMeasured);
  const double end = window.begin + static_cast<double>(window.velocity.size() - 1) / window.rate;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double t = place.onset + place.duration * (kFirst + kStep * static_cast<double>(i));
    if (t >= window.begin && t <= end) out[i] = smoothValueAt(window.velocity, window.rate, t - window.begin);
  }
}

struct Mean {
  std::vector<double> sum;         // of velocity / amplitude
  std::vector<std::size_t> count;  // of trials with samples there
};

Profile profileOf(const Mean& mean) {
  Profile out;
  out.first = kFirst;
  out.step = kStep;
  out.value.resize(gridSize());
  for (std::size_t i = 0; i < out.value.size(); ++i)
    out.value[i] = mean.count[i] > 0 ? mean.sum[i] / static_cast<double>(mean.count[i]) : 0.0;
  return out;
}

/// A line over x at every phase, by least squares.
class Lines {
 public:
  Lines() : sums_(gridSize()) {}
  /// Adds a trial, or takes it out again with `sign` -1.
  void add(const std::vector<double>& laid, double amplitude, double x, double sign) {
    for (std::size_t k = 0; k < laid.size(); ++k) {
      if (!std::isfinite(laid[k])) continue;
      const double v = laid[k] / amplitude;
      Sums& s = sums_[k];
      s.n += sign, s.x += sign * x, s.xx += sign * x * x, s.v += sign * v, s.xv += sign * x * v;
    }
  }
  Profile at(double x) const {
    Profile out;
    out.first = kFirst;
    out.step = kStep;
    for (const Sums& s : sums_) {
      if (!(s.n > 0.5)) {
        out.value.push_back(0);
        continue;
      }
      const double spread = s.xx - s.x * s.x / s.n;
      const double slope = s.n > 2.5 && spread > kLeastSpread * s.n ? (s.xv - s.x * s.v / s.n) / spread : 0;
      out.value.push_back(s.v / s.n + slope * (x - s.x / s.n));
    }
    return out;
  }

 private:
  struct Sums {
    double n = 0, x = 0, xx = 0, v = 0, xv = 0;
  };
  std::vector<Sums> sums_;
};

/// ln T of each trial less the mean.
std::vector<double> centredLogDurations(const std::vector<MovementFit>& places) {
  std::vector<double> x;
  for (const MovementFit& p : places) x.push_back(std::log(p.duration));
  const double mean = averageOf(x);
  for (double& value : x) value -= mean;
  return x;
}

/// Keeps what s means: amplitudes of mean 1, durations of the trials' own mean, centres that do not wander.
void normalise(std::vector<MovementFit>& places, double meanDuration) {
  double amplitude = 0, logDuration = 0;
  for (const MovementFit& p : places) amplitude += p.amplitude, logDuration += std::log(p.duration);
  const double n = static_cast<double>(places.size());
  const double stretch = meanDuration / std::exp(logDuration / n);
  for (MovementFit& p : places) {
    p.amplitude /= amplitude / n;
    const double centre = p.onset + p.duration / 2;
    p.duration *= stretch;
    p.onset = centre - p.duration / 2;
  }
}

std::vector<double> smoothed(const std::vector<double>& values) {
  const auto half = static_cast<std::ptrdiff_t>(std::lround(kSmoothing / kStep / 2));
  const auto n = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> out(values.size());
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    double sum = 0;
    const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, i - half), to = std::min(n - 1, i + half);
    for (std::ptrdiff_t k = from; k <= to; ++k) sum += values[static_cast<std::size_t>(k)];
    out[static_cast<std::size_t>(i)] = sum / static_cast<double>(to - from + 1);
  }
  return out;
}

/// sigma(s) from the sum of n trials' squared differences to the mean: the variance over trials, smoothed; where fewer than half of the
/// trials have samples, the nearest phase where they have.
std::vector<double> scatterOf(std::vector<double> variance, std::size_t n, const Mean& mean) {
  std::ptrdiff_t first = -1, last = -1;
  for (std::size_t i = 0; i < variance.size(); ++i) {
    if (2 * mean.count[i] < n || mean.count[i] < 2) {
      variance[i] = 0;
      continue;
    }
    if (first < 0) first = static_cast<std::ptrdiff_t>(i);
    last = static_cast<std::ptrdiff_t>(i);
    variance[i] /= static_cast<double>(mean.count[i] - 1);
  }
  if (first < 0) return std::vector<double>(gridSize(), 1.0);
  const std::vector<double> covered(variance.begin() + first, variance.begin() + last + 1);
  const std::vector<double> smooth = smoothed(covered);
  std::vector<double> sigma(gridSize());
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(sigma.size()); ++i)
    sigma[static_cast<std::size_t>(i)] = std::sqrt(smooth[static_cast<std::size_t>(std::clamp(i, first, last) - first)]);
  return sigma;
}

/// Each trial's onset and duration by the moments of v^2; the durations have the mean that is given.
std::vector<MovementFit> placesByMoments(std::span<const FitWindow> windows, double meanDuration) {
  double widths = 0;
  for (const FitWindow& w : windows) widths += momentsOf(w).width;
  const double widthOfOne = widths / static_cast<double>(windows.size()) / meanDuration;  // of v^2, in parts of the duration
  std::vector<MovementFit> places;
  for (const FitWindow& w : windows) {
    const ProfileMoments m = momentsOf(w);
    MovementFit& place = places.emplace_back();
    place.duration = m.width / widthOfOne;
    place.onset = m.centre - place.duration / 2;
    place.amplitude = 1;
  }
  return places;
}

Mean layTogether(std::span<const FitWindow> windows, const std::vector<MovementFit>& places) {
  Mean mean{std::vector<double>(gridSize(), 0.0), std::vector<std::size_t>(gridSize(), 0)};
  std::vector<double> laid;  // one trial at a time: there may be many thousands
  for (std::size_t i = 0; i < windows.size(); ++i) {
    layOver(windows[i], places[i], laid);
    for (std::size_t k = 0; k < laid.size(); ++k)
      if (std::isfinite(laid[k])) mean.sum[k] += laid[k] / places[i].amplitude, ++mean.count[k];
  }
  return mean;
}

/// Scores of each trial by the mean and by the lines of the other trials.
void scoreByOthers(std::span<const FitWindow> windows, const Mean& mean, PersonTemplate& out) {
  const std::size_t n = windows.size();
  double left = 0, whole = 0;
  const std::vector<double> x = centredLogDurations(out.place);
  Lines lines;
  std::vector<double> laid, ofMean, ofLine;
  for (std::size_t i = 0; i < n; ++i) layOver(windows[i], out.place[i], laid), lines.add(laid, out.place[i].amplitude, x[i], 1);
  for (std::size_t i = 0; i < n; ++i) {
    Mean others = mean;
    layOver(windows[i], out.place[i], laid);
    for (std::size_t k = 0; k < laid.size(); ++k)
      if (std::isfinite(laid[k])) others.sum[k] -= laid[k] / out.place[i].amplitude, --others.count[k];
    const double rest = restCost(windows[i]);
    const auto scoreOf = [&](const MovementFit& fit) { return std::log(std::max(fit.cost, 1e-9 * rest)); };
    const MovementFit fit = fitMovement(windows[i], profileOf(others), out.place[i]);
    left += fit.cost;
    whole += rest;
    ofMean.push_back(scoreOf(fit));
    lines.add(laid, out.place[i].amplitude, x[i], -1);
    ofLine.push_back(scoreOf(fitMovement(windows[i], lines.at(x[i]), out.place[i])));
    lines.add(laid, out.place[i].amplitude, x[i], 1);
  }
  out.score = averageOf(ofLine) < averageOf(ofMean) ? ofLine : ofMean;
  out.ceilingScore = averageOf(out.score);
  out.ceiling = whole > 0 ? 1 - left / whole : 0;
}

/// Samples / sum of squared autocorrelations, pooled over the trials, of the weighted residuals.
double effectiveSamplesOf(std::span<const FitWindow> windows, const Profile& mean, const std::vector<MovementFit>& places) {
  std::vector<std::vector<double>> residuals;
  std::size_t longest = 0, samples = 0;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    std::vector<double> r = residualsOf(windows[i], mean, places[i]);
    for (std::size_t k = 0; k < r.size(); ++k) r[k] *= std::sqrt(windows[i].weight[k]);
    longest = std::max(longest, r.size());
    samples += r.size();
    residuals.push_back(std::move(r));
  }
  double zero = 0, sum = 1;
  for (const auto& r : residuals)
    for (const double x : r) zero += x * x;
  if (!(zero > 0)) return static_cast<double>(samples) / static_cast<double>(windows.size());
  for (std::size_t lag = 1; lag < longest; ++lag) {
    double c = 0;
    for (const auto& r : residuals)
      for (std::size_t k = 0; k + lag < r.size(); ++k) c += r[k] * r[k + lag];
    sum += 2 * (c / zero) * (c / zero);
  }
  return static_cast<double>(samples) / static_cast<double>(windows.size()) / sum;
}

}  // namespace

void weigh(FitWindow& window, const PersonTemplate& own, std::size_t trial) {
  const std::vector<double>& sigma = own.scatter;
  const MovementFit& place = own.place[trial];
  const double largest = *std::max_element(sigma.begin(), sigma.end());
  const double last = static_cast<double>(sigma.size() - 1);
  for (std::size_t k = 0; k < window.weight.size(); ++k) {
    const double s = (window.begin + static_cast<double>(k) / window.rate - place.onset) / place.duration;
    const double x = std::clamp((s - kFirst) / kStep, 0.0, last);
    const auto i = std::min(static_cast<std::size_t>(x), sigma.size() - 2);
    const double here = sigma[i] + (x - static_cast<double>(i)) * (sigma[i + 1] - sigma[i]);
    const double least = std::max(here, kMinScatter * largest);
    window.weight[k] = least > 0 ? 1 / (least * least) : 1;  // no scatter at all: every sample counts alike
  }
}

PersonTemplate makeTemplate(std::span<FitWindow> windows, std::span<const double> durations, bool keepApart) {
  const std::size_t n = windows.size();
  const double meanDuration = averageOf(durations);
  for (FitWindow& window : windows) std::fill(window.weight.begin(), window.weight.end(), 1.0);
  PersonTemplate out;
  out.place = placesByMoments(windows, meanDuration);
  Mean mean = layTogether(windows, out.place);
  out.mean = profileOf(mean);
  for (int round = 0; round < kRounds; ++round) {
    const ProfilePieces pieces(out.mean);
    for (std::size_t i = 0; i < n; ++i) {
      const MovementFit fit = fitMovement(windows[i], pieces, out.place[i]);
      if (fit.found && fit.amplitude > 0 && fit.duration > 0.3 * out.place[i].duration && fit.duration < 3 * out.place[i].duration)
        out.place[i] = fit;
    }
    normalise(out.place, meanDuration);
    mean = layTogether(windows, out.place);
    out.mean = profileOf(mean);
  }
  std::vector<double> squares(gridSize(), 0.0), laid;
  std::vector<float> apart;
  for (std::size_t i = 0; i < n; ++i) {
    apart.assign(gridSize(), 0.0F);
    layOver(windows[i], out.place[i], laid);
    for (std::size_t k = 0; k < apart.size(); ++k)
      if (std::isfinite(laid[k])) apart[k] = static_cast<float>(laid[k] - out.place[i].amplitude * out.mean.value[k]);
    for (std::size_t k = 0; k < apart.size(); ++k) squares[k] += static_cast<double>(apart[k]) * static_cast<double>(apart[k]);
    if (keepApart) out.apart.push_back(apart);
  }
  out.scatter = scatterOf(std::move(squares), n, mean);
  for (std::size_t i = 0; i < n; ++i) weigh(windows[i], out, i);
  scoreByOthers(windows, mean, out);
  out.effectiveSamples = effectiveSamplesOf(windows, out.mean, out.place);
  return out;
}

}  // namespace reachlab::analysis
