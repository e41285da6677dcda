#include "analysis/report/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/tables.h"
#include "analysis/taught_trials.h"
#include "base/names.h"

namespace reachlab::analysis {
namespace {

using Names = std::vector<std::vector<predict::Criterion>>;

std::string joined(const std::vector<std::string>& parts) { return listOf(parts, " and "); }

/// "[5, 37]"; empty where there is none.
std::string intervalText(const Bounds& i) { return i.finite() ? fmt::format("[{}, {}]", shortNumber(i.low), shortNumber(i.high)) : ""; }

/// "3 follow (1) min-hand-jerk, 2 follow (5) min-hand-force-change, 1 undecided".
std::string eachOf(const Conclusion& c, const Names& names) {
  std::map<std::size_t, std::size_t> followers;
  std::size_t undecided = 0;
  for (const auto& each : c.each)
    if (each) ++followers[*each];
    else ++undecided;
  std::vector<std::string> parts;
  for (const auto& [candidate, n] : followers) parts.push_back(fmt::format("{} for {}", n, describeCandidate(names[candidate])));
  if (undecided > 0) parts.push_back(fmt::format("{} undecided", undecided));
  return joined(parts);
}

// A difference that is significant and yet too small, in words.
const std::string kTooNear = fmt::format("their squared errors differ by less than {:.0f} %", 100 * kLeastDifference);

std::string whoMoved(const Conclusion& c) {
  return c.overSubjects ? fmt::format("The movements of these {} ({})", plural(c.subjects, "subject"), plural(c.trials, "trial"))
                        : fmt::format("The movements of subject {} ({})", c.subject, plural(c.trials, "trial"));
}

}  // namespace

std::string shortNumber(double value) {
  if (!std::isfinite(value)) return "–";
  std::string text = fmt::format("{:.3g}", value);
  if (text.front() == '-') text = "−" + text.substr(1);
  return text;
}

std::string shareText(std::size_t part, std::size_t of) {
  const Bounds share = computeBinomialInterval(part, of);
  return fmt::format("{} % {}", shortNumber(100 * static_cast<double>(part) / static_cast<double>(of)), intervalText(share.percent()));
}

std::string plural(std::size_t n, const std::string& noun) { return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s"); }

std::string pText(double p) { return p < 1e-4 ? "p < 0.0001" : fmt::format("p = {:.2g}", p); }

std::string describeCandidate(const std::vector<predict::Criterion>& criteria) {
  if (criteria.empty()) return "a minimum jerk that ignores the object";
  std::vector<std::string> names;
  for (const predict::Criterion c : criteria) names.push_back(numberedName(c));
  if (names.size() == 1) return names.front();
  return fmt::format("{} (the same prediction as {})", names.front(), joined(std::vector<std::string>(names.begin() + 1, names.end())));
}

namespace {

/// What the residuals say of the best candidate's fit, with a space behind. Empty if they were not tested.
std::string fitText(const Conclusion& c, const Names& names) {
  std::string text;
  if (c.systematic.variance > 0)
    text += fmt::format("{} % of what it leaves is the same in every trial or grows with the duration ({}). ",
                        shortNumber(100 * std::max(0.0, c.systematic.share)), pText(c.systematic.p()));
  constexpr double kMostShown = 2;  // farther beyond the other, the two hardly differ, and the share says nothing
  if (c.mixedWith && c.mixture.mean > 0 && c.mixture.mean <= kMostShown) {
    const Bounds interval = intervalOf(c.mixture);
    const std::string within = intervalText(interval.percent());
    text += fmt::format("The movements go {} %{}{} of the way towards {} ({}). ", shortNumber(100 * c.mixture.mean),
                        within.empty() ? "" : " ", within, describeCandidate(names[*c.mixedWith]), pText(c.mixtureP));
  }
  return text;
}

std::string describeOutcome(const Conclusion& c, const Names& names) {
  const std::string best = c.best && *c.best < names.size() ? describeCandidate(names[*c.best]) : "";
  if (c.decided())
    return fmt::format(
        "{} follow {} most closely among the candidates: it is nearer than every other, and than a minimum jerk that ignores the object{}.",
        whoMoved(c), best, c.overSubjects ? "" : "; nothing follows about other people from one subject");
  const auto nothing = [&](const std::string& why) { return "Nothing can be concluded: " + why + "."; };
  switch (c.reason) {
    case Obstacle::TooFewTrials: return nothing(fmt::format("no subject has {} successful trials in any condition", kFewestTrials));
    case Obstacle::TooFewSubjects:
      return fmt::format("Nothing can be concluded about people in general: {} are too few, {} are needed. Each judged alone: {}.",
                         plural(c.subjects, "subject"), kFewestSubjects, eachOf(c, names));
    case Obstacle::Reference:
      return nothing(
          c.referenceFirst
              ? "a minimum jerk that ignores the object describes the movements better than every candidate"
              : fmt::format("a minimum jerk that ignores the object describes the movements as well as the closest candidate, {} ({})",
                            best, c.referenceP < c.level ? kTooNear : pText(c.referenceP)));
    case Obstacle::NotToldApart: {
      std::vector<std::string> rivals;
      for (std::size_t k = 0; k < c.against.size(); ++k)
        if (k != *c.best && !c.told(k)) rivals.push_back(describeCandidate(names[k]));
      return nothing(fmt::format("{} is the closest candidate, but cannot be told from {} ({})", best, joined(rivals),
                                 c.p < c.level ? kTooNear : pText(c.p)));
    }
    case Obstacle::SubjectsDiffer:
      return nothing(fmt::format("people differ. Closest over all is {}; each judged alone: {}", best, eachOf(c, names)));
    case Obstacle::MassAtEdge: {
      std::vector<std::string> which;
      for (const std::size_t k : c.atEdge) which.push_back(describeCandidate(names[k]));
      return nothing(
          fmt::format("{} is the closest candidate, but the hand's mass of {} is at the edge of the range, and a mass outside it might "
                      "describe the movements better. Widen the range of masses, or give the mass",
                      best, joined(which)));
    }
    case Obstacle::Poor:
      return nothing(fmt::format(
          "{} is the closest of these, but does not fit. {}Its squared errors are {:.0f} % {} those of the person's other trials ({}), and it "
          "leaves {:.2f} times the squares that their mean leaves",
          best, fitText(c, names), 100 * std::abs(std::expm1(c.misfit.mean)), c.misfit.mean > 0 ? "above" : "below", pText(c.misfit.p),
          (1 - c.r2) / (1 - c.ceiling)));
    case Obstacle::NothingToCompare:
      return nothing("fewer than two candidates were asked for or can be predicted here, so there is nothing to compare");
    case Obstacle::None: break;
  }
  return {};
}

}  // namespace

std::string describeConclusion(const Conclusion& c, const Names& names) {
  std::string outcome = describeOutcome(c, names);
  if (!c.best) return outcome;
  if (c.leftOut > 0)
    outcome += fmt::format(" {} with fewer than {} successful trials {} left out.", plural(c.leftOut, "subject"), kFewestTrials,
                           c.leftOut == 1 ? "is" : "are");
  std::vector<std::string> compared;
  for (const auto& criteria : names)
    if (criteria.empty()) compared.push_back(describeCandidate(criteria));
    else
      for (const predict::Criterion criterion : criteria) compared.push_back(numberedName(criterion));
  return outcome + " Compared were " + joined(compared) + ".";
}

std::string describeEvidence(const Conclusion& c, const Names& names) {
  if (!c.best || !c.rival) return {};
  std::string text =
      fmt::format("Closest: {} ({}, {}). Least certain comparison: with {}, {} ({}).", describeCandidate(names[*c.best]),
                  plural(c.subjects, "subject"), plural(c.trials, "trial"), describeCandidate(names[*c.rival]), pText(c.p),
                  c.overSubjects ? "paired t over subjects" : "t over this person's trials, their serial correlation allowed for");
  if (const Bounds interval = intervalOf(c.against[*c.rival]); interval.finite())
    text += fmt::format(" The squared errors of that candidate are {:.0f} % larger {}.", 100 * std::expm1(c.against[*c.rival].mean),
                        intervalText({100 * std::expm1(interval.low), 100 * std::expm1(interval.high)}));
  if (const double factor = computeBayesFactor(c.against[*c.rival]); !c.told(*c.rival) && std::isfinite(factor))
    text += fmt::format(" Bayes factor for a difference: {}.", shortNumber(factor));
  if (c.overSubjects)
    text += fmt::format(" It is the closest for {} of {} ({}).", c.closest[*c.best], plural(c.subjects, "subject"),
                        shareText(c.closest[*c.best], c.subjects));
  if (c.signFlipP) text += fmt::format(" The same by exchange of signs: {}.", pText(*c.signFlipP));
  if (!c.posterior.empty())
    text += fmt::format(" Probability that it is the most frequent among people: {:.2f} (protected exceedance; {:.2f} is asked for).",
                        c.posterior[*c.best], kMinExceedance);
  text += fmt::format(" R² {:.3f}; the mean of a person's other trials reaches {:.3f}.", c.r2, c.ceiling);
  if (c.misfit.mean != 0)
    text += fmt::format(" Lack of fit: held-out squared errors are {:.0f} % {} those of that mean ({}).",
                        100 * std::abs(std::expm1(c.misfit.mean)), c.misfit.mean > 0 ? "above" : "below", pText(c.misfit.p));
  if (const std::string fit = fitText(c, names); !fit.empty()) text += " " + fit.substr(0, fit.size() - 1);
  return text;
}

std::string describeTogether(const Analysis& analysis) {
  if (analysis.conditions.size() < 2 || analysis.together.empty()) return {};
  std::vector<std::string> in, out;
  for (std::size_t c = 0; c < analysis.conditions.size(); ++c)
    (std::find(analysis.together.begin(), analysis.together.end(), c) != analysis.together.end() ? in : out)
        .push_back(analysis.conditions[c].name);
  std::string text = "Over " + joined(in) + ".";
  if (!out.empty())
    text += fmt::format(" Left out: {}, where not each of these subjects has {} successful trials.", joined(out), kFewestTrials);
  return text;
}

std::string describeChoices(const Analysis& analysis, const std::vector<std::size_t>& conditions,
                            const std::vector<predict::Criterion>& criteria) {
  std::map<std::string, std::size_t> laws;
  std::vector<std::string> masses;
  std::vector<double> tried;
  bool given = false;
  for (const PersonResult& person : analysis.people) {
    if (!person.fitted || std::find(conditions.begin(), conditions.end(), person.condition) == conditions.end()) continue;
    const CandidateSet& set = analysis.results[person.condition].candidates;
    tried = set.masses;
    given = set.massGiven;
    for (std::size_t k = 0; k < set.candidates.size(); ++k) {
      if (set.candidates[k].criteria != criteria) continue;
      const ShapeChoice& choice = person.fit.candidates[k].choice;
      ++laws[choice.law == TimeLaw::Anew ? "planned anew for each duration" : "one plan run faster or slower"];
      if (const auto& mass = person.fit.candidates[k].mass)
        masses.push_back(fmt::format("{} kg {} ({}{}{})", shortNumber(mass->mass), intervalText(mass->interval), person.subject,
                                     conditions.size() > 1 ? ", " + analysis.conditions[person.condition].name : "",
                                     mass->atEdge ? ", at the edge of the range" : ""));
    }
  }
  std::vector<std::string> chosen;
  for (const auto& [law, n] : laws) chosen.push_back(fmt::format("{} ({})", law, n));
  std::string text;
  if (!tried.empty())
    text = given ? fmt::format("The hand's mass was given, {} kg.", shortNumber(tried.front()))
                 : fmt::format("The hand's mass was searched from {} to {} kg for (4) to (6).", shortNumber(tried.front()),
                               shortNumber(tried.back()));
  if (!chosen.empty()) text += " Chosen for the closest: " + joined(chosen) + ".";
  if (!masses.empty()) text += " Its hand mass with the 95 % interval: " + joined(masses) + ".";
  return text;
}

namespace {

/// "a counterclockwise curl field of 13 N s/m", "a rotation of the cursor by 30°".
std::string describeTraining(const TaughtTrials& person) {
  if (person.rotated) {
    const auto rotated = std::find_if(person.trials.begin(), person.trials.end(), [](const auto* t) { return t->scene.rotation != 0; });
    return fmt::format("a rotation of the cursor by {}° {}", shortNumber(std::abs((*rotated)->scene.rotation)),
                       (*rotated)->scene.rotation > 0 ? "counterclockwise" : "clockwise");
  }
  const TrialScene& scene =
      (*std::find_if(person.trials.begin(), person.trials.end(), [](const auto* t) { return t->scene.inField; }))->scene;
  if (!person.field) return "a viscous field of the joints";
  const experiment::SquareMatrix<3>& b = *person.field;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (b[i][j] != -b[j][i]) return "a viscous field";
  const Vec3 turn{b[2][1], b[0][2], b[1][0]};  // B v = turn x v
  return fmt::format("a {} curl field of {} N s/m", dot(turn, scene.normal) > 0 ? "counterclockwise" : "clockwise",
                     shortNumber(norm(turn)));
}

/// A mean over people with its interval: "12 [9, 15] mm".
std::string meanText(const std::vector<double>& values, const char* unit, double scale) {
  const TTest test = computeTTest(values);
  const Bounds interval = values.size() > 1 ? intervalOf(test) : Bounds{NAN, NAN};
  std::string text = shortNumber(scale * test.mean);
  if (interval.finite()) text += " " + intervalText({scale * interval.low, scale * interval.high});
  return text + " " + unit;
}

std::string describeGroup(const std::string& training, bool rotated, const std::vector<Learning>& people) {
  const auto known = [&](double Learning::*number) {
    std::vector<double> values;
    for (const Learning& person : people)
      if (std::isfinite(person.*number)) values.push_back(person.*number);
    return values;
  };
  const double scale = rotated ? 1 : 1e3;
  // The side is in the number's sign everywhere else, and a word here.
  const auto sided = [&](double Learning::*number) {
    std::vector<double> values = known(number);
    const bool positive = computeMeanSd(values).mean >= 0;
    for (double& value : values) value *= positive ? 1 : -1;
    return meanText(values, rotated ? "°" : "mm", scale) + (rotated    ? positive ? " counterclockwise" : " clockwise"
                                                            : positive ? " to the right"
                                                                       : " to the left");
  };
  std::string text = fmt::format("In {}, {} ", training, plural(people.size(), "subject"));
  if (const auto plateau = known(&Learning::plateau); !plateau.empty()) {
    const TTest test = computeTTest(plateau);
    const Bounds interval = intervalOf(test);
    const bool shown = test.mean > 0 && (!interval.finite() || interval.low > 0);
    text += fmt::format("{} {} of it ({} of the last quarter of the training).{}", shown ? "learned to cancel" : "cancelled",
                        meanText(plateau, "%", 1), rotated ? "rotated trials" : "channel trials",
                        shown ? "" : " It is not shown that they learned.");
  } else
    text += fmt::format("deviated by {} at first and by {} in the last quarter of the training.", sided(&Learning::first),
                        sided(&Learning::last));
  const auto after = known(&Learning::afterEffect), first = known(&Learning::first);
  if (after.empty()) return text + " No trial without it followed, so that no after-effect is known.";
  const TTest shown = computeTTest(after);
  const Bounds within = intervalOf(shown);
  constexpr double kNothing = 1e-6;  // [mm] or [degrees]
  if (scale * std::abs(shown.mean) < kNothing || (within.finite() && within.low <= 0 && within.high >= 0))
    return text + fmt::format(" Without it they then deviated by {}. No after-effect is shown.", sided(&Learning::afterEffect));
  const bool opposite = shown.mean * computeMeanSd(first).mean < 0;
  return text + fmt::format(" Without it they then deviated by {}, {} deviation at first (after-effect).", sided(&Learning::afterEffect),
                            opposite ? "against the" : "to the side of the");
}

}  // namespace

std::string describeLearning(const Analysis& analysis) {
  std::map<std::string, std::pair<bool, std::vector<Learning>>> groups;
  for (const TaughtTrials& person : taughtTrials(analysis)) {
    const Learning learning = learningOf(person);
    if (!std::isfinite(learning.plateau) && !std::isfinite(learning.first)) continue;  // practice alone
    auto& [rotated, people] = groups[describeTraining(person)];
    rotated = person.rotated;
    people.push_back(learning);
  }
  std::string text;
  for (const auto& [training, group] : groups) text += (text.empty() ? "" : " ") + describeGroup(training, group.first, group.second);
  return text;
}

std::string describeMethods(const Analysis& analysis) {
  const AnalysisOptions& o = analysis.options;
  const OnsetOptions& onset = o.measure.onset;
  std::string rule;
  switch (onset.rule) {
    case OnsetRule::Percent:
      rule = fmt::format("where the hand's speed crosses {} % of the trial's own peak, searched back from the movement's first hump",
                         shortNumber(onset.percent));
      break;
    case OnsetRule::Absolute:
      rule = fmt::format("where the hand's speed crosses {} m/s, searched back from the movement's first hump", shortNumber(onset.speed));
      break;
    case OnsetRule::Task: rule = "by the task's own window (from t = 0 to the end of the trial)"; break;
  }
  const std::string filter =
      o.measure.cutoff > 0
          ? fmt::format(
                "The hand's position was differentiated and its velocity low-passed forwards and backwards (Butterworth, second order, "
                "{} Hz in each pass, so no delay); the simulated masses were not filtered.",
                shortNumber(o.measure.cutoff))
          : std::string("The hand's position was differentiated without a filter.");
  const auto [least, largest] = std::minmax_element(o.handMasses.begin(), o.handMasses.end());
  const std::string mass =
      o.handMass ? fmt::format("The mass of the hand was given, {} kg.", shortNumber(*o.handMass))
                 : fmt::format("Where the experiment gives no mass of the hand, it was fitted from {} to {} kg for criteria (4) to (6).",
                               shortNumber(*least), shortNumber(*largest));
  return fmt::format(
      "{} Onset and offset are {}; a movement ends with its trial at the latest, that is when every mass was inside the tolerances. Each "
      "criterion of Table 1, and a minimum jerk of the hand that ignores the object, was fitted to every successful trial by least "
      "squares over onset, duration and amplitude, in one window that is the same for all (from 0.3 s before the hand first exceeds 5 % "
      "of its peak to 50 ms before the record ends), with predictions filtered as the recording is. Samples were weighted by the inverse "
      "of the person's own scatter at that phase of the movement (at least a tenth of the largest). A plan was either made anew for each "
      "trial's duration or one plan run faster or slower (within 7 % of the median duration). {}{} Time law and mass were chosen on four "
      "fifths of a person's trials, and each trial scored, ln S with S the weighted sum of squares, with the choice of the four fifths "
      "that it is not in. A person's score is the mean over trials, over conditions the mean of their means. One person is decided for a "
      "criterion if p < {} against every other and the reference (two-sided t over trials, the number of trials reduced by their serial "
      "correlation) and their scores are {} or more above its own: squared errors that differ by less are not told apart, however many "
      "trials there are. Nobody is decided for a criterion that fits worse than the person's other trials do, by their mean or by a line "
      "over the duration (score {} or more above theirs with p < {}, or 1 - R² more than {} times what the ceiling leaves), whose "
      "residuals are the same in every trial or grow with the duration ({} of their mean square and {} of the speed or more, p < {} by "
      "the exchange of signs) or go towards another candidate ({} of the way or more, one-sided p < {}, corrected for their number), or "
      "while a hand mass outside the range might be nearer. People are decided for one from {} on if p < {} against every other and the "
      "reference (paired t over subjects), the same least difference, the protected exceedance probability of random-effects model "
      "selection is at least {}, and no subject is decided for another. Fewer than {} successful trials of a subject and condition are "
      "described only. The paper's ε is its root mean squared difference of velocity against the prediction for {}, each trial "
      "time-scaled to the prediction with the distance kept, over 101 samples of every trial; fitted ε is that of the fits, unweighted. "
      "Intervals are 95 %: t over subjects for means, differences and slopes (those of differences of ε Bonferroni-corrected; those of "
      "success never narrower than the binomial scatter of the subjects' own trials makes them), Clopper and Pearson's for one subject's "
      "share of successes. The share of a typical subject is the mean of the subjects' empirical logits, back as a share. Effects of day "
      "and pace are paired over subjects, their odds ratios from the subjects' empirical logits, p corrected by Holm's method.",
      filter, rule, mass, o.handDamping > 0 ? fmt::format(" Damping of the hand: {} N s/m.", shortNumber(o.handDamping)) : "", kTrialsLevel,
      kLeastDifference, kLeastMisfit, kMisfitLevel, kMostUnexplained, kLeastSystematic, kLeastSystematicSpeed, kSystematicLevel,
      kLeastMixture, kMixtureLevel, kFewestSubjects, kSubjectsLevel, kMinExceedance, kFewestTrials,
      o.predictFor == PredictionDuration::Task ? "the task's duration" : "the duration that was moved");
}

std::string describeLimits(const Analysis&) {
  return "Limits: closest among the candidates is not proved; a criterion that was not compared may be nearer. Only hand velocity along "
         "the path decides, and only of successful trials: tolerances that let few trials through choose which movements are seen. "
         "Criteria (4) and (6) are one prediction unless the hand is damped, and with a hand mass other pairs come within 1 % of the "
         "peak of each other, which thirty trials do not tell apart. Measures of a peak (time to peak, symmetry) mean little where the "
         "speed has two. Replayed reaches are scaled so that their farthest point is the target, so their overshoot is near zero by "
         "construction.";
}

std::string describeCounts(const ConditionResult& r) {
  const std::size_t attempts = r.counts.success + r.counts.failure;
  std::string text = fmt::format("{} of {} succeeded", r.counts.success, plural(attempts, "trial"));
  if (attempts > 0) text += fmt::format(" ({:.0f} %)", 100.0 * static_cast<double>(r.counts.success) / static_cast<double>(attempts));
  if (r.success)
    text += fmt::format("; a typical one of the {} {:.0f} % {} (mean of their empirical logits)", plural(r.success->people, "subject"),
                        100 * r.success->mean, intervalText(r.success->interval.percent()));
  std::vector<std::string> rest;
  if (r.counts.aborted > 0) rest.push_back(fmt::format("{} aborted", r.counts.aborted));
  if (const std::size_t n = r.counts.interrupted - r.counts.invalidTiming; n > 0) rest.push_back(fmt::format("{} interrupted", n));
  if (r.counts.invalidTiming > 0)
    rest.push_back(fmt::format("{} with invalid timing (more ticks missed than allowed), left out", r.counts.invalidTiming));
  if (r.counts.practice > 0) rest.push_back(plural(r.counts.practice, "practice trial"));
  if (r.counts.catchTrials > 0) rest.push_back(plural(r.counts.catchTrials, "catch trial"));
  for (const auto& [reason, n] : r.exclusions)
    if (reason.starts_with("excluded")) rest.push_back(fmt::format("{} {}", plural(n, "trial"), reason));  // by a person
  if (!rest.empty()) text += "; besides " + joined(rest);
  std::vector<std::string> why;
  for (const auto& [reason, n] : r.reasons) why.push_back(fmt::format("{} × {}", n, reason));
  if (!why.empty()) text += ". Reasons: " + joined(why);
  text += fmt::format(". {} in profiles and errors.", plural(r.used, r.onlyFailures ? "failed trial" : "trial"));
  if (r.used > 0)
    text += fmt::format(" Movement time {:.2f} s (least {:.2f}, largest {:.2f}).", r.movementTime.mean, r.movementRange.low,
                        r.movementRange.high);
  if (r.counts.beforeGo > 0)
    text +=
        fmt::format(" In {} the hand left before the go signal: no reaction time is given for them.", plural(r.counts.beforeGo, "trial"));
  if (r.counts.otherWay > 0)
    text += fmt::format(" {} went round the closed curve the other way; velocity is counted along the way that the hand went.",
                        plural(r.counts.otherWay, "trial"));
  return text;
}

std::string describeEffect(const Analysis& analysis, const Effect& e) {
  const std::string what = e.ofDay ? fmt::format("{}, D{} − D{}", analysis.conditions[e.condition].name, e.to, e.from)
                                   : fmt::format("{} − {}", analysis.conditions[static_cast<std::size_t>(e.to)].name,
                                                 analysis.conditions[static_cast<std::size_t>(e.from)].name);
  std::string text = fmt::format("{}: {}{} percentage points", what, e.points.mean >= 0 ? "+" : "", shortNumber(e.points.mean));
  if (e.people < 2) return text + " (one subject: no interval).";
  return text + fmt::format(" {}, odds ratio {} {}, {} ({}).", intervalText(e.pointsInterval), shortNumber(std::exp(e.logit.mean)),
                            intervalText({std::exp(e.logitInterval.low), std::exp(e.logitInterval.high)}), pText(e.p),
                            plural(e.people, "subject"));
}

std::string describeSlope(const Analysis& analysis, const LearningSlope& s) {
  // Ten trials are fewer than any series has: a slope in a hundred of them may be more than all successes.
  constexpr double kTens = 10;
  std::string text = fmt::format("{}: {}{} percentage points per ten trials", analysis.conditions[s.condition].name,
                                 s.perHundred >= 0 ? "+" : "", shortNumber(s.perHundred / kTens));
  if (s.people < 2) return text + " (one subject: no interval).";
  return text + fmt::format(" {}, {} ({}).", intervalText({s.interval.low / kTens, s.interval.high / kTens}), pText(s.p),
                            plural(s.people, "subject"));
}

}  // namespace reachlab::analysis
