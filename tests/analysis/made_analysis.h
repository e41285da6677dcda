#pragma once
#include "analysis/analysis.h"
#include "tests/analysis/synthetic.h"

/// A study whose every number is another, put together by hand: nothing is fitted, so that what is said of it is known.
namespace reachlab::analysis {

/// v = a s until the middle, distinct for hand and object.
class StraightPlan final : public predict::Prediction {
 public:
  StraightPlan(predict::Criterion of, double seconds, double speed) : speed_(speed) {
    criterion = of;
    duration = seconds;
    distance = 0.2;
    massCount_ = 1;
  }
  predict::PredictedHand handAt(double t) const override { return {0.5 * speed_ * t * t, speed_ * t, speed_}; }
  void massesAt(double t, std::span<double> position, std::span<double> velocity) const override {
    position[0] = t, velocity[0] = 2 * speed_ * t;
  }

 private:
  double speed_;
};

inline PredictedSignal madeSignal(predict::Criterion criterion, double seconds, double speed) {
  PredictedSignal signal;
  signal.criterion = criterion;
  signal.plannedDuration = 2.25 + speed;
  signal.begin = 0.3, signal.onset = 0.42;
  signal.prediction = std::make_unique<StraightPlan>(criterion, seconds, speed);
  return signal;
}

inline CandidateFit madeFit(double base, std::size_t trials, std::size_t points) {
  CandidateFit fit;
  for (std::size_t i = 0; i < trials; ++i) {
    const double more = 0.001 * static_cast<double>(i);
    fit.score.push_back(base + 0.1 + more);
    fit.epsilon.push_back(base + 0.2 + more);
    fit.trials.push_back({base + 0.3 + more, base + 0.4 + more, base + 0.5 + more, base + 0.6 + more, true});
  }
  fit.meanScore = base + 0.7;
  fit.epsilonOfAll = base + 0.8;
  fit.r2 = base + 0.9;
  fit.duration = base + 0.95;
  for (std::size_t k = 0; k < points; ++k) fit.mean.push_back(base + 0.01 * static_cast<double>(k));
  return fit;
}

/// Two conditions, two subjects. The first condition has predictions of (3) and (1), candidates (1), (4 and 6) with masses, the reference.
inline Analysis madeStudy() {
  Analysis analysis;
  const auto signals = std::make_shared<SignalStore>();
  analysis.conditions = {{"slow pace", compiledChain(2.25)}, {"quick", compiledChain(0.75)}};
  analysis.subjects = {"A", "B"};
  analysis.results.resize(2);
  ConditionResult& r = analysis.results[0];
  r.counts = {11, 12, 13, 14, 15, 16, 3, 17, 18};
  r.used = 3;
  r.duration = {1.6, 0.06, 3};
  r.movementTime = {1.7, 0.07, 3};
  r.movementRange = {1.1, 1.9};
  for (int i = 0; i < 101; ++i) {
    r.hand.mean.push_back(1 + i), r.hand.sd.push_back(200 + i);
    r.object.mean.push_back(400 + i), r.object.sd.push_back(600 + i);
  }
  r.signals.push_back(madeSignal(predict::Criterion::MinCrackle, 2, 0.5));
  r.signals.push_back(madeSignal(predict::Criterion::MinHandJerk, 2, 0.25));
  r.handEpsilon = {{1, 0.021, 0.022, Bounds{0.011, 0.031}, 0, {}, false},
                   {0, 0.041, 0.042, Bounds{0.015, 0.055}, 0.02, Bounds{0.004, 0.036}, true}};
  r.objectEpsilon = {{0, 0.07, 0.07, {}, 0, {}, false}, {1, 0.09, 0.091, Bounds{0.05, 0.13}, 0.02, Bounds{-0.01, 0.05}, false}};
  const auto candidate = [](std::vector<predict::Criterion> criteria, std::vector<double> masses) {
    Candidate made;
    made.criteria = std::move(criteria), made.masses = std::move(masses);
    return made;
  };
  r.candidates.candidates.push_back(candidate({predict::Criterion::MinHandJerk}, {}));
  r.candidates.candidates.push_back(candidate({predict::Criterion::MinHandForce, predict::Criterion::MinComAcceleration}, {0, 1.5}));
  r.candidates.candidates.push_back(candidate({}, {}));
  r.candidates.masses = {0, 1.5};
  Conclusion& c = r.conclusion;
  c.overSubjects = true;
  c.score = {-2.5, -1.25, -0.5};
  c.against = {{}, {1.25, 0.1, 12.5, 1, 0.03}, {2, 0.2, 10, 1, 0.02}};
  c.best = 0, c.rival = 1, c.follows = 0;
  c.reason = Obstacle::None;
  c.closest = {2, 0, 0};
  c.each = {0, {}};
  c.posterior = {0.91, 0.06, 0.03};
  c.level = 0.05, c.p = 0.03, c.referenceP = 0.02, c.subjects = 2, c.trials = 31;
  c.r2 = 0.962, c.ceiling = 0.981;
  analysis.results[1].counts.failure = 1;

  const auto add = [&](const char* subject, const char* session, int day, int run, int number, const char* exclusion, double base) {
    AnalyzedTrial t;
    t.key = {subject, session, "slow pace", day, run, 40 + number, number};
    t.result.outcome = trial::Outcome::Success;
    t.exclusion = exclusion;
    t.counted = true;
    TrialMeasures& m = t.measures;
    double value = base;
    for (double* x : {&m.reactionTime, &m.onset, &m.offset, &m.duration, &m.movementTime, &m.peakSpeed, &m.timeToPeak, &m.timeToPeakPercent,
                      &m.symmetryRatio, &m.pathLength, &m.speedPeaks, &m.handEndpointError, &m.objectEndpointError, &m.handOvershoot,
                      &m.objectOvershoot, &m.sparc, &m.ldlj, &m.peakForce, &m.meanForce})
      *x = value += 0.0625;
    m.duration = 0.8 * static_cast<double>(number);
    std::vector<double> both;
    for (int i = 0; i < 202; ++i) both.push_back(base + i);
    t.profile = signals->put(both);
    if (t.used()) t.window = signals->put(std::vector<double>(4, base)), t.paperError = {base + 0.1, base + 0.2, base + 0.3, base + 0.4};
    analysis.trials.push_back(t);
  };
  add("A", "01", 1, 2, 1, "", 10);
  add("A", "01", 1, 2, 2, "practice", 20);
  add("A", "02", 2, 3, 3, "", 30);
  add("B", "01", 1, 4, 4, "", 50);
  AnalyzedTrial& odd = analysis.trials[1];
  odd.practice = odd.otherWay = odd.measures.beforeGo = true;
  odd.result = {trial::Outcome::Failure, trial::Reason::Velocity, 2, 0.015};
  odd.measures.sparc = kNotMeasured;

  analysis.series = {{analysis.trials[0].key, 0, 1, {0.5, 0.25}, {0.75, 0.125}},
                     {analysis.trials[3].key, 0, 2, {0.6, 0.35}, {0.85, 0.225}}};
  PersonResult a;
  a.subject = "A";
  a.trials = 2;
  a.fitted = true;
  a.rest = {4, 8};
  a.conclusion.follows = 0, a.conclusion.reason = Obstacle::None;
  a.fit.own.ceiling = 0.97;
  a.fit.own.ceilingScore = -3.5;
  a.fit.own.score = {-3.25, -3.75};
  a.fit.own.mean.first = -0.6, a.fit.own.mean.step = 0.005;
  for (int k = 0; k < 441; ++k) a.fit.own.mean.value.push_back(0.5 + 0.001 * k), a.fit.own.scatter.push_back(0.02 + 0.0001 * k);
  for (const double base : {-2.0, -4.0, -1.0}) a.fit.candidates.push_back(madeFit(base, 2, 441));
  a.fit.candidates[0].choice = {TimeLaw::OnePlan, 1.45, 0};
  a.fit.candidates[1].choice = {TimeLaw::Anew, 0, 1, 1.5};
  a.fit.candidates[1].mass = MassFit{1.5, {1.25, 1.5}, true};
  a.fit.candidates[2].trials[1].found = false;
  analysis.people.push_back(a);
  PersonResult b;
  b.subject = "B";
  b.firstTrial = 3;
  b.trials = 1;
  analysis.people.push_back(b);
  analysis.common = {{predict::Criterion::MinHandJerk}, {}};
  analysis.together = {0};
  analysis.overall = c;
  analysis.overall.overSubjects = false;
  analysis.overall.follows.reset();
  analysis.overall.reason = Obstacle::Poor;
  analysis.overall.misfit.mean = 0.5, analysis.overall.misfit.p = 0.004;
  analysis.overall.closest = {1, 1};
  analysis.overall.score = {-1.5, -2.5};
  analysis.overall.against = {{1, 0.2, 5, 1, 0.04}, {}};
  analysis.overall.best = 1, analysis.overall.rival = 0;
  analysis.overall.posterior.clear();

  analysis.success = {{"A", 1, 0, 3, 8, {0.085, 0.755}}, {"B", 2, 1, 1, 4, {0.006, 0.806}}};
  analysis.learning = {
      {"A", "01", 0, 1, 10, 3, 8, {0.1, 0.7}}, {"A", "02", 0, 11, 14, 3, 4, {0.2, 0.99}}, {"B", "01", 0, 1, 10, 5, 10, {0.19, 0.81}}};
  Effect day;
  day.ofDay = true, day.condition = 1, day.from = 1, day.to = 2, day.people = 2, day.p = 0.012;
  day.points.mean = 21, day.pointsInterval = {5, 37};
  day.logit.mean = std::log(2.5), day.logitInterval = {std::log(1.25), std::log(5)};
  Effect pace;
  pace.from = 0, pace.to = 1, pace.people = 1, pace.points.mean = -12.5, pace.pointsInterval = {-INFINITY, INFINITY};
  pace.logit.mean = std::log(0.5), pace.logitInterval = {-INFINITY, INFINITY};
  analysis.effects = {day, pace};
  analysis.slopes = {{1, 2, 7.5, {-2.5, 17.5}, 0.2}, {0, 1, -3, {-INFINITY, INFINITY}, 1}};
  analysis.signals = signals;
  return analysis;
}

}  // namespace reachlab::analysis
