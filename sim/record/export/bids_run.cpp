#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "base/table_text.h"
#include "base/ticks.h"
#include "sim/record/export/bids.h"
#include "sim/record/export/run_tables.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/export/trial_row.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::record {
namespace {

using Json = nlohmann::ordered_json;

std::string orUnknown(const std::string& text) { return text.empty() ? "n/a" : text; }

// The dataset's clock is the tick; rows lie a sampling period apart wherever nothing was dropped.
struct RowSpan {
  std::uint64_t first = 0, last = 0;  // ticks
  std::size_t rows = 0;
  double seconds() const { return secondsBetween(first, last); }
  double frequency(double nominal) const { return seconds() > 0 ? static_cast<double>(rows - 1) / seconds() : nominal; }
};

RowSpan spanOf(const RunLog& run) {
  RowSpan span;
  run.eachBlock([&](const SampleRows& block) {
    if (block.size() == 0) return;
    if (span.rows == 0) span.first = block.ticks.front();
    span.last = block.ticks.back();
    span.rows += block.size();
  });
  return span;
}

bool isSpatial(const Channel& channel) { return channel.component != "n/a"; }

std::string systemName(int hand) { return hand == 1 ? "haptic" : fmt::format("haptic{}", hand); }

std::vector<Channel> channelsOf(const ChannelTable& table, int hand) {
  std::vector<Channel> channels;
  for (const std::size_t column : columnsOf(table, hand)) channels.push_back(table.channels[column]);
  return channels;
}

Json described(const std::string& description, const std::string& units = "") {
  Json entry{{"Description", description}};
  if (!units.empty()) entry["Units"] = units;
  return entry;
}

/// A column of events.tsv, and the one of trials.csv that has its cells. Those before them are made in eventsTsv.
struct EventColumn {
  std::string_view name, ofTrials, description, unit = {};
};
constexpr EventColumn kEventColumns[] = {
    {"trial", "trial", "Trial number within the block, from 1"},
    {"block", "block", "Block of the session's plan, from 1"},
    {"phase", "phase", "Whether the block counts"},
    {"condition", "condition",
     "Kind and target of the trial where its block has several, else condition of the plan, else the experiment's name"},
    {"outcome", "outcome", "How the trial ended"},
    {"reason", "reason", "Which tolerance was missed or what stopped the trial"},
    {"mass", "mass", "Mass that missed the tolerance, from 1; 0: none"},
    {"by", "by", "Excess over the tolerance: m for position, m/s for velocity, s for time_short"},
    {"movement_time", "movement_time_s", "From movement onset to the end of the trial", "s"},
    {"reaction_time", "task_reaction_time_s", "From the go signal to movement onset", "s"},
    {"go", "go_s", "Go signal, since the first sample of the recording", "s"},
    {"foreperiod", "foreperiod_s", "Planned time from arming to the go signal", "s"},
    {"peak_hand_speed", "peak_hand_speed_m_per_s", "Largest estimated speed of the hand, every tick, unfiltered", "m/s"},
    {"hand_path", "hand_path_m", "Length of the hand's path during the movement", "m"},
    {"peak_force", "peak_force_n", "Largest coupling force", "N"},
    {"missed_ticks", "missed_ticks", "Ticks of 1 ms that were skipped in the trial"},
    {"armed", "armed_s", "When the hand was at the start and the trial could begin, since the first sample of the recording", "s"},
    {"mean_force", "mean_force_n", "Mean coupling force over every tick of the movement", "N"},
    {"day", "day", "Day of the session's plan; 0: the plan gives none"},
    {"dropped_samples", "dropped_samples", "Ticks of 1 ms that were simulated but not recorded, because the disk was too slow"},
    {"elapsed_s", "elapsed_s", "From the go signal to the end of the trial by the computer's clock", "s"},
    {"channel_broken", "channel_broken", "1: the hand left the walls of a channel, which let go; 0: it did not"},
    {"kind", "kind", "Kind of the trial in the session's plan; n/a: the block has no kinds"},
    {"target", "target",
     "Target of the trial in the session's plan, from 1, such as 3, and 3-back on the way back from it; n/a: the block has one scene"},
};

}  // namespace

// No header: the columns are those of channels.tsv.
void motionTsv(const RunLog& run, const TakePiece& take, int hand) {
  writeRows(run, columnsOf(run.configuration().table, hand), TableText('\t', "n/a"), take);
}

// Every system has its time; a further hand's columns begin with its name.
std::vector<std::size_t> columnsOf(const ChannelTable& table, int hand) {
  const auto whose = [&](const Channel& channel) {
    for (int other = 2; other <= table.hands; ++other)
      if (channel.name.starts_with(fmt::format("hand{}_", other)) || channel.name.starts_with(fmt::format("device{}_", other)))
        return other;
    return 1;
  };
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < table.size(); ++i)
    if (table.channels[i].type == "LATENCY" || whose(table.channels[i]) == hand) columns.push_back(i);
  return columns;
}

std::string motionJson(const RunLog& run, int hand) {
  const RunConfiguration& c = run.configuration();
  const RowSpan span = spanOf(run);
  const std::vector<Channel> channels = channelsOf(c.table, hand);
  const auto count = [&](const std::string& type) {
    return std::count_if(channels.begin(), channels.end(), [&](const Channel& channel) { return channel.type == type; });
  };
  std::set<std::string> points;
  for (const Channel& channel : channels)
    if (channel.trackedPoint != "n/a") points.insert(channel.trackedPoint);
  Json j = Json::object();
  j["TaskName"] = c.task;
  j["TaskDescription"] = describeTask(c);
  j["Instructions"] = "Move the object to the target in the prescribed time and bring it to rest there";
  j["SamplingFrequency"] = c.samplingHz;
  j["SamplingFrequencyEffective"] = span.frequency(c.samplingHz);
  j["RecordingDuration"] = span.seconds();
  j["TrackingSystemName"] = systemName(hand);
  j["Manufacturer"] = "n/a";
  j["ManufacturersModelName"] = orUnknown(devicesOf(c).at(static_cast<std::size_t>(hand - 1)).name);
  j["DeviceSerialNumber"] = "n/a";
  j["SoftwareVersions"] = orUnknown(c.softwareVersion);
  j["InstitutionName"] = "n/a";
  j["InstitutionAddress"] = "n/a";
  j["InstitutionalDepartmentName"] = "n/a";
  j["MotionChannelCount"] = channels.size();
  for (const char* type : {"POS", "VEL", "ACCEL", "ANGACCEL", "GYRO", "JNTANG", "MAGN", "ORNT", "LATENCY", "MISC"})
    j[std::string(type) + "ChannelCount"] = count(type);
  j["TrackedPointsCount"] = points.size();
  j["MissingValues"] = "n/a";
  j["SubjectArtefactDescription"] = "n/a";
  return j.dump(2) + "\n";
}

std::string channelsTsv(const RunConfiguration& c, int hand) {
  TableText table('\t', "n/a");
  table.row({"name", "component", "type", "tracked_point", "units", "placement", "reference_frame", "description"});
  for (const Channel& channel : channelsOf(c.table, hand)) {
    const std::string frame = isSpatial(channel) ? "world" : "n/a";
    table.row({channel.name, channel.component, channel.type, channel.trackedPoint, channel.units, "n/a", frame, channel.description});
  }
  return table.text();
}

std::string channelsJson() {
  Json world = Json::object();
  world["Description"] = "Fixed frame of the scene, right-handed: x to the subject's right, y up, z towards the subject";
  world["SpatialAxes"] = "RSP";
  world["RotationOrder"] = "ZXY";
  world["RotationRule"] = "right-hand";
  Json j = Json::object();
  j["reference_frame"] = {{"Description", "Reference frame of the channel"}, {"Levels", {{"world", world}}}};
  return j.dump(2) + "\n";
}

void eventsTsv(const RunLog& run, const TakePiece& take) {
  const std::vector<std::string>& names = trialColumnNames();
  const auto columnOf = [&](std::string_view name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  const std::size_t start = columnOf("start_s"), taskOnset = columnOf("task_onset_s"), end = columnOf("end_s"),
                    isCatch = columnOf("catch_trial");
  TableText table('\t', "n/a");
  table.cell("onset").cell("duration").cell("trial_type");
  for (const EventColumn& column : kEventColumns) table.cell(column.name);
  table.endRow();
  eachTrial(run, [&](std::span<const TrialCell> cells) {
    const auto number = [&](std::size_t column) { return std::get<double>(cells[column]); };
    const double onset = std::isfinite(number(taskOnset)) ? number(taskOnset) : number(start);
    std::vector<TrialCell> row{onset, std::max(0.0, number(end) - onset), std::string(number(isCatch) != 0 ? "catch" : "reach")};
    for (const EventColumn& column : kEventColumns) row.push_back(cells[columnOf(column.ofTrials)]);
    addTrial(table, row);
    take(table.takeText());
  });
  take(table.takeText());
}

std::string eventsJson(const RunLog& run) {
  const RunConfiguration& c = run.configuration();
  Json j = Json::object();
  j["onset"] = described("Since the first sample of the recording, as the channel latency counts. " + clockStatement(run), "s");
  j["trial_type"] = described("Kind of trial");
  j["trial_type"]["Levels"] = {{"reach", "Rest-to-rest reach; onset is the start of the movement, duration ends with the trial"},
                               {"catch", "Trial without a go signal: the hand should stay"}};
  for (const EventColumn& column : kEventColumns)
    j[std::string(column.name)] = described(std::string(column.description), std::string(column.unit));
  j["phase"]["Levels"] = {{"practice", "Familiarisation"}, {"recorded", "Counted in the analysis"}};
  j["outcome"]["Levels"] = {
      {"success", "Every mass within all tolerances"},
      {"failure", "A tolerance was missed"},
      {"aborted", "Stopped by the experimenter, or no movement"},
      {"interrupted", "Cut off by a stop of the program, a lost device or a computer too busy to keep time; counts for nothing"}};
  j["StimulusPresentation"] = {{"SoftwareName", "reachlab"}, {"SoftwareVersion", orUnknown(c.softwareVersion)}};
  return j.dump(2) + "\n";
}

std::string motionPath(const RunConfiguration& configuration, int hand) {
  return "motion/" + runName(configuration, fmt::format("tracksys-{}_", systemName(hand)));
}

std::vector<std::string> writeBidsRun(const RunLog& run, const std::string& folder) {
  const RunConfiguration& c = run.configuration();
  const std::string session = fmt::format("{}/sub-{}/ses-{}", folder, c.subject, c.session);
  std::vector<std::string> written;
  const auto writePieces = [&](const std::string& path, const auto& writer) {
    AtomicFile file(path);
    writer([&](std::string_view piece) { file.append(piece); });
    file.commit();
    written.push_back(path);
  };
  const auto write = [&](const std::string& path, const std::string& text) {
    writePieces(path, [&](const TakePiece& take) { take(text); });
  };
  const auto baseOf = [&](int hand) { return session + "/" + motionPath(c, hand); };
  for (int hand = 1; hand <= c.table.hands; ++hand) {
    const std::string system = baseOf(hand);
    writePieces(system + "_motion.tsv", [&](const TakePiece& take) { motionTsv(run, take, hand); });
    write(system + "_motion.json", motionJson(run, hand));
    write(system + "_channels.tsv", channelsTsv(c, hand));
    write(system + "_channels.json", channelsJson());
  }
  const std::string base = baseOf(1);
  writePieces(base + "_events.tsv", [&](const TakePiece& take) { eventsTsv(run, take); });
  write(base + "_events.json", eventsJson(run));
  write(folder + "/" + experimentPath(c), experimentJson(c));
  return written;
}

}  // namespace reachlab::record
