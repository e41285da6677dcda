#include <map>
#include <vector>

#include "sim/analyze/tables.h"
#include "sim/record/column_dictionary.h"

namespace reachlab::analyze {
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
                                             {"low_percent", "Lower end of Wilson's 95 % interval of that share"},
                                             {"high_percent", "Upper end of Wilson's 95 % interval of that share"},
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
    {"reaction_time_s", "From the go signal to onset"},
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
    {"epsilon_hand_*", "RMS error of the hand's velocity against the criterion that the column names; empty if not used"},
    {"epsilon_object_*", "RMS error of the last mass's velocity against the criterion that the column names; empty if not used"}};

constexpr record::ColumnMeaning kProfiles[] = {{"hand_m_per_s", "Hand's velocity, time-scaled to the condition's mean duration"},
                                               {"object_m_per_s", "Last mass's velocity, time-scaled to the condition's mean duration"}};

constexpr record::ColumnMeaning kMeanProfiles[] = {{"trials", "Trials that the mean is over"},
                                                   {"hand_mean_m_per_s", "Mean velocity of the hand over the used trials"},
                                                   {"hand_sd_m_per_s", "Standard deviation (n - 1) of the hand's velocity"},
                                                   {"object_mean_m_per_s", "Mean velocity of the last mass over the used trials"},
                                                   {"object_sd_m_per_s", "Standard deviation (n - 1) of the last mass's velocity"}};

constexpr record::ColumnMeaning kPredictions[] = {
    {"predicted_duration_s", "T that was predicted for"},
    {"hand_m_per_s", "Predicted velocity of the hand, cut at the trials' mean end level and scaled to their mean duration"},
    {"object_m_per_s", "Predicted velocity of the last mass, cut and scaled as the hand's"}};

constexpr record::ColumnMeaning kRanking[] = {
    {"condition", "Condition; all: every condition together"},
    {"bootstrap_over", "What was resampled for the intervals: trials, or subjects with their trials"},
    {"rank", "Place of the criterion, 1 is the nearest"},
    {"epsilon_m_per_s", "RMS error of the velocity against the criterion"},
    {"epsilon_low_m_per_s", "Lower end of its 95 % interval"},
    {"epsilon_high_m_per_s", "Upper end of its 95 % interval"},
    {"difference_m_per_s", "Farther than the first by"},
    {"difference_low_m_per_s", "Lower end of the difference's 95 % interval"},
    {"difference_high_m_per_s", "Upper end of the difference's 95 % interval"},
    {"share_of_resamples_first", "Share of the resamples in which the criterion was first, 0 to 1"},
    {"apart_from_first", "yes if the difference's interval excludes 0, no if not; empty for the first"},
    {"not_told_apart_from", "Criteria whose difference to this one has an interval that includes 0, with ; between"},
    {"trials", "Trials that the errors are over"},
    {"subjects", "Subjects that the trials are from"}};

constexpr record::ColumnMeaning kSeries[] = {{"epsilon_m_per_s", "RMS error of the velocity over all samples of the run's used trials"},
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
                                                 {"practice", "Number of practice trials, left out unless they were asked for"},
                                                 {"catch", "Number of catch trials, always left out"},
                                                 {"used", "Number of trials in profiles and errors"},
                                                 {"used_outcome", "Outcome of the used trials: success, or failure where none succeeded"},
                                                 {"onset_rule", "Rule for onset and offset: percent, absolute or task"},
                                                 {"onset_percent", "Share of the trial's peak speed, for the rule percent"},
                                                 {"onset_speed_m_per_s", "Speed, for the rule absolute"},
                                                 {"cutoff_hz", "Cut-off of the low-pass on the hand's velocity; 0: none"},
                                                 {"hand_mass_kg", "Mass of the hand in the predictions"},
                                                 {"resamples", "Number of bootstrap resamples"},
                                                 {"bootstrap_seed", "Seed of the bootstrap"}};

}  // namespace

std::string tableDictionary(const std::string& name, const std::string& csv) {
  static const std::map<std::string, std::span<const record::ColumnMeaning>> kOwn{
      {"trials.csv", kTrials},           {"profiles.csv", kProfiles}, {"mean_profiles.csv", kMeanProfiles},
      {"predictions.csv", kPredictions}, {"ranking.csv", kRanking},   {"series.csv", kSeries},
      {"success_table.csv", kSuccess},   {"learning.csv", kLearning}, {"conditions.csv", kConditions}};
  const auto own = kOwn.find(name);
  if (own == kOwn.end()) return {};
  std::vector<record::ColumnMeaning> meanings(own->second.begin(), own->second.end());  // a table's own word goes before the shared one
  meanings.insert(meanings.end(), std::begin(kShared), std::end(kShared));
  return record::columnDictionary(csv, meanings);
}

}  // namespace reachlab::analyze
