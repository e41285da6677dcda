#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "analysis/conclusions/progress_model.h"
#include "analysis/steps.h"

/// How often the intervals that are printed hold the truth, over simulated studies of people who differ, by the program's own code.
/// REACHLAB_STUDIES says how many a design (default 300; tests/long/coverage.sh asks for 4000) and the table is printed.
namespace reachlab::analysis {
namespace {

int studyCount() {
  const char* asked = std::getenv("REACHLAB_STUDIES");
  return asked ? std::atoi(asked) : 300;
}

class Tally {
 public:
  void add(const std::string& interval, const Bounds& i, double truth) {
    auto& [held, all] = counts_[interval];
    held += i.low <= truth && truth <= i.high;
    ++all;
  }
  /// 93 % are asked for; fewer studies than 4000 are given three standard errors.
  void check(const std::string& design) const {
    for (const auto& [interval, count] : counts_) {
      const double share = static_cast<double>(count.first) / count.second;
      const double least = studyCount() >= 4000 ? 0.93 : 0.93 - 3 * std::sqrt(0.93 * 0.07 / studyCount());
      EXPECT_GE(share, least) << interval << ", " << design;
      fmt::print("| {} | {} | {:.1f} |\n", interval, design, 100 * share);
    }
  }

 private:
  std::map<std::string, std::pair<int, int>> counts_;
};

double shareOf(double logit) { return 1 / (1 + std::exp(-logit)); }

/// Mean of shareOf(N(mean, sd^2)): the trapezoidal rule, exact to rounding for so smooth an integrand.
double meanShare(double mean, double sd) {
  double sum = 0, weights = 0;
  for (int i = -400; i <= 400; ++i) {
    const double z = i / 50.0, w = std::exp(-z * z / 2);
    sum += w * shareOf(mean + sd * z);
    weights += w;
  }
  return sum / weights;
}

struct Design {
  int people, trials;
  double logit;  // of a typical person's first day
};

// People differ in their success (SD 1 logit), in what a day (0.5 -+ 0.5) and a pace (1 -+ 0.5) do to it, and in how they learn.
constexpr double kBetween = 1, kDay = 0.5, kDayScatter = 0.5, kPace = 1, kPaceScatter = 0.5, kSlope = 0.5, kSlopeScatter = 0.7;

Tally successOf(const Design& d) {
  Tally tally;
  std::mt19937_64 random(20 * d.people + d.trials);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const double before = meanShare(d.logit, kBetween);
  const double points = 100 * (meanShare(d.logit + kDay, std::hypot(kBetween, kDayScatter)) - before);
  double slope = 0, squares = 0;
  for (int i = 0; i < d.trials; ++i) {
    const double x = i - (d.trials - 1) / 2.0, t = i / 100.0;
    slope += x * meanShare(d.logit + kSlope * t, std::hypot(kBetween, kSlopeScatter * t));
    squares += x * x;
  }
  slope *= 1e4 / squares;
  for (int analysis = 0; analysis < studyCount(); ++analysis) {
    std::vector<Attempt> days, learning;
    std::vector<double> own(static_cast<std::size_t>(d.people));
    for (int p = 0; p < d.people; ++p) {
      const std::string name(1, static_cast<char>('a' + p));
      const double base = own[static_cast<std::size_t>(p)] = d.logit + kBetween * normal(random),
                   learn = kSlope + kSlopeScatter * normal(random);
      const double day = kDay + kDayScatter * normal(random), pace = kPace + kPaceScatter * normal(random);
      for (int i = 0; i < d.trials; ++i) {
        days.push_back({name, "1", 1, 0, uniform(random) < shareOf(base)});
        days.push_back({name, "2", 2, 0, uniform(random) < shareOf(base + day)});
        days.push_back({name, "1", 1, 1, uniform(random) < shareOf(base + pace)});
        learning.push_back({name, "1", 1, 0, uniform(random) < shareOf(base + learn * i / 100.0)});
      }
    }
    const auto byCondition = [](const Attempt& a, const Attempt& b) {
      return std::tie(a.condition, a.subject, a.day) < std::tie(b.condition, b.subject, b.day);
    };
    std::stable_sort(days.begin(), days.end(), byCondition);
    const std::vector<SuccessCell> cells = successTable(days);
    tally.add("share of a typical subject", typicalShare(cells, 0, 1)->interval, shareOf(d.logit));
    tally.add("one subject's share", cells.front().interval, shareOf(own.front()));
    for (const Effect& e : effectsOf(cells, 2)) {
      if (e.ofDay) tally.add("D2 − D1, percentage points", e.pointsInterval, points);
      tally.add(e.ofDay ? "D2 − D1, odds ratio" : "pace, odds ratio", e.logitInterval, e.ofDay ? kDay : kPace);
    }
    tally.add("learning slope", learningSlopes(learning, 1).front().interval, slope);
    const LearningPoint point = learningCurves({days.begin(), days.begin() + 10}, 10).front();
    tally.add("a point of a learning curve", point.interval, shareOf(own.front()));
  }
  return tally;
}

TEST(Coverage, OfIntervalsOfSuccessIsWhatTheySay) {
  for (const Design& d : {Design{2, 20, -2}, Design{2, 100, 0.5}, Design{3, 20, -2}, Design{3, 100, 1.5}, Design{5, 20, -2},
                          Design{5, 100, -2}, Design{5, 50, 0.5}, Design{10, 100, 1.5}})
    successOf(d).check(fmt::format("{} subjects, {} trials, a typical one {:.0f} %", d.people, d.trials, 100 * shareOf(d.logit)));
}

/// People's paper's epsilon of each of four criteria: lognormal over people (SD 0.3), trials scatter by a quarter. `apart` [m/s]: how much
/// farther the others are from people's movements than the first.
Tally epsilonOf(int people, double apart) {
  constexpr std::size_t kCriteria = 4;
  constexpr int kTrials = 20;
  constexpr double kFirst = 0.05, kPeople = 0.3, kTrial = 0.25;
  Tally tally;
  std::mt19937_64 random(people);
  std::normal_distribution<double> normal;
  const auto meanOf = [&](std::size_t c) { return (kFirst + (c > 0 ? apart : 0)) * std::exp(kPeople * kPeople / 2); };
  // A person's own epsilon is the root of the mean square of trials, which is lognormal too: E e^2 = e^(2 s^2).
  const double rootMeanSquare = std::exp(kTrial * kTrial);
  for (int analysis = 0; analysis < studyCount(); ++analysis) {
    std::vector<AnalyzedTrial> trials;
    for (int p = 0; p < people; ++p) {
      std::array<double, kCriteria> own{};
      for (std::size_t c = 0; c < kCriteria; ++c) own[c] = (kFirst + (c > 0 ? apart : 0)) * std::exp(kPeople * normal(random));
      for (int i = 0; i < kTrials; ++i) {
        AnalyzedTrial trial;
        trial.key.subject = std::string(1, static_cast<char>('a' + p));
        trial.paperError.assign(2 * kCriteria, 0.0);
        const double scatter = std::exp(kTrial * normal(random));
        for (std::size_t c = 0; c < kCriteria; ++c) trial.paperError[c] = own[c] * scatter;
        trials.push_back(std::move(trial));
      }
    }
    const EpsilonTable table = makeEpsilonTable(trials, kCriteria, false);
    const double first = meanOf(table.front().criterion);
    for (const EpsilonPlace& place : table) {
      tally.add("paper's ε of people", *place.interval, meanOf(place.criterion) * rootMeanSquare);
      if (place.differenceInterval)
        tally.add("its difference to the first", *place.differenceInterval, (meanOf(place.criterion) - first) * rootMeanSquare);
    }
  }
  return tally;
}

TEST(Coverage, OfIntervalsOfEpsilonIsWhatTheySay) {
  for (const int people : {2, 5, 10})
    for (const double apart : {0.0, 0.02}) epsilonOf(people, apart).check(fmt::format("{} subjects, others {} m/s farther", people, apart));
}

}  // namespace
}  // namespace reachlab::analysis
