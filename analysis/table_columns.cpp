#include "analysis/table_columns.h"

#include <algorithm>
#include <map>

#include "analysis/measures/measures.h"

namespace reachlab::analysis {
namespace {

using Columns = std::vector<record::ColumnMeaning>;

/// Columns of several files. A file gives another sentence where the column means something else there.
constexpr record::ColumnMeaning kShared[] = {
    {"subject", "Subject's label, letters and digits; read it as text: 01 is not 1"},
    {"session", "Session's label, letters and digits; read it as text: 01 is not 1"},
    {"run", "Run number within the session, as in the file names"},
    {"block", "Block of the session's plan, from 1"},
    {"trial", "Trial number within the block, from 1"},
    {"day", "Day of the plan, else the session's place among the subject's: numbers by value, before words by letter"},
    {"condition", "Condition of the plan and kind of trial, else the experiment's name; targets in several directions are pooled"},
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

constexpr std::string_view kMeasures = "MEASURES";        // all of `measures`, here
constexpr std::string_view kConclusions = "CONCLUSIONS";  // all columns of conclusions.csv, which comes before, here
constexpr std::string_view kChoice = "Choice of the analysis that differs from the asked ones; as asked: none";

/// The columns of a table: first the names of shared columns, then columns with their sentences. `own` may name shared columns too.
struct Table {
  std::string_view file, shared;
  Columns own;
};

const std::vector<Table>& tables() {
  static const std::vector<Table> kTables{
      {"trials.csv",
       "subject session run block trial day condition",
       {{"kind", "Kind of the trial in the plan; empty where its block has no kinds"},
        {"target",
         "Target of the trial in the plan, from 1, such as 3, and 3-back on the way back from it; empty where its block has one scene"},
        {"phase",
         "Whether the block counts: practice or recorded. In exported samples a column of this name is the trial's own phase, a number"},
        {"outcome", "How the trial was judged: success, failure, aborted or interrupted"},
        {"reason", "Which tolerance was missed, or what stopped the trial; empty for a success"},
        {"mass", "Mass that missed the tolerance, from 1; 0: none"},
        {"by", "Excess over the tolerance: m where reason is position, m/s where velocity, s where time_short"},
        {"used", "1: the trial is in profiles and errors"},
        {"exclusion", "Why the trial is not used; empty if it is"},
        {"before_go", "1: the hand left before the go signal, so that there is no reaction time"},
        {"other_way", "1: the hand went round a closed curve the other way; velocities are along the way it went"},
        {kMeasures},
        {"epsilon_hand_*",
         "Paper's epsilon of the hand's velocity against the criterion that the column names, time-scaled to its prediction; empty if not used"},
        {"epsilon_object_*",
         "Paper's epsilon of the last mass's velocity against the criterion that the column names, time-scaled to its prediction; empty if not "
         "used"}}},
      {"profiles.csv",
       "condition subject session run trial percent time_s",
       {{"hand_m_per_s", "Hand's velocity, time-scaled to the condition's mean duration"},
        {"object_m_per_s", "Last mass's velocity, time-scaled to the condition's mean duration"}}},
      {"mean_profiles.csv",
       "condition percent time_s",
       {{"trials", "Trials that the mean is over"},
        {"hand_mean_m_per_s", "Mean velocity of the hand over the used trials"},
        {"hand_sd_m_per_s", "Standard deviation (n - 1) of the hand's velocity"},
        {"object_mean_m_per_s", "Mean velocity of the last mass over the used trials"},
        {"object_sd_m_per_s", "Standard deviation (n - 1) of the last mass's velocity"}}},
      {"predictions.csv",
       "condition criterion",
       {{"predicted_duration_s", "T that was predicted for"},
        {"percent", "Place in the prediction, from its beginning (0) to T (100)"},
        {"time_s", "Time since the onset that the rule for trials would find, so that it lies beside them; negative before it"},
        {"hand_m_per_s", "Predicted velocity of the hand, neither cut nor stretched nor filtered"},
        {"object_m_per_s", "Predicted velocity of the last mass, neither cut nor stretched"}}},
      {"ranking.csv",
       "condition signal",
       {{"rank", "Place of the criterion by the paper's epsilon, 1 is the least; a description, conclusions are in conclusions.csv"},
        {"criterion"},
        {"epsilon_m_per_s", "Paper's epsilon over all samples of the used trials"},
        {"epsilon_mean_m_per_s", "Mean of people's own epsilons"},
        {"epsilon_low_m_per_s", "Lower end of the 95 % t interval of that mean, 0 or more; empty for one person"},
        {"epsilon_high_m_per_s", "Upper end of that interval"},
        {"difference_m_per_s", "Mean over people of epsilon less that of the first"},
        {"difference_low_m_per_s", "Lower end of the difference's 95 % t interval over people, Bonferroni-corrected"},
        {"difference_high_m_per_s", "Upper end of that interval"},
        {"apart_from_first", "yes if the difference's interval excludes 0, no if not; empty for the first and for one person"},
        {"trials", "Trials that the errors are over"},
        {"subjects", "Subjects that the trials are from"}}},
      {"series.csv",
       "subject session run block day condition signal criterion",
       {{"epsilon_m_per_s", "Paper's epsilon over all samples of the run's used trials"}, {"trials", "Used trials of the run"}}},
      {"fits.csv",
       "condition subject",
       {{"criterion", "Candidate: an optimality criterion, or reference, a minimum jerk of the hand that ignores the object"},
        {"equivalent", "Criteria that predict the same hand, with ; between"},
        {"epsilon_fit_m_per_s", "Fitted epsilon: root of the mean squared residual over the windows' samples, unweighted"},
        {"r2", "1 less the weighted sum of squared residuals over that of the velocity"},
        {"score", "Mean of ln S over the trials, each with the shape that the other folds chose; lower is nearer"},
        {"ceiling", "R^2 of the mean of the person's other trials: what any description could reach"},
        {"duration_s", "Fitted duration; in fits.csv the mean"},
        {"time_law", "How the plan follows the duration: anew for each, or one-plan run faster or slower; empty for the reference"},
        {"plan_s", "Duration of the one plan; empty where it is made anew"},
        {"hand_mass_kg", "Mass of the hand that fits best; empty where it changes nothing"},
        {"hand_mass_low_kg", "Lower end of the 95 % interval of the mass, cut at the range of masses; empty where the mass was given"},
        {"hand_mass_high_kg", "Upper end of that interval"},
        {"hand_mass_at_edge", "1: the interval reaches the edge of the range, so that a mass outside it may fit as well"},
        {"misfit", "Score less that of the mean of the person's other trials; above 0 the candidate fits worse than that mean"},
        {"systematic_share",
         "Part of the mean squared residual that returns in every trial or grows with the duration; about 0 for a right fit"},
        {"systematic_p",
         "Chance of so large a part if the candidate is right; with a share of 0.05 or more and p below 0.01 it does not fit"},
        {"toward", "Of the subject's closest candidate: the other candidate towards which the movements go most surely"},
        {"toward_share", "How far they go: 0 at the closest candidate, 1 at the other, 0.5 for the mean of both"},
        {"toward_p",
         "One-sided p of that share, corrected for the number of other candidates; with 0.125 or more and p below 0.01 it does not fit"},
        {"trials", "Successful trials that were fitted"},
        {"decided", "1: this subject's trials of this condition are decided for the criterion"},
        {"reason", "Why this subject's trials of this condition are decided for no criterion; empty where they are"}}},
      {"fit_trials.csv",
       "condition subject session run trial",
       {{"fold", "Fold of the trial, 0 to 4: its score is with the shape that the other folds chose"},
        {"criterion", "Candidate: an optimality criterion, or reference"},
        {"onset_s", "Fitted onset, since arming"},
        {"duration_s", "Fitted duration"},
        {"amplitude_m_per_s", "Fitted amplitude of the dimensionless profile: distance over duration"},
        {"epsilon_fit_m_per_s", "Fitted epsilon of the trial"},
        {"r2", "1 less the weighted sum of squared residuals over that of the velocity"},
        {"score", "ln S, held out; lower is nearer"},
        {"own_score", "ln S of the trial for the mean of the person's other trials"}}},
      {"residuals.csv",
       "condition subject session run trial",
       {{"time_s", "Time of the sample since arming"},
        {"phase", "The same from 0 at the onset to 1 at the end of the person's own mean movement, laid over the trial"},
        {"weight", "Weight of the squared residual in S, inverse of the squared scatter of the person's own trials at that phase"},
        {"velocity_m_per_s", "Hand's velocity along the path, filtered"},
        {"residual_*", "Velocity less the fit of the candidate that the column names; empty where it was not compared"}}},
      {"conclusions.csv",
       "",
       {{"condition", "Condition; all: every condition together"},
        {"unit", "What the test is over: subjects, or one subject's trials"},
        {"criterion", "Candidate: an optimality criterion, or reference"},
        {"score", "Mean over people of their score; lower is nearer"},
        {"score_above_best", "Its difference to the best candidate's"},
        {"score_above_best_low", "Lower end of the 95 % t interval of that difference, over the unit; empty for the best"},
        {"score_above_best_high", "Upper end of that interval"},
        {"p", "Two-sided p of that difference; empty for the best"},
        {"bayes_factor",
         "Evidence for a difference over evidence for none: JZS Bayes factor of that test with scale 0.707; empty for the best"},
        {"closest_subjects", "Subjects whose own score of this candidate is the least"},
        {"closest_percent", "Share of these subjects among all that were judged"},
        {"closest_low_percent", "Lower end of Clopper and Pearson's exact 95 % interval of that share"},
        {"closest_high_percent", "Upper end of that interval"},
        {"decided_subjects", "Subjects whose own movements, judged alone, are decided for this candidate"},
        {"posterior", "Protected exceedance probability: that it is the most frequent among people; empty for one subject"},
        {"best", "yes for the candidate that is closest"},
        {"decided", "1: the movements follow it, by the rule of docs/analysis.md"},
        {"reason", "Why nothing is decided; empty where it is"},
        {"level", "Level that p is held against"},
        {"mass_at_edge", "1: the hand's mass is at the edge of its range, and a mass outside it might be nearer than the best"},
        {"misfit", "Of the best candidate: score less that of the mean of the person's other trials; mean over people"},
        {"misfit_p", "Two-sided p of misfit; with misfit of 0.05 or more and p below 0.05 the candidate does not fit"},
        {"systematic_share",
         "Of the best candidate: part of the mean squared residual that returns in every trial or grows with the duration"},
        {"systematic_p",
         "Chance of so large a part if the candidate is right; with a share of 0.05 or more and p below 0.01 it does not fit"},
        {"toward", "Of the best candidate: the other candidate towards which the movements go most surely"},
        {"toward_share", "How far they go: 0 at the best candidate, 1 at the other, 0.5 for the mean of both"},
        {"toward_share_low", "Lower end of the 95 % t interval of that share, over the unit"},
        {"toward_share_high", "Upper end of that interval"},
        {"toward_p",
         "One-sided p of that share, corrected for the number of other candidates; with 0.125 or more and p below 0.01 it does not fit"},
        {"subjects", "Subjects that were judged"},
        {"trials", "Trials that were judged"}}},
      {"alternative_scores.csv", "", {{"choice", kChoice}, {kConclusions}}},
      {"exclusions.csv",
       "condition subject",
       {{"rule", "Why trials are in no profile, error and fit; used: they are in them"},
        {"trials", "Number of this subject's trials in this condition to which the rule applied"}}},
      {"success_table.csv",
       "subject day condition successes",
       {{"trials", "Attempts: successes and failures; aborted and interrupted trials are none"},
        {"success_percent"},
        {"low_percent"},
        {"high_percent"}}},
      {"learning.csv",
       "subject session condition",
       {{"first_trial", "First attempt of the group, counted through all the subject's sessions, from 1"},
        {"last_trial", "Last attempt of the group, counted likewise"},
        {"successes"},
        {"trials", "Attempts of the group"},
        {"success_percent"},
        {"low_percent"},
        {"high_percent"}}},
      {"adaptation.csv",
       "subject session",
       {{"block", "Block of the plan, or all, as the session is then: every trial of the subject in order"},
        {"unit", "field: response and perturbation as shares of the trained field; deg: as angles of the cursor's rotation"},
        {"trials", "Trials with a movement"},
        {"channel_trials", "Trials of them in a channel, which clamps the error to zero"},
        {"responses", "Trials of them with a measured response: adaptation_percent / 100, or -hand_angle_deg"},
        {"states", "Number of states by BIC: one, two, or undecided (less than 6 apart)"},
        {"a_f", "Retention of the fast state from trial to trial (Smith et al. 2006)"},
        {"a_f_low", "Lower end of its 95 % interval, by bootstrap over blocks of residuals"},
        {"a_f_high", "Upper end"},
        {"b_f", "Learning rate of the fast state"},
        {"b_f_low", "Lower end of its 95 % interval"},
        {"b_f_high", "Upper end"},
        {"a_s", "Retention of the slow state"},
        {"a_s_low", "Lower end of its 95 % interval"},
        {"a_s_high", "Upper end"},
        {"b_s", "Learning rate of the slow state"},
        {"b_s_low", "Lower end of its 95 % interval"},
        {"b_s_high", "Upper end"},
        {"rmse_two_states", "Root mean square residual with two states, in the unit"},
        {"a", "Retention of a single state"},
        {"a_low", "Lower end of its 95 % interval"},
        {"a_high", "Upper end"},
        {"b", "Learning rate of a single state"},
        {"b_low", "Lower end of its 95 % interval"},
        {"b_high", "Upper end"},
        {"rmse_one_state", "Root mean square residual with one state, in the unit"},
        {"plateau_percent",
         "Share of the field or rotation that is cancelled in the last quarter of the training: channel trials, or rotated ones; in rows of all "
         "blocks"},
        {"first_deviation_m", "Largest deviation to the right in the first five trials in the field, less that before the training"},
        {"last_deviation_m", "The same in the last quarter of the training"},
        {"after_effect_m", "The same in the first five trials without a field after the training, else in those of its last quarter"},
        {"first_deviation_deg", "Hand angle in the first five rotated trials, less that before the training"},
        {"last_deviation_deg", "The same in the last quarter of the training"},
        {"after_effect_deg", "The same in the first five trials without a rotation after the training, else in those of its last quarter"},
        {"remark", "Why nothing is fitted; empty where it is"}}},
      {"effects.csv",
       "",
       {{"effect",
         "day: a later day less the last day before it that has the condition; condition: one less another; slope: of success against trial number"},
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
        {"p", "Two-sided p; of days and of conditions by the logits, corrected by Holm's method"}}},
      {"conditions.csv",
       "condition experiment",
       {{"task_duration_s", "Duration that the task asks for"},
        {"success", "Number of successes"},
        {"failure", "Number of failures"},
        {"aborted", "Number of aborted trials"},
        {"interrupted", "Number of interrupted trials"},
        {"invalid_timing", "Those of them in which more ticks were missed than allowed"},
        {"practice", "Number of practice trials, left out unless they were asked for"},
        {"catch", "Number of catch trials, always left out"},
        {"before_go", "Trials in which the hand left before the go signal"},
        {"other_way", "Trials that went round a closed curve the other way"},
        {"used", "Number of trials in profiles and errors"},
        {"used_outcome", "Outcome of the used trials: success, or failure where none succeeded"},
        {"mean_duration_s"},
        {"sd_duration_s"},
        {"mean_movement_time_s"},
        {"sd_movement_time_s"},
        {"least_movement_time_s", "Least movement time of the used trials"},
        {"largest_movement_time_s", "Largest movement time of the used trials"},
        {"onset_rule", "Rule for onset and offset: percent, absolute or task"},
        {"onset_percent", "Share of the trial's peak speed, for the rule percent"},
        {"onset_speed_m_per_s", "Speed, for the rule absolute"},
        {"cutoff_hz", "Cut-off of the low-pass on the hand's velocity; 0: none"},
        {"hand_mass_kg", "Mass of the hand in the predictions of the paper's epsilon"},
        {"hand_masses_tried_kg", "Masses of the hand between which the fits search, with ; between; one: it was given"},
        {"hand_damping_n_s_per_m", "Damping of the hand in the predictions"},
        {"prediction_duration",
         "Duration of the predictions: task, the task's T; mean, the T whose movement lasts as long as the used trials"},
        {"practice_included", "1: practice blocks count too"},
        {"learning_bin", "Trials in a point of learning.csv"}}},
      {"hands.csv",
       "subject session run trial condition",
       {{"phase", "Whether the block counts: practice or recorded"},
        {"catch_trial", "1: no go signal was given, and the movement was the failure"},
        {"excluded", "Why a person excluded the trial; empty where nobody did"},
        {"outcome", "How the trial was judged: success, failure, aborted or interrupted"},
        {"hand", "Number of the hand, from 1, in the order of the experiment's hands"},
        {"device", "Device of this hand, as it names itself"},
        {"sampled_peak_speed_m_per_s", "Largest estimated speed of this hand over the recorded samples of the movement"},
        {"path_m", "Length of this hand's path over the recorded samples of the movement"},
        {"sampled_peak_force_n", "Largest coupling force of this hand over the recorded samples of the movement"},
        {"sampled_mean_force_n", "Mean coupling force of this hand over the recorded samples of the movement"},
        {"work_j", "Work of this hand on the object from arming to the trial's end; the sum over hands is what the object gained and lost"},
        {"positive_work_j", "Work that this hand put in during the movement, without what it took out"},
        {"share_of_positive_work", "This hand's share of the positive work of all hands; empty where no hand put any in"},
        {"lag_s",
         "Time that this hand's speed is behind the first hand's: the largest correlation within 0.5 s; empty where a speed is constant"},
        {"lag_correlation", "That largest correlation"},
        {"internal_force_rms_n",
         "RMS over samples of the force that cancels between hands: half of the sum of sizes less the size of the sum"},
        {"internal_force_peak_n", "Largest of that force"}}},
      {"alternatives.csv",
       "",
       {{"choice", kChoice},
        {"condition", "Condition; all: every condition together"},
        {"criterion", "Criterion that the movements follow by this analysis; empty where none is named"},
        {"reason", "Why none is named; empty where one is"},
        {"best", "Candidate that is closest; empty where nothing could be compared"},
        {"p", "Two-sided p of its least certain comparison with another candidate"},
        {"changed", "1: another criterion is named than in the analysis as asked, or none in place of one, or one in place of none"}}},
      {"recovery.csv",
       "",
       {{"truth",
         "Candidate by which the simulated subjects planned, or reference. Other truths by a candidate: other-hand-masses, with a mass drawn from the "
         "range; own-skew and own-warp, ahead of the plan or behind it by 2 to 10 % of the duration, in the whole movement or in each half. Truths that "
         "are no candidate: mean-of-two and two-in-turn, of two candidates; hand-snap, a minimum snap of the hand; two-submovements"},
        {"named", "What the rule named: a candidate, or undecided; of other truths right, wrong or undecided"},
        {"studies", "Simulated studies of this truth that were named so"}}}};
  return kTables;
}

record::ColumnMeaning shared(std::string_view name) {
  const auto known = std::find_if(std::begin(kShared), std::end(kShared), [&](const auto& column) { return column.column == name; });
  return known != std::end(kShared) ? *known : record::ColumnMeaning{name};
}

std::map<std::string_view, Columns> columnsOfTables() {
  std::map<std::string_view, Columns> all;
  for (const Table& table : tables()) {
    Columns& columns = all[table.file];
    for (std::string_view rest = table.shared; !rest.empty();) {
      const std::size_t end = std::min(rest.find(' '), rest.size());
      columns.push_back(shared(rest.substr(0, end)));
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    for (const record::ColumnMeaning& own : table.own) {
      if (own.column == kMeasures) {
        for (const Measure& measure : measures()) columns.push_back({measure.name, measure.sentence});
      } else if (own.column == kConclusions) {
        columns.insert(columns.end(), all.at("conclusions.csv").begin(), all.at("conclusions.csv").end());
      } else {
        columns.push_back(own.meaning.empty() ? shared(own.column) : own);
      }
    }
  }
  return all;
}

}  // namespace

std::span<const record::ColumnMeaning> tableColumns(std::string_view file) {
  static const std::map<std::string_view, Columns> kAll = columnsOfTables();
  const auto found = kAll.find(file);
  if (found == kAll.end()) return {};
  return found->second;
}

}  // namespace reachlab::analysis
