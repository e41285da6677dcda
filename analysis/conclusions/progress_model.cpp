#include "analysis/conclusions/progress_model.h"

#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace reachlab::analysis {

std::vector<SuccessCell> successTable(const std::vector<Attempt>& attempts) {
  std::map<std::tuple<std::string, std::size_t, int>, SuccessCell> cells;
  for (const Attempt& attempt : attempts) {
    SuccessCell& cell = cells[{attempt.subject, attempt.condition, attempt.day}];
    cell.subject = attempt.subject;
    cell.day = attempt.day;
    cell.condition = attempt.condition;
    ++cell.trials;
    if (attempt.success) ++cell.successes;
  }
  std::vector<SuccessCell> out;
  for (auto& [key, cell] : cells) {
    cell.interval = computeBinomialInterval(cell.successes, cell.trials);
    out.push_back(cell);
  }
  return out;
}

std::vector<LearningPoint> learningCurves(const std::vector<Attempt>& attempts, int bin) {
  std::vector<LearningPoint> out;
  int counted = 0;
  for (const Attempt& attempt : attempts) {
    const bool sameSubject = !out.empty() && out.back().subject == attempt.subject && out.back().condition == attempt.condition;
    if (!sameSubject) counted = 0;
    ++counted;
    const bool open = sameSubject && out.back().session == attempt.session && out.back().trials < static_cast<std::size_t>(bin);
    if (!open) out.push_back({attempt.subject, attempt.session, attempt.condition, counted, counted, 0, 0, {}});
    LearningPoint& point = out.back();
    point.lastTrial = counted;
    ++point.trials;
    if (attempt.success) ++point.successes;
  }
  for (LearningPoint& point : out) point.interval = computeBinomialInterval(point.successes, point.trials);
  return out;
}

namespace {

/// A share of trials with half a success and half a failure added, so that none and all have a logit and a variance too.
struct Share {
  double successes = 0.5, failures = 0.5;
  explicit Share(const SuccessCell& cell)
      : successes(static_cast<double>(cell.successes) + 0.5), failures(static_cast<double>(cell.trials - cell.successes) + 0.5) {}
  double logit() const { return std::log(successes / failures); }
  double logitVariance() const { return 1 / successes + 1 / failures; }
  double variance() const {
    const double n = successes + failures;
    return successes * failures / (n * n) / (n - 1);
  }
};

/// Estimates and the variance of each.
struct Estimates {
  std::vector<double> value, variance;
  void add(double v, double var) { value.push_back(v), variance.push_back(var); }
  /// One number for what was added: the mean, its variance.
  void addMeanOf(const Estimates& others) {
    add(averageOf(others.value), averageOf(others.variance) / static_cast<double>(others.variance.size()));
  }
};

struct Paired {
  Estimates points, logits;
  /// Adds nothing where one of the two is null.
  void add(const SuccessCell* before, const SuccessCell* after) {
    if (before == nullptr || after == nullptr) return;
    const Share a(*before), b(*after);
    points.add(100 * (after->share() - before->share()), 1e4 * (a.variance() + b.variance()));
    logits.add(b.logit() - a.logit(), a.logitVariance() + b.logitVariance());
  }
};

void addEffect(std::vector<Effect>& effects, Effect effect, const Paired& paired) {
  effect.people = paired.points.value.size();
  if (effect.people == 0) return;
  const PeopleMean points = computePeopleMean(paired.points.value, paired.points.variance);
  const PeopleMean logits = computePeopleMean(paired.logits.value, paired.logits.variance);
  effect.points = points.test;
  effect.pointsInterval = points.interval;
  effect.logit = logits.test;
  effect.logitInterval = logits.interval;
  effects.push_back(effect);
}

void correct(std::vector<Effect>& effects, bool ofDay) {
  std::vector<double> p;
  for (const Effect& e : effects)
    if (e.ofDay == ofDay) p.push_back(e.logit.p);
  const std::vector<double> adjusted = adjustByHolm(p);
  std::size_t i = 0;
  for (Effect& e : effects)
    if (e.ofDay == ofDay) e.p = adjusted[i++];
}

}  // namespace

std::optional<MeanInterval> typicalShare(const std::vector<SuccessCell>& cells, std::size_t condition, std::optional<int> day) {
  std::map<std::string, SuccessCell> people;
  for (const SuccessCell& cell : cells) {
    if (cell.condition != condition || (day && cell.day != *day)) continue;
    people[cell.subject].successes += cell.successes;
    people[cell.subject].trials += cell.trials;
  }
  if (people.size() < 2) return std::nullopt;
  Estimates logits;
  for (const auto& [subject, cell] : people) logits.add(Share(cell).logit(), Share(cell).logitVariance());
  const PeopleMean mean = computePeopleMean(logits.value, logits.variance);
  const auto back = [](double logit) { return 1 / (1 + std::exp(-logit)); };
  return MeanInterval{back(mean.test.mean), {back(mean.interval.low), back(mean.interval.high)}, people.size()};
}

std::vector<Effect> effectsOf(const std::vector<SuccessCell>& cells, std::size_t conditions) {
  std::vector<Effect> out;
  std::set<int> days;
  std::map<std::tuple<std::string, std::size_t, int>, const SuccessCell*> at;
  std::set<std::string> subjects;
  for (const SuccessCell& cell : cells)
    days.insert(cell.day), subjects.insert(cell.subject), at[{cell.subject, cell.condition, cell.day}] = &cell;
  const auto cellOf = [&](const std::string& subject, std::size_t condition, int day) {
    const auto found = at.find({subject, condition, day});
    return found == at.end() ? nullptr : found->second;
  };
  for (std::size_t c = 0; c < conditions; ++c) {
    std::set<int> own;  // the days of this condition
    for (const SuccessCell& cell : cells)
      if (cell.condition == c) own.insert(cell.day);
    for (auto day = own.begin(); day != own.end() && std::next(day) != own.end(); ++day) {
      const int from = *day, to = *std::next(day);
      Paired paired;
      for (const std::string& subject : subjects) paired.add(cellOf(subject, c, from), cellOf(subject, c, to));
      addEffect(out, {.ofDay = true, .condition = c, .from = from, .to = to}, paired);
    }
  }
  for (std::size_t a = 0; a < conditions; ++a)
    for (std::size_t b = a + 1; b < conditions; ++b) {
      Paired paired;  // one number a person: the mean over the days on which both were done
      for (const std::string& subject : subjects) {
        Paired own;
        for (const int day : days) own.add(cellOf(subject, a, day), cellOf(subject, b, day));
        if (own.points.value.empty()) continue;
        paired.points.addMeanOf(own.points);
        paired.logits.addMeanOf(own.logits);
      }
      addEffect(out, {.from = static_cast<int>(a), .to = static_cast<int>(b)}, paired);
    }
  correct(out, true);
  correct(out, false);
  return out;
}

std::vector<LearningSlope> learningSlopes(const std::vector<Attempt>& attempts, std::size_t conditions) {
  std::vector<std::map<std::string, std::vector<double>>> series(conditions);
  for (const Attempt& attempt : attempts) series[attempt.condition][attempt.subject].push_back(attempt.success ? 1 : 0);
  std::vector<LearningSlope> out;
  for (std::size_t c = 0; c < conditions; ++c) {
    Estimates slopes;
    for (const auto& [subject, y] : series[c]) {
      const double n = static_cast<double>(y.size());
      if (y.size() < 3) continue;
      double sxy = 0, sxx = 0;
      SuccessCell whole;
      whole.trials = y.size();
      for (std::size_t i = 0; i < y.size(); ++i) {
        const double x = static_cast<double>(i) - (n - 1) / 2;
        sxy += x * y[i];
        sxx += x * x;
        if (y[i] > 0) ++whole.successes;
      }
      slopes.add(100 * 100 * sxy / sxx, 1e8 * Share(whole).variance() * n / sxx);
    }
    if (slopes.value.empty()) continue;
    const PeopleMean mean = computePeopleMean(slopes.value, slopes.variance);
    out.push_back({c, slopes.value.size(), mean.test.mean, mean.interval, mean.test.p});
  }
  return out;
}

}  // namespace reachlab::analysis
