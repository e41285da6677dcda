#include <map>
#include <vector>

#include "analysis/tables.h"
#include "sim/record/export/column_dictionary.h"

namespace reachlab::analysis {
namespace {

constexpr record::ColumnMeaning kShared[] = {{"subject", "Subject's label, letters and digits; read it as text: 01 is not 1"},
                                             {"session", "Session's label, letters and digits; read it as text: 01 is not 1"},
                                             {"run", "Run number within the session, as in the file names"},
                                             {"block", "Block of the session's plan, from 1"},
                                             {"trial", "Trial number within the block, from 1"},
                                             {"day", "Day of the plan, else the session's place among the subject's"},
                                             {"condition", "Condition of the plan, else the experiment's name"},
                                             {"criterion", "Optimality criterion, as reach list criteria names it"},
                                             {"signal", "Whose velocity: hand, or object (the last mass)"},
                                             {"percent", "Place in the movement, from onset (0) to offset (100)"},
                                             {"time_s", "Time since onset, scaled to the condition's mean duration"},
                                             {"successes", "Attempts that ended as success"},
                                             {"success_percent", "Share of the attempts that ended as success"},
                                             {"low_percent", "Lower end of Clopper and Pearson's exact 95 % interval of that share"},
                                             {"high_percent", "Upper end of Clopper and Pearson's exact 95 % interval of that share"},
                                             {"experiment", "Name of the experiment"},
                                             {"mean_duration_s", "Mean duration, onset to offset, of the used trials"},
                                             {"sd_duration_s", "Standard deviation (n - 1) of that duration"},
                                             {"mean_movement_time_s", "Mean of the task's own movement time over the used trials"},
                                             {"sd_movement_time_s", "Standard deviation (n - 1) of that time"}};

constexpr record::ColumnMeaning kTrials[] = {
    {"phase",
     "Whether the block counts: practice or recorded. In exported samples a column of this name is the trial's own phase, a number"},
    {"outcome", "How the trial was judged: success, failure, aborted or interrupted"},
    {"reason", "Which tolerance was missed, or what stopped the trial; empty for a success"},
    {"mass", "Mass that missed the tolerance, from 1; 0: none"},
    {"by", "Excess over the tolerance: m where reason is position, m/s where velocity, s where time_short or time_long"},
    {"used", "1: the trial is in profiles and errors"},
    {"exclusion", "Why the trial is not used; empty if it is"},
    {"before_go", "1: the hand left before the go signal, so that there is no reaction time"},
    {"other_way", "1: the hand went round a closed curve the other way; velocities are along the way it went"},
    {"reaction_time_s", "From the go signal to onset; empty where the hand left before it"},
    {"onset_s", "Movement onset, since arming"},
    {"offset_s", "Movement offset, since arming"},
    {"duration_s", "From onset to offset"},
    {"movement_time_s", "The task's own: from its onset to the end, or to where the trial was broken off"},
    {"peak_speed_m_per_s", "Largest speed of the hand"},
    {"time_to_peak_s", "From onset to the largest speed"},
    {"time_to_peak_percent", "The same as a share of duration_s"},
    {"symmetry_ratio", "Time to the peak over time from the peak to offset"},
    {"path_length_m", "Length of the hand's path from onset to offset"},
    {"speed_peaks", "Number of local maxima of the speed with a prominence of 5 % of the peak or more"},
    {"hand_endpoint_error_m", "Hand's displacement at offset against target minus start"},
    {"object_endpoint_error_m", "Distance of the last mass from the target at the trial's end"},
    {"hand_overshoot_m", "Farthest that the hand went beyond the target along the line, 0 or more; empty on bent constraints"},
    {"object_overshoot_m", "Farthest that the last mass went beyond the target along the line, 0 or more; empty on bent constraints"},
    {"sparc", "Spectral arc length of the speed, without unit (Balasubramanian et al. 2015)"},
    {"ldlj", "Log dimensionless jerk, without unit (Balasubramanian et al. 2015)"},
    {"peak_force_n", "Largest coupling force on the object in the movement"},
    {"mean_force_n", "Mean coupling force on the object in the movement"},
    {"epsilon_hand_*",
     "Paper's epsilon of the hand's velocity against the criterion that the column names, time-scaled to its prediction; empty if not "
     "used"},
    {"epsilon_object_*",
     "Paper's epsilon of the last mass's velocity against the criterion that the column names, time-scaled to its prediction; empty if not "
     "used"}};

constexpr record::ColumnMeaning kProfiles[] = {{"hand_m_per_s", "Hand's velocity, time-scaled to the condition's mean duration"},
                                               {"object_m_per_s", "Last mass's velocity, time-scaled to the condition's mean duration"}};

constexpr record::ColumnMeaning kMeanProfiles[] = {{"trials", "Trials that the mean is over"},
                                                   {"hand_mean_m_per_s", "Mean velocity of the hand over the used trials"},
                                                   {"hand_sd_m_per_s", "Standard deviation (n - 1) of the hand's velocity"},
                                                   {"object_mean_m_per_s", "Mean velocity of the last mass over the used trials"},
                                                   {"object_sd_m_per_s", "Standard deviation (n - 1) of the last mass's velocity"}};

constexpr record::ColumnMeaning kPredictions[] = {
    {"predicted_duration_s", "T that was predicted for"},
    {"percent", "Place in the prediction, from its beginning (0) to T (100)"},
    {"time_s", "Time since the onset that the rule for trials would find, so that it lies beside them; negative before it"},
    {"hand_m_per_s", "Predicted velocity of the hand, neither cut nor stretched nor filtered"},
    {"object_m_per_s", "Predicted velocity of the last mass, neither cut nor stretched"}};

constexpr record::ColumnMeaning kRanking[] = {
    {"rank", "Place of the criterion by the paper's epsilon, 1 is the least; a description, conclusions are in conclusions.csv"},
    {"epsilon_m_per_s", "Paper's epsilon over all samples of the used trials"},
    {"epsilon_low_m_per_s", "Lower end of the 95 % t interval of people's epsilons; empty for one person"},
    {"epsilon_high_m_per_s", "Upper end of that interval"},
    {"difference_m_per_s", "Mean over people of epsilon less that of the first"},
    {"difference_low_m_per_s", "Lower end of the difference's 95 % t interval over people, Bonferroni-corrected"},
    {"difference_high_m_per_s", "Upper end of that interval"},
    {"apart_from_first", "yes if the difference's interval excludes 0, no if not; empty for the first and for one person"},
    {"trials", "Trials that the errors are over"},
    {"subjects", "Subjects that the trials are from"}};

constexpr record::ColumnMeaning kFits[] = {
    {"criterion", "Candidate: an optimality criterion, or reference, a minimum jerk of the hand that ignores the object"},
    {"equivalent", "Criteria that predict the same hand, with ; between"},
    {"epsilon_fit_m_per_s", "Fitted epsilon: root of the mean squared residual over the windows' samples, unweighted"},
    {"r2", "1 less the weighted sum of squared residuals over that of the velocity"},
    {"score", "Mean of ln S over the trials, each with the shape that the other folds chose; lower is nearer"},
    {"ceiling", "R^2 of the mean of the person's other trials: what any description could reach"},
    {"duration_s", "Fitted duration; in fits.csv the mean"},
    {"time_law", "How the plan follows the duration: anew for each, or one-plan run faster or slower; empty for the reference"},
    {"plan_s", "Duration of the one plan; empty where it is made anew"},
    {"hand_mass_kg", "Mass of the hand that was chosen; empty where it changes nothing"},
    {"trials", "Successful trials that were fitted"},
    {"decided", "1: this subject's trials of this condition are decided for the criterion"}};

constexpr record::ColumnMeaning kFitTrials[] = {
    {"fold", "Fold of the trial, 0 to 4: its score is with the shape that the other folds chose"},
    {"criterion", "Candidate: an optimality criterion, or reference"},
    {"onset_s", "Fitted onset, since arming"},
    {"duration_s", "Fitted duration"},
    {"amplitude_m_per_s", "Fitted amplitude of the dimensionless profile: distance over duration"},
    {"epsilon_fit_m_per_s", "Fitted epsilon of the trial"},
    {"r2", "1 less the weighted sum of squared residuals over that of the velocity"},
    {"score", "ln S, held out; lower is nearer"}};

constexpr record::ColumnMeaning kConclusions[] = {
    {"condition", "Condition; all: every condition together"},
    {"unit", "What the test is over: subjects, or one subject's trials"},
    {"criterion", "Candidate: an optimality criterion, or reference"},
    {"score", "Mean over people of their score; lower is nearer"},
    {"score_above_best", "Its difference to the best candidate's"},
    {"p", "Two-sided p of that difference; empty for the best"},
    {"posterior", "Protected exceedance probability: that it is the most frequent among people; empty for one subject"},
    {"best", "yes for the candidate that is closest"},
    {"decided", "1: the movements follow it, by the rule of docs/analysis.md"},
    {"reason", "Why nothing is decided; empty where it is"},
    {"level", "Level that p is held against"},
    {"subjects", "Subjects that were judged"},
    {"trials", "Trials that were judged"}};

constexpr record::ColumnMeaning kEffects[] = {
    {"effect", "day: a later day less the day before; condition: one less another; slope: of success against trial number"},
    {"condition", "Condition of a day's effect or slope; empty where two are compared"},
    {"from", "What the difference is taken from"},
    {"to", "What is compared with it"},
    {"subjects", "Subjects with both"},
    {"difference_percent", "Mean over subjects of the difference in percentage points; of a slope, points in 100 trials"},
    {"low_percent", "Lower end of its 95 % t interval over subjects; empty for one"},
    {"high_percent", "Upper end of that interval"},
    {"odds_ratio", "Odds of success after over before, from subjects' empirical logits"},
    {"odds_ratio_low", "Lower end of its 95 % interval"},
    {"odds_ratio_high", "Upper end of that interval"},
    {"p", "Two-sided p; of days and of conditions by the logits, corrected by Holm's method"}};

constexpr record::ColumnMeaning kSeries[] = {{"epsilon_m_per_s", "Paper's epsilon over all samples of the run's used trials"},
                                             {"trials", "Used trials of the run"}};

constexpr record::ColumnMeaning kSuccess[] = {{"trials", "Attempts: successes and failures; aborted and interrupted trials are none"}};

constexpr record::ColumnMeaning kLearning[] = {
    {"first_trial", "First attempt of the group, counted through all the subject's sessions, from 1"},
    {"last_trial", "Last attempt of the group, counted likewise"},
    {"trials", "Attempts of the group"}};

constexpr record::ColumnMeaning kConditions[] = {{"task_duration_s", "Duration that the task asks for"},
                                                 {"success", "Number of successes"},
                                                 {"failure", "Number of failures"},
                                                 {"aborted", "Number of aborted trials"},
                                                 {"interrupted", "Number of interrupted trials"},
                                                 {"invalid_timing", "Those of them in which more ticks were missed than allowed"},
                                                 {"before_go", "Trials in which the hand left before the go signal"},
                                                 {"other_way", "Trials that went round a closed curve the other way"},
                                                 {"least_movement_time_s", "Least movement time of the used trials"},
                                                 {"largest_movement_time_s", "Largest movement time of the used trials"},
                                                 {"practice", "Number of practice trials, left out unless they were asked for"},
                                                 {"catch", "Number of catch trials, always left out"},
                                                 {"used", "Number of trials in profiles and errors"},
                                                 {"used_outcome", "Outcome of the used trials: success, or failure where none succeeded"},
                                                 {"onset_rule", "Rule for onset and offset: percent, absolute or task"},
                                                 {"onset_percent", "Share of the trial's peak speed, for the rule percent"},
                                                 {"onset_speed_m_per_s", "Speed, for the rule absolute"},
                                                 {"cutoff_hz", "Cut-off of the low-pass on the hand's velocity; 0: none"},
                                                 {"hand_mass_kg", "Mass of the hand in the predictions of the paper's epsilon"},
                                                 {"hand_masses_tried_kg", "Masses of the hand that the fits tried, with ; between"},
                                                 {"hand_damping_n_s_per_m", "Damping of the hand in the predictions"}};

}  // namespace

std::string tableDictionary(const std::string& name, const std::string& header) {
  static const std::map<std::string, std::span<const record::ColumnMeaning>> kOwn{{"trials.csv", kTrials},
                                                                                  {"profiles.csv", kProfiles},
                                                                                  {"mean_profiles.csv", kMeanProfiles},
                                                                                  {"predictions.csv", kPredictions},
                                                                                  {"ranking.csv", kRanking},
                                                                                  {"series.csv", kSeries},
                                                                                  {"fits.csv", kFits},
                                                                                  {"fit_trials.csv", kFitTrials},
                                                                                  {"conclusions.csv", kConclusions},
                                                                                  {"effects.csv", kEffects},
                                                                                  {"success_table.csv", kSuccess},
                                                                                  {"learning.csv", kLearning},
                                                                                  {"conditions.csv", kConditions}};
  const auto own = kOwn.find(name);
  if (own == kOwn.end()) return {};
  std::vector<record::ColumnMeaning> meanings(own->second.begin(), own->second.end());  // a table's own word goes before the shared one
  meanings.insert(meanings.end(), std::begin(kShared), std::end(kShared));
  return record::columnDictionary(header, meanings);
}

}  // namespace reachlab::analysis
