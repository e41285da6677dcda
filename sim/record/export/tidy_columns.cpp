#include "sim/record/export/column_dictionary.h"
#include "sim/record/export/run_tables.h"
#include "sim/record/export/tidy_csv.h"

namespace reachlab::record {
namespace {

constexpr ColumnMeaning kTrialMeanings[] = {
    {"subject", "Subject's label, letters and digits; read it as text: 01 is not 1"},
    {"session", "Session's label, letters and digits; read it as text: 01 is not 1"},
    {"run", "Run number within the session, as in the file names"},
    {"block", "Block of the session's plan, from 1"},
    {"trial", "Trial number within the block, from 1"},
    {"phase",
     "Whether the block counts: practice or recorded. In the samples files a column of this name is the trial's own phase, a number"},
    {"condition", "Condition of the plan, else the experiment's name"},
    {"outcome", "How the trial ended: success, failure, aborted or interrupted"},
    {"reason", "Which tolerance was missed, or what stopped the trial; empty for a success"},
    {"mass", "Mass that missed the tolerance, from 1; 0: none"},
    {"movement_time_s", "From movement onset to the end of the trial"},
    {"by", "Excess over the tolerance that was missed, in the unit of by_unit"},
    {"by_unit", "Unit of by: m, m/s or s; empty where there is no excess"},
    {"experiment", "Name of the experiment"},
    {"day", "Day of the plan; 0: the plan has none"},
    {"order_index", "Place of the trial in the planned order, from 0"},
    {"catch_trial", "1: no go signal was given, the hand should stay; 0: a reach"},
    {"foreperiod_s", "Planned time from arming to the go signal"},
    {"target_time_s", "Duration that the task asks for"},
    {"position_tolerance_m", "Tolerance of every mass's position at the target"},
    {"velocity_tolerance_m_per_s", "Tolerance of every mass's speed at the target"},
    {"time_tolerance_s", "Tolerance of the duration"},
    {"start_s", "Start of the trial, since the run began"},
    {"armed_s", "When the hand was in place, since the run began"},
    {"go_s", "Go signal, since the run began"},
    {"onset_s", "Movement onset, since the run began"},
    {"end_s", "End of the movement, since the run began"},
    {"reaction_time_s", "From the go signal to movement onset"},
    {"peak_hand_speed_m_per_s", "Largest estimated speed of the hand over every tick of the movement, unfiltered"},
    {"hand_path_m", "Length of the hand's path over every tick of the movement, unfiltered"},
    {"peak_force_n", "Largest coupling force over every tick of the movement"},
    {"mean_force_n", "Mean coupling force over every tick of the movement"},
    {"clamped_ticks", "Ticks of 1 ms in which the force was held to the device's limit"},
    {"missed_ticks", "Ticks of 1 ms that were skipped"},
    {"dropped_samples", "Ticks that were simulated but not recorded, because the disk was too slow"},
    {"elapsed_s", "From the go signal to the end by the computer's clock; longer than the ticks say when ticks were missed"},
    {"complete", "0: the log broke off in this trial"},
    {"seed", "Seed of the block; up to 64 bits, read it as text or as an integer, not as a floating-point number"},
    {"device", "Device as it was asked for"},
    {"age_years", "Participant's age"},
    {"sex", "Participant's sex: F, M or O"},
    {"handedness", "Participant's handedness: R, L or A"},
    {"notes", "Notes by the experimenter"}};

}  // namespace

std::string trialsDictionary(std::string_view csv) { return columnDictionary(csv, kTrialMeanings); }

std::string samplesDictionary(const RunConfiguration& configuration, std::string_view csv) {
  const std::string clock = clockStatement(configuration);
  std::vector<ColumnMeaning> meanings{
      {"phase",
       "Phase of the trial at this sample: 0 idle, 1 waiting, 2 armed, 3 moving, 4 done. In trials.csv a column of this name says whether "
       "the block is practice or recorded"}};
  for (const Channel& channel : configuration.table.channels)
    meanings.push_back({channel.column, channel.type == "LATENCY" ? std::string_view(clock) : std::string_view(channel.description)});
  return columnDictionary(csv, meanings);
}

}  // namespace reachlab::record
