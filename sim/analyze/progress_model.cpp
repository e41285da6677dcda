#include "sim/analyze/progress_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace reachlab::analyze {

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
  const auto close = [](LearningPoint& point) { point.interval = computeBinomialInterval(point.successes, point.trials); };
  int counted = 0;
  for (const Attempt& attempt : attempts) {
    const bool sameSubject = !out.empty() && out.back().subject == attempt.subject && out.back().condition == attempt.condition;
    if (!sameSubject) counted = 0;
    ++counted;
    const bool open = sameSubject && out.back().session == attempt.session && out.back().trials < static_cast<std::size_t>(bin);
    if (!open) {
      if (!out.empty()) close(out.back());
      out.push_back({attempt.subject, attempt.session, attempt.condition, counted, counted, 0, 0, {}});
    }
    LearningPoint& point = out.back();
    point.lastTrial = counted;
    ++point.trials;
    if (attempt.success) ++point.successes;
  }
  if (!out.empty()) close(out.back());
  return out;
}

std::vector<double> sharesOf(const std::vector<SuccessCell>& cells, std::size_t condition) {
  std::map<std::string, std::pair<std::size_t, std::size_t>> people;
  for (const SuccessCell& cell : cells)
    if (cell.condition == condition) people[cell.subject].first += cell.successes, people[cell.subject].second += cell.trials;
  std::vector<double> out;
  for (const auto& [subject, n] : people) out.push_back(static_cast<double>(n.first) / static_cast<double>(n.second));
  return out;
}

namespace {

double logitOf(const SuccessCell& cell) {
  return std::log((static_cast<double>(cell.successes) + 0.5) / (static_cast<double>(cell.trials - cell.successes) + 0.5));
}

struct Paired {
  std::vector<double> points, logits;
  void add(const SuccessCell& before, const SuccessCell& after) {
    points.push_back(100 * (after.share() - before.share()));
    logits.push_back(logitOf(after) - logitOf(before));
  }
};

void judge(Effect& effect, const Paired& paired) {
  effect.people = paired.points.size();
  effect.points = computeTTest(paired.points);
  effect.pointsInterval = computeMeanInterval(paired.points);
  effect.logit = computeTTest(paired.logits);
  effect.logitInterval = computeMeanInterval(paired.logits);
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

std::vector<Effect> effectsOf(const std::vector<SuccessCell>& cells, std::size_t conditions) {
  std::vector<Effect> out;
  std::set<int> days;
  std::map<std::tuple<std::string, std::size_t, int>, const SuccessCell*> at;
  std::set<std::string> subjects;
  for (const SuccessCell& cell : cells)
    days.insert(cell.day), subjects.insert(cell.subject), at[{cell.subject, cell.condition, cell.day}] = &cell;
  for (std::size_t c = 0; c < conditions; ++c)
    for (auto day = days.begin(); day != days.end() && std::next(day) != days.end(); ++day) {
      Effect effect;
      effect.ofDay = true;
      effect.condition = c;
      effect.from = *day;
      effect.to = *std::next(day);
      Paired paired;
      for (const std::string& subject : subjects) {
        const auto before = at.find({subject, c, effect.from}), after = at.find({subject, c, effect.to});
        if (before != at.end() && after != at.end()) paired.add(*before->second, *after->second);
      }
      if (paired.points.empty()) continue;
      judge(effect, paired);
      out.push_back(effect);
    }
  for (std::size_t a = 0; a < conditions; ++a)
    for (std::size_t b = a + 1; b < conditions; ++b) {
      Effect effect;
      effect.from = static_cast<int>(a);
      effect.to = static_cast<int>(b);
      Paired paired;  // one number a person: the mean over the days on which both were done
      for (const std::string& subject : subjects) {
        Paired own;
        for (const int day : days) {
          const auto first = at.find({subject, a, day}), second = at.find({subject, b, day});
          if (first != at.end() && second != at.end()) own.add(*first->second, *second->second);
        }
        if (own.points.empty()) continue;
        paired.points.push_back(computeTTest(own.points).mean);
        paired.logits.push_back(computeTTest(own.logits).mean);
      }
      if (paired.points.empty()) continue;
      judge(effect, paired);
      out.push_back(effect);
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
    std::vector<double> slopes;
    for (const auto& [subject, y] : series[c]) {
      const double n = static_cast<double>(y.size());
      if (y.size() < 3) continue;
      double sxy = 0, sxx = 0;
      for (std::size_t i = 0; i < y.size(); ++i) {
        const double x = static_cast<double>(i) - (n - 1) / 2;
        sxy += x * y[i];
        sxx += x * x;
      }
      slopes.push_back(100 * 100 * sxy / sxx);
    }
    if (slopes.empty()) continue;
    const TTest test = computeTTest(slopes);
    out.push_back({c, slopes.size(), test.mean, computeMeanInterval(slopes), test.p});
  }
  return out;
}

}  // namespace reachlab::analyze
