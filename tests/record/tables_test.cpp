// What a run is as tables and files for other programs, number by number. (Other programs' readers: export_readers.py.)
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/csv_table.h"
#include "base/table_text.h"
#include "sim/experiment/describe.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/bids.h"
#include "sim/record/export/c3d_export.h"
#include "sim/record/export/column_dictionary.h"
#include "sim/record/export/exporters.h"
#include "sim/record/export/hdf5_file.h"
#include "sim/record/export/matlab_file.h"
#include "sim/record/export/run_tables.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/export/trial_row.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/whole_file.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

using nlohmann::json;

class Tables : public testing::Test {
 protected:
  // A run of three trials, of which the second is a failure.
  RunLog recorded(int trials = 3) {
    const std::string path = folder_ / "a_log.reach";
    writeMadeRun(path, trials, configuration_);
    return RunLog::open(path);
  }
  template <typename Edit>
  RunLog recordedTicks(std::uint64_t end, const Edit& edit) {
    MadeRecording recording(folder_ / "ticks_log.reach", configuration_);
    recording.until(end, edit);
    return recording.closed();
  }
  TemporaryFolder folder_;
  RunConfiguration configuration_ = madeConfiguration();
};

const auto firstHandMotion = [](const RunLog& run, const TakePiece& take) { motionTsv(run, take); };

std::map<std::string, std::string> rowOf(const TsvTable& table, std::size_t row) {
  std::map<std::string, std::string> cells;
  for (std::size_t i = 0; i < table.columns.size(); ++i) cells[table.columns[i]] = table.rows.at(row).at(i);
  return cells;
}

TEST_F(Tables, TimesAreSinceTheFirstRowAndNotTheFirstTick) {
  configuration_.sampleEveryTicks = 10;
  const auto present = [](const haptics::TickState& state) { return state.tick >= 7; };  // and the first row is of the 10th
  const std::vector<RunLog> runs{recordedTicks(MadeRun::kTicksPerTrial, present)};
  std::map<std::string, std::string> row = rowOf(parseTsv(textOf(eventsTsv, runs.front())), 0);
  EXPECT_EQ(row["onset"], "0.04") << "50 ticks less 10";
  EXPECT_EQ(row["go"], "0.01");
  EXPECT_EQ(row["armed"], "0.01");
  // Every export has this one clock.
  const ColumnTable trials = trialTable(runs.front());
  const auto column = [&](const char* name) {
    return std::find_if(trials.columns().begin(), trials.columns().end(), [&](const auto& c) { return c.name == name; })->numbers.at(0);
  };
  EXPECT_EQ(column("task_onset_s"), 0.04);
  EXPECT_EQ(column("go_s"), 0.01);
  const std::string motion = textOf(firstHandMotion, runs.front()), samples = textOf(samplesCsv, runs.front());
  EXPECT_TRUE(motion.starts_with("0\t")) << motion.substr(0, 40);
  EXPECT_TRUE(samples.substr(samples.find('\n') + 1).starts_with("0,")) << samples.substr(samples.find('\n'), 40);
  EXPECT_TRUE(holds(clockStatement(runs.front()), "first sample, which is 0.01 s after it began"));
}

TEST_F(Tables, ATrialWithoutAMovementIsPlacedWhereItStarted) {
  MadeRecording recording(folder_ / "still_log.reach", configuration_);
  recording.recorder.announce(1, {0, 0, true});
  recording.until(101, [](haptics::TickState& state) {
    state.phase = state.tick < 30 ? trial::Phase::Idle : state.tick < 100 ? trial::Phase::Waiting : trial::Phase::Done;
    state.result = {};
    state.result.outcome = trial::Outcome::Aborted;
    return true;
  });
  std::map<std::string, std::string> row = rowOf(parseTsv(textOf(eventsTsv, recording.closed())), 0);
  EXPECT_EQ(row["onset"], "0.03");
  EXPECT_EQ(row["duration"], "0.07");
  EXPECT_EQ(row["trial_type"], "catch");
  for (const char* never : {"movement_time", "reaction_time", "go", "armed", "elapsed_s"}) EXPECT_EQ(row[never], "n/a") << never;
}

TEST_F(Tables, TheMotionFileTellsItsLengthAndItsEffectiveRate) {
  const json all = json::parse(motionJson(recorded()));
  EXPECT_EQ(all["SamplingFrequency"], 100);
  EXPECT_EQ(all["RecordingDuration"], 0.82);
  EXPECT_DOUBLE_EQ(all["SamplingFrequencyEffective"].get<double>(), 100);
  const auto present = [](const haptics::TickState& state) { return state.tick < 100 || state.tick >= 150; };
  const json gap = json::parse(motionJson(recordedTicks(275, present)));
  EXPECT_EQ(gap["RecordingDuration"], 0.27);
  EXPECT_DOUBLE_EQ(gap["SamplingFrequencyEffective"].get<double>(), 22 / 0.27) << "23 rows, of which 5 are lost";
  configuration_.samplingHz = 50;
  writeMadeRun(folder_ / "none_log.reach", 0, configuration_);
  const json none = json::parse(motionJson(RunLog::open(folder_ / "none_log.reach")));
  EXPECT_EQ(none["RecordingDuration"], 0);
  EXPECT_EQ(none["SamplingFrequencyEffective"], 50) << "of a run of no rows, the one that was asked for";
}

TEST_F(Tables, TheDatasetsTablesTellPeopleSessionsAndWhenTheyWereRecorded) {
  RunConfiguration a = configuration_, b = configuration_, c = configuration_;
  a.participant = {31.5, "F", ""};
  b.run = 2, b.startedUtc = "2026-11-20T11:00:00.000";
  c.subject = "07", c.session = "03", c.startedUtc = "";
  const std::string out = folder_ / "data";
  EXPECT_TRUE(writeBidsTables({}, out).empty());
  EXPECT_EQ(writeBidsTables({a, b, c}, out).size(), 3u + 1 + 2 + 2);
  EXPECT_EQ(readWholeFile(out + "/participants.tsv"),
            "participant_id\tage\tsex\thandedness\nsub-01\t31.5\tF\tn/a\nsub-07\tn/a\tn/a\tn/a\n");
  EXPECT_EQ(readWholeFile(out + "/sub-01/sub-01_sessions.tsv"), "session_id\tacq_time\nses-01\t2026-11-20T10:00:00.000\n")
      << "of its first run, without a zone";
  EXPECT_EQ(readWholeFile(out + "/sub-07/sub-07_sessions.tsv"), "session_id\tacq_time\nses-03\tn/a\n");
  EXPECT_EQ(readWholeFile(out + "/sub-01/ses-01/sub-01_ses-01_scans.tsv"),
            "filename\tacq_time\nmotion/sub-01_ses-01_task-made_tracksys-haptic_run-01_motion.tsv\t2026-11-20T10:00:00.000\n"
            "motion/sub-01_ses-01_task-made_tracksys-haptic_run-02_motion.tsv\t2026-11-20T11:00:00.000\n");
  c.table.hands = 2;
  writeBidsTables({c}, out);
  EXPECT_NE(readWholeFile(out + "/sub-07/ses-03/sub-07_ses-03_scans.tsv").find("tracksys-haptic2_run-01_motion.tsv"), std::string::npos);
  EXPECT_EQ(writeBidsTables({a}, out).size(), 3u) << "what describes the dataset is written once";
}

TEST_F(Tables, AnExperimentThatNobodyUnderstandsIsKeptAsItIs) {
  configuration_.experimentText = "no experiment";
  configuration_.experimentName = "odd";
  const json j = json::parse(experimentJson(configuration_));
  EXPECT_TRUE(j["experiment"].is_null());
  EXPECT_TRUE(j["definition"].is_null());
  EXPECT_EQ(j["description"], "Rest-to-rest reaching with the simulated object of experiment odd");
  EXPECT_EQ(experimentNameIn(j["description"]), "odd");
  EXPECT_EQ(experimentNameIn("something else"), "");
  EXPECT_TRUE(j["run"]["device_name"].is_null());
  configuration_.experimentText = "{\"of\": \"a later version\"} // with a comment";
  EXPECT_EQ(json::parse(experimentJson(configuration_))["experiment"], (json{{"of", "a later version"}}));
}

TEST_F(Tables, WhereADeviceIsLostOrAPlaceIsNoNumberAPointIsNotSeen) {
  configuration_.sampleEveryTicks = 5;
  const RunLog run = recordedTicks(275, [](haptics::TickState& state) {
    state.hands[0].device.valid = state.tick != 20;
    if (state.tick == 30) state.masses[1].r.z = std::nan("");
    if (state.tick == 35) state.masses[1].r = {0.125, -0.25, 2};
    return state.tick < 40 || state.tick >= 50;
  });
  const C3dFile file = c3dOf(run, run.trials()[0]);
  ASSERT_EQ(file.frames, 51u);
  const auto seen = [&](std::size_t frame) {
    return std::string(file.seen.begin() + 4 * static_cast<int>(frame), file.seen.begin() + 4 * static_cast<int>(frame) + 4);
  };
  EXPECT_EQ(seen(3), "\1\1\1\1");
  EXPECT_EQ(seen(4), std::string("\0\0\1\1", 4)) << "hand and device; the masses are simulated";
  EXPECT_EQ(seen(6), std::string("\1\1\1\0", 4));
  const float* place = &file.places[(7 * 4 + 3) * 3];
  EXPECT_EQ(std::vector(place, place + 3), (std::vector<float>{125, -250, 2000})) << "in " << file.pointUnit;
  for (const std::size_t frame : {8, 9}) {
    EXPECT_EQ(seen(frame), std::string(4, '\0')) << "dropped: the frames keep their times";
    EXPECT_TRUE(std::isnan(file.signals[frame * file.analogs.size()]));
  }
  EXPECT_EQ(seen(10), "\1\1\1\1");
  EXPECT_EQ(writeC3d({}, folder_ / "").size(), 0u);
}

TEST_F(Tables, ATrialBetweenTwoRowsHasNoC3dFile) {
  const std::vector<RunLog> runs{recordedTicks(40, [](haptics::TickState& state) {
    state.trial = state.tick < 11 ? 0 : state.tick < 18 ? 1 : 2;
    state.phase = state.trial == 0 ? trial::Phase::Idle : state.tick % 10 == 7 ? trial::Phase::Done : trial::Phase::Waiting;
    return true;
  })};
  ASSERT_EQ(runs[0].trials().size(), 2u);
  EXPECT_EQ(c3dOf(runs[0], runs[0].trials()[0]).frames, 0u) << "ticks 11 to 17";
  EXPECT_EQ(writeC3d(runs, folder_ / "c3d").size(), 1u);
}

// Whatever is in memory at a time, every column comes once, in order and whole.
TEST_F(Tables, ColumnsAreTheSameHoweverFewAreReadAtATime) {
  const RunLog run = recorded();
  const SampleRows rows = run.allRows();
  const ExportClock clock(run);
  for (const std::size_t most : {std::size_t{0}, std::size_t{1}, rows.size() * 7 - 1, rows.size() * 7, std::size_t{1} << 22}) {
    std::size_t next = 0;
    eachSampleColumn(
        run,
        [&](std::size_t channel, std::span<const double> values) {
          ASSERT_EQ(channel, next++);
          ASSERT_EQ(values.size(), rows.size());
          for (std::size_t row = 0; row < rows.size(); ++row) ASSERT_EQ(values[row], clock.cell(rows, row, channel));
        },
        most);
    EXPECT_EQ(next, run.configuration().table.size()) << most;
  }
}

TEST_F(Tables, WhatAnUnreadableExperimentAskedForIsNotKnown) {
  configuration_.experimentText = "no experiment";
  const experiment::Task task = taskOf(configuration_, {});
  for (const double unknown : {task.duration, task.tolerance.position, task.tolerance.velocity, task.tolerance.time})
    EXPECT_TRUE(std::isnan(unknown));
}

TEST_F(Tables, MotionCellsReadBackAsTheRecordedNumbers) {
  const TsvTable motion = parseTsv(textOf(firstHandMotion, recorded()));  // without a header: its first row is taken for one
  const std::size_t x = configuration_.table.indexOf("hand_pos_x");
  ASSERT_FALSE(motion.rows.empty());
  for (std::size_t row = 0; row < motion.rows.size(); ++row) EXPECT_EQ(std::stod(motion.rows[row][x]), MadeRun::valueAt(10 * (row + 1)));
}

TEST_F(Tables, ChannelsAreUniqueAndTheirTypesUnitsAndCountsAgree) {
  const TsvTable channels = parseTsv(channelsTsv(configuration_));
  const json motion = json::parse(motionJson(recorded()));
  const std::map<std::string, std::set<std::string>> allowed{
      {"LATENCY", {"s"}}, {"POS", {"m"}}, {"VEL", {"m/s"}}, {"ACCEL", {"m/s^2"}}, {"MISC", {"s", "N", "J", "n/a", "1/s"}}};
  std::set<std::string> names, points;
  std::map<std::string, int> counts;
  for (std::size_t i = 0; i < channels.rows.size(); ++i) {
    std::map<std::string, std::string> channel = rowOf(channels, i);
    EXPECT_TRUE(names.insert(channel["name"]).second) << channel["name"];
    ++counts[channel["type"]];
    ASSERT_TRUE(allowed.contains(channel["type"])) << channel["type"];
    EXPECT_TRUE(allowed.at(channel["type"]).contains(channel["units"])) << channel["name"] << " in " << channel["units"];
    if (channel["tracked_point"] != "n/a") points.insert(channel["tracked_point"]);
  }
  EXPECT_EQ(motion.at("MotionChannelCount"), channels.rows.size());
  for (const auto& [key, value] : motion.items())
    if (key.ends_with("ChannelCount") && key != "MotionChannelCount") {
      EXPECT_EQ(value, counts[key.substr(0, key.size() - std::string("ChannelCount").size())]) << key;
    }
  EXPECT_EQ(counts["LATENCY"], 1);
  EXPECT_EQ(motion.at("TrackedPointsCount"), points.size());
  EXPECT_EQ(motion.at("TaskName"), "made") << "the same as task- in the file's name";
  EXPECT_EQ(motion.at("SamplingFrequencyEffective"), 100);
}

TEST_F(Tables, EveryColumnIsExplainedBesideItsTable) {
  const std::vector<RunLog> runs{recorded()};
  const std::string out = folder_ / "csv";
  writeTidyCsv(runs, out);
  std::map<std::string, std::string> phases;
  for (const std::string name : {"trials", "sub-01_ses-01_task-made_run-01_samples"}) {
    const std::string header = readWholeFile(out + "/" + name + ".csv");
    const json dictionary = json::parse(readWholeFile(out + "/" + name + ".json"));
    std::istringstream columns(header.substr(0, header.find('\n')));
    std::size_t count = 0;
    for (std::string column; std::getline(columns, column, ','); ++count) EXPECT_NE(dictionary.at(column).at("Description"), "") << column;
    EXPECT_EQ(dictionary.size(), count) << "no two columns have one name";
    phases[name] = dictionary.at("phase").at("Description");
  }
  const json samples = json::parse(readWholeFile(out + "/sub-01_ses-01_task-made_run-01_samples.json"));
  for (const char* column :
       {"time_s", "hand_x_m", "hand_vx_m_per_s", "mass1_x_m", "mass2_ay_m_per_s2", "mass1_q1", "coupling_x_n", "device_force_z_n"})
    EXPECT_TRUE(samples.contains(column)) << column;
  EXPECT_NE(phases["trials"], phases["sub-01_ses-01_task-made_run-01_samples"]) << "one name, two meanings: both are told";
  const json trials = json::parse(readWholeFile(out + "/trials.json"));
  EXPECT_EQ(trials.at("peak_hand_speed_m_per_s").at("Units"), "m/s");
  EXPECT_FALSE(trials.at("outcome").contains("Units"));
  EXPECT_EQ(trials.at("subject").at("Format"), "string");
}

TEST_F(Tables, TrialsOfOtherRunsAreNotWrittenOver) {
  const std::string out = folder_ / "csv";
  configuration_.notes = "tired, left early";
  configuration_.run = 2;
  writeMadeRun(folder_ / "second_log.reach", 3, configuration_);
  configuration_.run = 1;
  const std::vector<RunLog> both{recorded(), RunLog::open(folder_ / "second_log.reach")};
  writeTidyCsv(both, out);
  EXPECT_TRUE(holds(refusalOf([&] { writeTidyCsv({both[0]}, out); }), "has trials of sub-01, ses-01, run 2, which is not exported now"));
  writeTidyCsv(both, out);
  EXPECT_EQ(readCsvTable(out + "/trials.csv").rows.size(), 6u);
}

TEST_F(Tables, ColumnNamesAndChannelsAgreeOnTheUnit) {
  for (const Channel& channel : configuration_.table.channels)
    EXPECT_EQ(unitOfColumn(channel.column), channel.units == "n/a" ? "" : channel.units) << channel.column;
}

TEST_F(Tables, WritingTheDatasetAgainKeepsWhatAPersonHasAddedToIt) {
  configuration_.participant = {31, "F", "L"};
  const std::vector<RunLog> runs{recorded()};
  const std::string out = folder_ / "dataset";
  writeBids(runs, out);
  EXPECT_EQ(readWholeFile(out + "/participants.tsv"), "participant_id\tage\tsex\thandedness\nsub-01\t31\tF\tL\n");
  writeFileAtomically(out + "/participants.tsv", "participant_id\tage\tgroup\nsub-00\t20\tcontrol\nsub-01\tn/a\tpatient\n");
  writeFileAtomically(out + "/README.md", "mine\n");
  writeBids(runs, out);
  EXPECT_EQ(readWholeFile(out + "/participants.tsv"),
            "participant_id\tage\tgroup\tsex\thandedness\nsub-00\t20\tcontrol\tn/a\tn/a\nsub-01\t31\tpatient\tF\tL\n");
  EXPECT_EQ(readWholeFile(out + "/README.md"), "mine\n");
}

TEST_F(Tables, AnExportedExperimentSaysWhatWasMovedAndAsked) {
  RunConfiguration& c = configuration_;
  const experiment::Experiment moved = experiment::readExperiment("chain-on-ellipse");
  c.experimentName = moved.name;
  c.experimentText = moved.text;
  c.definitionText = experiment::definitionTextOf(moved);
  c.timing = moved.timing;
  const RunLog run = recorded(2);
  writeBidsRun(run, folder_ / ".");
  const std::string file = folder_ / experimentPath(c);
  const experiment::Experiment back = experimentsFromJson(readWholeFile(file), file, c).at(0).experiment();
  EXPECT_EQ(experiment::toJson(back), experiment::toJson(moved));
  EXPECT_FALSE(back.constraint.definition.empty()) << "the formula as it was then";
  const json j = json::parse(readWholeFile(file));
  EXPECT_EQ(j.at("run").at("device"), c.device);
  EXPECT_EQ(j.at("run").at("seed"), c.sessionSeed);
  const std::string words = json::parse(motionJson(run)).at("TaskDescription");
  EXPECT_EQ(experimentNameIn(words), c.experimentName);
  EXPECT_TRUE(holds(words, experiment::describe(moved)));
}

TEST_F(Tables, ARunOfNoTrialHasTablesWithoutRows) {
  const std::vector<RunLog> runs{recorded(0)};
  for (const auto& write : {writeHdf5, writeMatlab}) EXPECT_EQ(write(runs, folder_ / "").size(), 1u);
}

TEST(ColumnDictionary, ExplainsEachColumnOfAHeader) {
  const ColumnMeaning meanings[] = {{"trial", "which"}, {"mass*", "of a mass"}, {"percent", "a share"}};
  const auto j = nlohmann::ordered_json::parse(columnDictionary("subject,trial,mass12_x_m,percent,odd\n1,2,3,4,5\n", meanings));
  std::vector<std::string> keys;
  for (const auto& [key, value] : j.items()) keys.push_back(key);
  EXPECT_EQ(keys, (std::vector<std::string>{"subject", "trial", "mass12_x_m", "percent", "odd"}));
  EXPECT_EQ(j["trial"], (json{{"Description", "which"}}));
  EXPECT_EQ(j["mass12_x_m"], (json{{"Description", "of a mass"}, {"Units", "m"}}));
  EXPECT_EQ(j["percent"], (json{{"Description", "a share"}, {"Units", "%"}}));
  EXPECT_EQ(j["odd"], (json{{"Description", ""}}));
  EXPECT_EQ(j["subject"]["Format"], "string");
  EXPECT_EQ(columnDictionary("", meanings), "{}\n");
  EXPECT_EQ(dictionaryPathOf("a.b/trials.csv"), "a.b/trials.json");
}

TEST(Derivative, SaysWhatItIsAndIsKeptWhereItIsThere) {
  const TemporaryFolder folder;
  const auto described = [&](const std::string& software) {
    std::filesystem::remove(folder / "dataset_description.json");
    EXPECT_EQ(describeDerivative(folder / ".", "Tables", software), folder / "./dataset_description.json");
    return json::parse(readWholeFile(folder / "dataset_description.json"));
  };
  EXPECT_EQ(described("reachlab 0.1.0")["GeneratedBy"], (json::array({{{"Name", "reachlab"}, {"Version", "0.1.0"}}})));
  EXPECT_EQ(described("mylab")["GeneratedBy"], (json::array({{{"Name", "mylab"}, {"Version", "n/a"}}})));
  EXPECT_EQ(described("")["GeneratedBy"], (json::array({{{"Name", "reachlab"}, {"Version", "n/a"}}})));
  EXPECT_EQ(described("")["SourceDatasets"], (json::array({{{"URL", "../.."}}})));
  EXPECT_EQ(describeDerivative(folder / ".", "Others", ""), "");
  EXPECT_EQ(json::parse(readWholeFile(folder / "dataset_description.json"))["Name"], "Tables");
}

TEST_F(Tables, EveryWayToExportIsFoundByItsNameAndWritesIntoItsFolder) {
  const std::vector<RunLog> runs{recorded(1)};
  for (const Exporter& exporter : exporters()) {
    SCOPED_TRACE(exporter.name);
    EXPECT_EQ(findExporter(exporter.name), &exporter);
    EXPECT_EQ(exporter.withEachRun, exporter.name == "bids") << "the dataset alone is kept up to date";
    const std::string data = folder_ / ("data-" + std::string(exporter.name));
    const std::string place = exporter.name == "bids" ? data : data + "/derivatives/" + std::string(exporter.name);
    const std::vector<std::string> written = writeInto(data, exporter, runs);
    for (const std::string& file : written) EXPECT_TRUE(std::filesystem::exists(file)) << file;
    const std::string description = place + "/dataset_description.json";
    EXPECT_EQ(std::count(written.begin(), written.end(), description), 1);
    EXPECT_EQ(json::parse(readWholeFile(description))["DatasetType"], exporter.name == "bids" ? "raw" : "derivative");
    const std::vector<std::string> again = writeInto(data, exporter, runs);
    EXPECT_EQ(std::count(again.begin(), again.end(), description), 0) << "it is there";
  }
  EXPECT_EQ(findExporter("pdf"), nullptr);
}

TEST(Utf16, WhatIsNoUtf8IsTheSignForThat) {
  const std::u16string unknown = u"\ufffd";
  EXPECT_EQ(utf16Of("\x80") + utf16Of("\xff"), unknown + unknown) << "no first byte";
  EXPECT_EQ(utf16Of("\xc0\xaf")[0], 0xfffd) << "a slash in two bytes";
  EXPECT_EQ(utf16Of("\xc1\xbf")[0], 0xfffd);
  EXPECT_EQ(utf16Of("\xe0\x9f\xbf"), unknown) << "in three what fits in two";
  EXPECT_EQ(utf16Of("\xf0\x8f\xbf\xbf"), unknown) << "in four what fits in three";
  EXPECT_EQ(utf16Of("\xed\xa0\x80"), unknown) << "half a pair";
  EXPECT_EQ(utf16Of("\xed\xbf\xbf"), unknown);
  EXPECT_EQ(utf16Of("\xf4\x90\x80\x80"), unknown) << "beyond the last character";
  EXPECT_EQ(utf16Of("\xf5\x80")[0], 0xfffd);
  EXPECT_EQ(utf16Of("\xc3"), unknown) << "cut at the end";
  EXPECT_EQ(utf16Of("\xe2\x82"), unknown);
  EXPECT_EQ(utf16Of("\xc3z"), unknown + u"z") << "and goes on with what is no part of it";
  EXPECT_EQ(utf16Of("\xe2\x82z"), unknown + u"z");
}

}  // namespace
}  // namespace reachlab::record
