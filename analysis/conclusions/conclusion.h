#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analysis/conclusions/comparison.h"
#include "analysis/conclusions/systematic_rest.h"

/// The rule that names the candidate that one person's or several people's movements follow, or refuses to. Pure functions for any thread.
namespace reachlab::analysis {

/// One person in one condition: the held-out scores y = ln S [candidate][trial], in the order the trials were made.
struct ConditionScores {
  std::size_t condition = 0;
  std::vector<std::vector<double>> score;
  // The same with hand masses outside the range [candidate][trial], empty for a candidate whose mass is not at the edge of the range. The
  // whole vector may be empty.
  std::vector<std::vector<double>> beyond;
  std::vector<double> own;                 // ln S of each trial for the mean of the person's other trials. Empty: not compared with it
  std::vector<SystematicRest> systematic;  // one a candidate. Empty: residuals are not tested
  // How far each trial goes from a candidate towards another [candidate][other][trial]. May be empty.
  std::vector<std::vector<std::vector<double>>> toward;
  double effectiveSamples = 10;  // of a trial
  std::vector<double> r2;        // one a candidate
  double ceiling = 1;            // R^2 of the person's own mean
};
struct PersonScores {
  std::string subject;
  std::vector<ConditionScores> conditions;  // all with the same candidates
  std::size_t trials() const;
};

/// Two candidates by index: for a hand of unlimited mass the first becomes the second.
struct HeavyLimit {
  std::size_t candidate = 0, becomes = 0;
};

enum class Obstacle { None, TooFewTrials, TooFewSubjects, Reference, NotToldApart, SubjectsDiffer, MassAtEdge, Poor, NothingToCompare };
/// "", "too_few_trials", "too_few_subjects", "reference", "not_told_apart", "subjects_differ", "mass_at_edge", "poor",
/// "nothing_to_compare".
std::string_view nameOf(Obstacle reason);

/// Of ln S: a candidate whose squared errors are less than 10 % above the closest candidate's is not told from it, whatever p says.
/// Trials of one hand tell such neighbours apart significantly, and now and then the wrong way round (docs/analysis.md, "Does it find the
/// truth?").
inline constexpr double kLeastDifference = 0.1;
inline constexpr double kTrialsLevel = 0.01, kSubjectsLevel = 0.05, kMinExceedance = 0.85;
/// Of ln S: a candidate whose squared errors are this much above those of the person's own mean does not describe the movements.
inline constexpr double kLeastMisfit = 0.05, kMisfitLevel = 0.05;
/// Nor does a candidate whose residuals are systematic, or go towards another candidate: the chances of rejecting a right one. Smaller parts of
/// the mean square, and of the way to the other candidate, do not count, however many trials show them. Nor does a systematic rest below half a
/// percent of the speed (RMS): the fits of one plan are no more exact, since they know the recording's filter for the plan's duration alone.
inline constexpr double kLeastSystematicSpeed = 0.005;
inline constexpr double kSystematicLevel = 0.01, kMixtureLevel = 0.01, kLeastSystematic = 0.05, kLeastMixture = 0.125;
/// Of (1 - R^2) / (1 - ceiling): with more unexplained squares than this, a candidate does not describe all trials, whatever its mean score.
inline constexpr double kMostUnexplained = 1.2;
inline constexpr std::size_t kFewestSubjects = 5, kFewestForSignFlip = 6;

struct Conclusion {
  bool overSubjects = false;           // unit "subjects", else one person's "trials"
  std::optional<std::size_t> follows;  // candidate that was decided for
  std::optional<std::size_t> best;     // least score; may be the reference
  Obstacle reason = Obstacle::TooFewTrials;
  double level = kTrialsLevel;
  double p = 1;                      // the largest of all comparisons with the best
  std::optional<std::size_t> rival;  // the candidate of that comparison, which is the least certain
  double referenceP = 1;             // best against the reference
  bool referenceFirst = false;
  std::size_t subjects = 0, trials = 0;
  std::string subject;               // the one person's label; empty over subjects
  std::size_t leftOut = 0;           // people without conditions, for lack of trials
  std::vector<std::size_t> closest;  // people whose own least score each candidate has
  std::vector<double> posterior;     // protected exceedance probability of each candidate; empty for one person
  std::optional<double> signFlipP;   // of the rival, from six people on
  std::vector<double> score;         // Y of each candidate: mean over conditions of the mean over trials, over people
  std::vector<TTest> against;        // of each candidate: score - best's score
  // pairs with p above the level after Holm's correction, or too small a difference
  std::vector<std::pair<std::size_t, std::size_t>> notToldApart;
  double r2 = 0, ceiling = 0;  // of the best candidate; of people's own means
  TTest misfit;                // best's score - that of the person's own mean. p = 1 if it was not compared with it
  SystematicRest systematic;   // of the best candidate
  // The other candidate towards which the movements go most surely, and how far: 0 at the best, 1 at the other. `mixtureP` is one-sided and
  // corrected for the number of others (Bonferroni). 1 if it was not tested.
  std::optional<std::size_t> mixedWith;
  TTest mixture;
  double mixtureP = 1;
  // Candidates with a hand mass at the edge of the range that might be nearer with a mass outside it.
  std::vector<std::size_t> atEdge;
  std::vector<std::optional<std::size_t>> each;  // what each person was decided for; parallel to the people given
  bool decided() const { return follows.has_value(); }
  /// The closest candidate is told from `candidate`: p below the level, and a score that is lower by kLeastDifference or more.
  bool told(std::size_t candidate) const { return against[candidate].p < level && against[candidate].mean >= kLeastDifference; }
};

/// The conclusion about one person in any number of conditions. A candidate is named if its scores differ from those of every other candidate
/// and of the reference at p < 0.01 (an intersection-union test). `reference` is the index of the candidate that ignores the object, and `candidates`
/// counts it. The conclusion says nothing about other people.
Conclusion concludePerson(const PersonScores& person, std::size_t candidates, std::size_t reference,
                          const std::vector<HeavyLimit>& limits = {});

/// The conclusion about several people, with one number per person. A single person is judged by concludePerson. At least five
/// people are needed to name a candidate. Its scores must differ from every rival's at p < 0.05 (paired t over people), and its protected
/// exceedance probability must be 0.85 or more. No person's own conclusion may name a rival. People without conditions are left out.
Conclusion concludePeople(const std::vector<PersonScores>& people, std::size_t candidates, std::size_t reference,
                          const std::vector<HeavyLimit>& limits = {});

}  // namespace reachlab::analysis
