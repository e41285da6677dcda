// A disk that fails while it is read: tests/long/fault_shim.c is preloaded and lets one read fail.
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/cli/program.h"

using namespace reachlab::test;
namespace fs = std::filesystem;

namespace {

using Tables = std::map<std::string, std::string>;

Tables tablesIn(const fs::path& folder) {
  Tables tables;
  if (!fs::exists(folder)) return tables;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".csv") tables[entry.path().filename()] = contentOf(entry.path());
  return tables;
}

class ReadFaults : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "a sanitizer's own library has to be the first that is loaded";
#endif
    for (const auto& [dataset, number] : {std::pair{"both", "1"}, {"first", "1"}, {"both", "2"}, {"second", "2"}})
      printed(std::string("run dingwell --device simulated --trials 3 --fast --run ") + number + " --seed " + number + " --data " +
              (folder_ / dataset).string());
  }
  // `reach ARGUMENTS` with one call of a kind failing; the 0th: none fails.
  Ended failing(const std::string& kind, int at, const std::string& arguments) const {
    return reach(arguments, "LD_PRELOAD=" REACHLAB_BINARY_DIR "/tests/libfault_shim.so FAULT_KIND=" + kind +
                                " FAULT_AT=" + std::to_string(at) + " FAULT_COUNT=" + (folder_ / "count").string());
  }
  // `reach analyze` of the dataset, with that read failing; 0: none fails. The dataset's name is the same each time: it stands in tables.
  Ended analyse(const std::string& dataset, int read) {
    fs::remove_all(folder_ / "out");
    fs::rename(folder_ / dataset, folder_ / "data");
    const Ended ended =
        failing("read", read, "analyze " + (folder_ / "data").string() + " --criterion min-hand-jerk --out " + (folder_ / "out").string());
    fs::rename(folder_ / "data", folder_ / dataset);
    tables_ = tablesIn(folder_ / "out");
    return ended;
  }
  int reads() const { return std::abs(std::stoi(contentOf(folder_ / "count"))); }

  TemporaryFolder folder_;
  Tables tables_;  // of the latest analysis
};

TEST_F(ReadFaults, LeaveARunInTheAnalysisWholeOrNotAtAll) {
  std::map<Tables, std::string> whole{{Tables{}, "none"}};
  for (const char* which : {"first", "second", "both"}) {
    const Ended ended = analyse(which, 0);
    ASSERT_EQ(ended.exitCode, 0) << ended.err;
    whole[tables_] = which;
  }
  ASSERT_EQ(whole.size(), 4u);
  const int all = reads();
  ASSERT_GT(all, 5);
  std::set<std::string> seen;
  for (int n = 1; n <= all; ++n) {
    const Ended ended = analyse("both", n);
    const auto known = whole.find(tables_);
    ASSERT_NE(known, whole.end()) << "read " << n << " of " << all << ": a part of a run was counted: " << ended.err;
    seen.insert(known->second);
    EXPECT_EQ(ended.exitCode, known->second == "both" ? 0 : 3)
        << "read " << n << " of " << all << ": " << known->second << ": " << ended.err;
    EXPECT_TRUE(ended.exitCode == 0 || holds(ended.err, "cannot be")) << ended.err;
  }
  EXPECT_TRUE(seen.contains("first") && seen.contains("second")) << "each of the two was left out once";
}

TEST_F(ReadFaults, NeverLetAResumedSessionForgetWhatIsRecorded) {
  const std::string log = (folder_ / "first/sourcedata/sub-01_ses-01_task-dingwell_run-01_log.reach").string();
  fs::resize_file(log, fs::file_size(log) * 55 / 100);  // broken off in its second trial
  const auto resume = [&](int read) {
    fs::remove_all(folder_ / "again");
    fs::copy(folder_ / "first", folder_ / "again", fs::copy_options::recursive);
    return failing("read", read, "run dingwell --device simulated --fast --resume --data " + (folder_ / "again").string());
  };
  const Ended whole = resume(0);
  ASSERT_EQ(whole.exitCode, 0) << whole.err;
  const std::size_t left = trialLines(whole.out).size();
  ASSERT_EQ(left, 2u) << whole.out;
  const int all = reads();
  for (int n = 1; n <= all; ++n) {
    const Ended ended = resume(n);
    if (ended.exitCode == 0) {
      EXPECT_EQ(trialLines(ended.out).size(), left) << "read " << n << " of " << all;
    } else {
      EXPECT_TRUE(ended.exitCode == 2 || ended.exitCode == 3)
          << "read " << n << " of " << all << ": " << ended.err;  // 2: the experiment's file
      EXPECT_TRUE(holds(ended.err, "cannot be read"));
    }
  }
}

TEST_F(ReadFaults, NoMemoryEndsAnyStageWithASentence) {
  const std::string data = (folder_ / "memory").string();
  std::vector<int> calls{1, 10, 100, 1000, 2000, 4000, 10000, 20000};
  for (int at = 3000; at < 3600; at += 23) calls.push_back(at);  // while the program looks for its resources
  for (const int at : calls) {
    fs::remove_all(data);
    const Ended ended = failing("malloc", at, "run dingwell --device simulated --trials 3 --fast --seed 1 --data " + data);
    const bool file = says(ended, 2, "cannot be read: Cannot allocate memory"), told = says(ended, 3, "there is not enough memory");
    // A library may do without the memory; then nothing is missing.
    EXPECT_TRUE(file || told || (ended.exitCode == 0 && trialLines(ended.out).size() == 3)) << at << ": " << ended.err;
  }
}

}  // namespace
