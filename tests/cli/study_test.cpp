// `reach study`: the same bytes however the work is divided and interrupted, and the same trials as `reach run`.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <regex>
#include <set>
#include <thread>

#include "tests/cli/program.h"

namespace reachlab::test {
namespace {

constexpr const char* kStudy = R"({
  "schema_version": 1, "name": "small", "seed": 3, "experiment": "chain-moderate", "subjects": 5, "trials": 3, "chunk_trials": 6,
  "subject": { "kind": "plan" }, "profiles": true,
  "vary": { "coupling.stiffness_n_per_m": [500, 600], "subject.noise": { "uniform": [0.5, 1.5], "n": 2 }, "subject.criterion": ["min-hand-jerk", "min-crackle"] },
  "measures": ["movement_time_s", "by", "mass", "peak_hand_speed_m_per_s", "hand_path_m", "mean_force_n", "task_reaction_time_s", "reaction_time_s", "duration_s", "epsilon"],
  "criteria": ["min-hand-jerk", "min-crackle"]
})";

// The tables that a study wrote, one behind the other.
std::string tablesOf(const std::string& folder) {
  std::string all;
  for (const char* name : {"/trials.csv.gz", "/trials.h5", "/trials.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder + name)) << folder << name;
    all += contentOf(folder + name);
  }
  return all;
}

Table tableOf(const std::string& folder) { return parseCsv(shell("gzip -dc \"" + folder + "/trials.csv.gz\"").out); }

class Study : public InAFolder {
 protected:
  const std::string file = folder_.write("small.json", kStudy);
  std::string at(const std::string& name) const { return folder_ / name; }
  // The rows of a study of this text, which is in a file of this name.
  Table computed(const std::string& name, const std::string& text) const {
    printed("study " + folder_.write(name + ".json", text) + " --out " + at(name));
    return tableOf(at(name));
  }
  Ended run(const std::string& out, const std::string& more = "") const {
    return reach("study " + file + " --out " + at(out) + " " + more);
  }
};

TEST_F(Study, GivesTheSameBytesForAnyNumberOfThreadsAndShares) {
  ASSERT_EQ(run("one", "--jobs 1").exitCode, 0);
  const std::string bytes = tablesOf(at("one"));
  ASSERT_EQ(run("threads", "--jobs 3").exitCode, 0);
  EXPECT_EQ(tablesOf(at("threads")), bytes);
  for (const int of : {2, 7}) {
    const std::string out = "shares" + std::to_string(of);
    for (int i = of; i >= 1; --i) ASSERT_EQ(run(out, "--jobs 1 --shard " + std::to_string(i) + "/" + std::to_string(of)).exitCode, 0);
    EXPECT_EQ(tablesOf(at(out)), bytes) << of << " shares";
  }
  const std::string slurm = "SLURM_ARRAY_TASK_MIN=4 SLURM_ARRAY_TASK_STEP=2 SLURM_ARRAY_TASK_COUNT=2 SLURM_ARRAY_TASK_ID=";
  for (const char* id : {"4", "6"}) ASSERT_EQ(reach("study " + file + " --out " + at("array"), slurm + id).exitCode, 0);
  EXPECT_EQ(tablesOf(at("array")), bytes) << "a Slurm array";
}

TEST_F(Study, GivesTheSameBytesAfterKillsAtAnyMoment) {
  ASSERT_EQ(run("whole").exitCode, 0);
  std::mt19937 random(7);
  int killed = 0;
  for (int round = 0; round < 200; ++round) {
    const pid_t child = start({"study", file, "--out", at("killed"), "--jobs", "2", "--resume"});
    std::this_thread::sleep_for(std::chrono::milliseconds(std::uniform_int_distribution<>(1, 60 + 20 * round)(random)));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status)) {
      ASSERT_EQ(WEXITSTATUS(status), 0);
      break;
    }
    ++killed;
  }
  EXPECT_GT(killed, 2);
  EXPECT_EQ(tablesOf(at("killed")), tablesOf(at("whole")));
}

TEST_F(Study, ATrialIsTheSameToTheBitAsThatOfARecordedRun) {
  ASSERT_EQ(run("a").exitCode, 0);
  const Table table = tableOf(at("a"));
  // Somebody who succeeds: where nothing did, the analysis describes failed trials, and a study leaves their errors empty.
  const auto succeeds = [&](std::size_t row) { return table.rows[row][table.column("outcome")] == "success"; };
  std::size_t first = 5 * 5 * 3;
  while (first < 6 * 5 * 3 && !succeeds(first) && !succeeds(first + 1) && !succeeds(first + 2)) first += 3;
  ASSERT_LT(first, 6u * 5u * 3u);
  const std::string subject = table.rows[first][table.column("subject")];
  const std::string point = printed("study point " + at("a") + " 5 --subject " + subject + " --out " + folder_.path());
  ASSERT_EQ(point.substr(0, 10), "reach run ");
  printed(point.substr(6, point.size() - 7) + " --data " + data_);
  printed("analyze " + data_ + " --criterion min-hand-jerk --criterion min-crackle --out " + at("analysis"));
  const Table recorded = exportedTrials(data_), analysed = parseCsv(contentOf(at("analysis") + "/trials.csv"));
  for (std::size_t trial = 0; trial < 3; ++trial) {
    EXPECT_EQ(table.at(first + trial, "point"), 5);
    EXPECT_EQ(table.rows[first + trial][table.column("subject")], subject);
    for (const char* column : {"trial", "outcome", "movement_time_s", "by", "mass", "peak_hand_speed_m_per_s", "hand_path_m",
                               "mean_force_n", "task_reaction_time_s"})
      EXPECT_EQ(table.rows[first + trial][table.column(column)], recorded.rows.at(trial)[recorded.column(column)]) << column;
    for (const char* column : {"reaction_time_s", "duration_s", "epsilon_hand_min_hand_jerk_m_per_s", "epsilon_object_min_crackle_m_per_s"})
      EXPECT_EQ(table.rows[first + trial][table.column(column)], analysed.rows.at(trial)[analysed.column(column)]) << column;
  }
}

TEST_F(Study, GoesThroughAPlanAsASessionDoes) {
  const std::string plan = folder_.write("two.json", R"({"schema_version": 1, "counterbalance": "permute", "foreperiod_s": [0.2, 0.4],
    "blocks": [{"experiment": "chain-moderate", "trials": 2}, {"experiment": "chain-slow", "trials": 2, "condition": "slow"}]})");
  const Table table =
      computed("planned", R"({"schema_version": 1, "plan": "two.json", "subjects": 3, "vary": {"plan.blocks[0].trials": [2, 3]}})");
  ASSERT_EQ(table.rows.size(), 3u * 4 + 3u * 5);
  // Subject 2 of point 0, by the session that its seed repeats.
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.at(i, "point") == 0 && table.at(i, "subject") == 2) rows.push_back(i);
  const std::string seed = table.rows[rows.front()][table.column("seed")];
  printed("run " + plan + " --device simulated --subject 02 --fast --seed " + seed + " --data " + data_);
  Table recorded = exportedTrials(data_);  // by the runs' names
  std::stable_sort(recorded.rows.begin(), recorded.rows.end(), [&, block = recorded.column("block")](const auto& a, const auto& b) {
    return std::stoi(a[block]) < std::stoi(b[block]);
  });
  ASSERT_EQ(recorded.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const char* column : {"block", "condition", "trial", "outcome", "peak_hand_speed_m_per_s", "task_reaction_time_s"})
      EXPECT_EQ(table.rows[rows[i]][table.column(column)], recorded.rows[i][recorded.column(column)]) << column;
}

TEST_F(Study, SaysHowFarItIs) {
  const auto told = [](const Ended& ended) {  // first and last
    const std::regex line(R"(\d+ of \d+ trials)");
    std::vector<std::string> lines;
    for (std::sregex_iterator at(ended.err.begin(), ended.err.end(), line), end; at != end; ++at) lines.push_back(at->str());
    return lines.empty() ? ended.err : lines.front() + "; " + lines.back();
  };
  EXPECT_EQ(told(run("a", "--shard 1/4")), "3 of 30 trials; 30 of 30 trials");
  const auto status = [&] { return printed("study status " + at("a")); };
  EXPECT_TRUE(status().starts_with("chunks=5 of=20 trials=30 of=120 rate")) << status();
  // Five chunks of six trials, a second apart: 24 trials in 4 s, and 90 are left.
  auto when = std::filesystem::file_time_type::clock::now();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(at("a") + "/chunks"))
    if (entry.is_regular_file()) std::filesystem::last_write_time(entry.path(), when -= std::chrono::seconds(1));
  EXPECT_TRUE(holds(status(), " rate_per_s=6 left_s=15 "));
  EXPECT_TRUE(says(run("a", "--shard 1/4"), 2, "--resume"));
  EXPECT_EQ(told(run("a", "--resume")), "33 of 120 trials; 120 of 120 trials");
  EXPECT_TRUE(holds(status(), "tables=yes"));
  // Of one that lacks a single chunk there is no report.
  EXPECT_EQ(reach("study report " + at("a")).exitCode, 0);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(at("a") + "/chunks"))
    if (entry.path().filename() == "00000007.chunk") std::filesystem::remove(entry.path());
  EXPECT_TRUE(says(reach("study report " + at("a")), 2, "1 of 20 chunks are not there yet"));
}

TEST_F(Study, TellsWhatIsWrongWhereItStands) {
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = kStudy;
    text.replace(text.find(from), from.size(), to);
    return reach("study " + folder_.write("bad.json", text) + " --out " + at("bad"));
  };
  EXPECT_TRUE(says(refusal("\"subjects\": 5", "\"subjects\": 0"), 2, "bad.json:2:"));
  EXPECT_TRUE(says(refusal("\"by\"", "\"bye\""), 2, "measures[1]: is \"bye\""));
  EXPECT_TRUE(says(refusal("[500, 600]", "[500, -1]"), 2, "coupling.stiffness_n_per_m: is -1"));
  EXPECT_TRUE(says(refusal("\"subject.noise\"", "\"subject.nois\""), 2, "nois is not known"));
  EXPECT_TRUE(says(refusal("chain-moderate", "no-such-chain"), 2, "experiment"));
  EXPECT_TRUE(says(refusal("coupling.stiffness_n_per_m", "object.masses_kg[9]"), 2, "object.masses_kg[9]: is beyond the 5 elements"));
  EXPECT_FALSE(std::filesystem::exists(at("bad")));
}

// Two criteria that hands follow without noise but in time: every study of five people names the truth.
TEST_F(Study, ReportsWhatTheAnalysisWouldName) {
  computed("t", R"({"schema_version": 1, "experiment": "chain-moderate", "subjects": 10, "trials": 14,
    "subject": {"noise": 0.3}, "vary": {"subject.criterion": ["min-hand-jerk", "min-crackle"]}, "measures": ["score"],
    "criteria": ["min-hand-jerk", "min-crackle", "min-hand-crackle"]})");
  printed("study report " + at("t") + " --studies 20 --subjects 5 --trials 14");
  const Table confusion = parseCsv(contentOf(at("t") + "/report/confusion.csv")),
              power = parseCsv(contentOf(at("t") + "/report/power.csv"));
  ASSERT_EQ(power.rows.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(power.at(i, "right"), 20) << power.rows[i][0];
    EXPECT_EQ(power.rows[i][power.column("cell")], "") << "nothing else was varied";
  }
  double studies = 0;
  for (std::size_t i = 0; i < confusion.rows.size(); ++i) {
    studies += confusion.at(i, "studies");
    if (confusion.at(i, "studies") == 0) continue;
    EXPECT_EQ(confusion.rows[i][confusion.column("truth")], confusion.rows[i][confusion.column("named")]);
  }
  EXPECT_EQ(studies, 40);
  std::set<std::string> truths;
  for (const auto& row : confusion.rows) truths.insert(row[confusion.column("truth")]);
  EXPECT_EQ(truths.size(), 3u) << "also a criterion that nobody follows";
  const Table smallest = parseCsv(contentOf(at("t") + "/report/smallest.csv"));
  EXPECT_EQ(smallest.at(0, "subjects"), 5);
  EXPECT_EQ(smallest.at(0, "trials"), 14);
  for (const char* figure : {"success.svg", "confusion.pdf", "power.svg"})
    EXPECT_TRUE(std::filesystem::exists(at("t") + "/report/" + figure)) << figure;
  // Axes, rules and words are black or grey; what was counted is drawn in colour.
  const std::string drawing = contentOf(at("t") + "/report/power.svg");
  const std::regex color(R"re(rgb\(([\d.]+)%, ?([\d.]+)%, ?([\d.]+)%\))re");
  EXPECT_TRUE(std::any_of(std::sregex_iterator(drawing.begin(), drawing.end(), color), std::sregex_iterator(),
                          [](const std::smatch& m) { return m[1] != m[2] || m[2] != m[3]; }));
  EXPECT_EQ(reach("study report " + at("nothing")).exitCode, 2);
}

TEST_F(Study, TheManualHasTheSubjectsNumbersAsTheProgramPrintsThem) {
  const std::string page = contentOf(std::string(REACHLAB_SOURCE_DIR) + "/docs/virtual-subjects.md");
  std::istringstream lines(printed("study parameters"));
  for (std::string line; std::getline(lines, line);) EXPECT_TRUE(holds(page, line + "\n")) << line;
}

TEST_F(Study, ReportsOfWhatItDrawsNoStudies) {
  computed("f", R"({"schema_version": 1, "experiment": "chain-moderate", "subjects": 4, "trials": 14,
    "subject": {"noise": 0.3}, "vary": {"subject.criterion": ["min-hand-jerk", "min-crackle"]}, "measures": ["score"],
    "criteria": ["min-hand-jerk", "min-hand-crackle"]})");
  const Ended report = reach("study report " + at("f"));
  ASSERT_TRUE(says(report, 0, "min-hand-jerk: 4 virtual subjects with 10 successes; nothing is drawn from fewer than five"));
  EXPECT_TRUE(holds(report.err, "min-crackle: 4 virtual subjects with 10 successes; its criterion is not compared"));
}

// Each has its own part of the work done, and not by another's asking for the same.
TEST_F(Study, MeasuresTheSameWhateverElseItMeasures) {
  const auto measured = [&](const std::string& name, const std::vector<std::string>& measures) {
    return computed(
        name, R"({"schema_version": 1, "name": "m", "seed": 3, "experiment": "chain-moderate", "subjects": 1, "trials": 2, "measures": )" +
                  nlohmann::json(measures).dump() + "}");
  };
  const std::vector<std::string> names = split(
      "by,movement_time_s,task_reaction_time_s,reaction_time_s,peak_hand_speed_m_per_s,hand_path_m,peak_force_n,mean_force_n,onset_s,offset_s,duration_s,"
      "peak_speed_m_per_s,time_to_peak_s,time_to_peak_percent,symmetry_ratio,path_length_m,speed_peaks,hand_endpoint_error_m,"
      "object_endpoint_error_m,hand_overshoot_m,object_overshoot_m,sparc,ldlj",
      ',');
  const Table together = measured("together", names);
  for (const std::string& name : names) {
    const Table alone = measured(name, {name});
    for (std::size_t trial = 0; trial < 2; ++trial) {
      const std::string& value = together.rows.at(trial)[together.column(name)];
      EXPECT_NE(value, "") << name;
      EXPECT_EQ(alone.rows.at(trial)[alone.column(name)], value) << name;
    }
  }
}

// What a subject learns in one block it has in the next, and slow practice is not lost overnight.
TEST_F(Study, ALearnerTakesWhatItLearntThroughThePlan) {
  folder_.write(
      "days.json",
      R"({"schema_version": 1, "blocks": [{"experiment": "chain-slow", "trials": 6, "day": 1}, {"experiment": "chain-moderate", "trials": 6, "day": 1},
    {"experiment": "chain-moderate", "trials": 6, "day": 2}]})");
  const auto rows = [&](const std::string& name, const std::string& subject) {
    return computed(name, R"({"schema_version": 1, "name": "l", "plan": "days.json", "subjects": 2, "subject": )" + subject + "}").rows;
  };
  const auto learner = rows("learner", R"({"kind": "ofc", "subject": 1})"),
             none = rows("none", R"({"kind": "ofc", "subject": 1, "learn-slow": 0, "learn-fast": 0})");
  ASSERT_EQ(learner.size(), 36u);
  EXPECT_EQ(learner[0], none[0]) << "the first trial has nothing behind it";
  EXPECT_NE(learner[6], none[6]) << "the second block's first trial has the first block behind it";
  EXPECT_NE(learner[12], none[12]) << "the second day's has the first day";
  EXPECT_EQ(rows("again", R"({"kind": "ofc", "subject": 1})"), learner);
}

TEST_F(Study, RefusesAFolderOfAnotherStudy) {
  ASSERT_EQ(run("a").exitCode, 0);
  EXPECT_TRUE(says(reach("study " + folder_.write("small.json", std::string(kStudy) + "\n") + " --out " + at("a") + " --resume"), 3,
                   "another study"));
}

}  // namespace
}  // namespace reachlab::test
