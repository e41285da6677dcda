#include "sim/session/backup.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include "base/error.h"
#include "sim/record/export/bids.h"
#include "sim/record/log/folder_hold.h"
#include "sim/record/log/whole_file.h"
#include "sim/session/backup_worker.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace {
// Files that the system was told to forget what it has of them in memory.
std::set<std::string>& forgotten() {
  static std::set<std::string> paths;
  return paths;
}
std::mutex forgottenMutex;
}  // namespace

/// In the place of the C library's.
extern "C" int posix_fadvise(int file, off_t at, off_t size, int advice) noexcept {
  if (advice == POSIX_FADV_DONTNEED && at == 0 && size == 0) {
    std::error_code error;
    const auto path = std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(file), error);
    const std::scoped_lock lock(forgottenMutex);
    forgotten().insert(path.string());
  }
  return static_cast<int>(::syscall(SYS_fadvise64, file, at, size, advice)) == 0 ? 0 : errno;
}

namespace reachlab::session {
namespace {

namespace fs = std::filesystem;

class Backups : public testing::Test {
 protected:
  void SetUp() override { addRun(1); }
  std::string logOf(int run) const { return dataset_ + "/sourcedata/sub-01_ses-01_task-made_run-0" + std::to_string(run) + "_log.reach"; }
  void addRun(int run) {
    record::RunConfiguration configuration = record::madeConfiguration();
    configuration.run = configuration.firstRun = run;
    record::writeMadeRun(logOf(run), 2, configuration);
    std::vector<record::RunLog> runs;
    runs.push_back(record::RunLog::open(logOf(run)));
    record::writeBids(runs, dataset_);
  }
  static std::string contentOf(const std::string& path) { return record::readWholeFile(path); }
  std::string inBackup(const std::string& path) const { return backup_ + path.substr(dataset_.size()); }
  std::string refusal() const {
    return refusalOf([&] { (void)backUp(dataset_, backup_); }, "made");
  }

  TemporaryFolder folder_;
  std::string dataset_ = folder_ / "data", backup_ = folder_ / "second/data";
};

TEST_F(Backups, HoldEveryFileOfFinishedRunsByteByByte) {
  fs::create_directories(dataset_ + "/derivatives/reachlab");
  std::ofstream(dataset_ + "/derivatives/reachlab/report.html") << "can be made again";
  std::ofstream(dataset_ + "/.0123.reachlab-tmp") << "half";
  const BackupReport report = backUp(dataset_, backup_);
  EXPECT_EQ(report.runs, 1u);
  std::size_t files = 0;
  std::uint64_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(dataset_)) {
    const std::string path = entry.path().string();
    if (!entry.is_regular_file() || path.find("derivatives") != std::string::npos || path.ends_with("-tmp")) continue;
    ++files;
    bytes += entry.file_size();
    EXPECT_EQ(contentOf(inBackup(path)), contentOf(path)) << path;
  }
  EXPECT_EQ(report.copiedFiles, files);
  EXPECT_EQ(report.copiedBytes, bytes);
  EXPECT_FALSE(fs::exists(backup_ + "/derivatives"));
  EXPECT_TRUE(faultsOfBackup(backup_).empty());
}

/// As a user who owns nothing: everything may be read by root.
class AsNobody {
 public:
  AsNobody() { (void)!::seteuid(::geteuid() == 0 ? 65534 : ::geteuid()); }
  ~AsNobody() { (void)!::seteuid(::getuid()); }
};

TEST_F(Backups, NameWhatCannotBeReadAndCopyTheRest) {
  addRun(2);
  fs::create_directories(backup_);
  for (const fs::path& folder : {fs::path(folder_.path()), fs::path(backup_).parent_path(), fs::path(backup_)})
    fs::permissions(folder, fs::perms::all);
  fs::permissions(dataset_ + "/code", fs::perms::none);
  fs::permissions(logOf(1), fs::perms::none);
  std::string told;
  {
    const AsNobody nobody;
    told = refusal();
  }
  EXPECT_TRUE(holds(told, dataset_ + "/code: cannot be read: Permission denied"));
  EXPECT_TRUE(holds(told, logOf(1) + ": cannot be read: Permission denied"));
  EXPECT_TRUE(fs::exists(inBackup(logOf(2))));
  EXPECT_TRUE(fs::exists(backup_ + "/sub-01/ses-01/sub-01_ses-01_scans.tsv")) << "it comes after the folder that cannot be read";
  fs::permissions(dataset_ + "/code", fs::perms::owner_all);
}

TEST_F(Backups, FollowLinkedFoldersAndNoLoop) {
  for (const char* name : {"/sourcedata", "/sub-01"}) {
    const std::string moved = folder_ / ("elsewhere" + std::string(name));
    record::makeFolders(folder_ / "elsewhere");
    fs::rename(dataset_ + name, moved);
    fs::create_directory_symlink(moved, dataset_ + name);
  }
  record::makeFolders(backup_);
  fs::create_directory_symlink(dataset_, dataset_ + "/sub-01/round");
  fs::create_directory_symlink(folder_ / "second", dataset_ + "/copies");
  std::ofstream(dataset_ + "/.bidsignore") << "kept";
  for (int k = 0; k < 2; ++k) {
    EXPECT_EQ(backUp(dataset_, backup_).runs, 1u);
    EXPECT_EQ(contentOf(inBackup(logOf(1))), contentOf(logOf(1)));
    for (const char* name : {"/sub-01/ses-01/sub-01_ses-01_scans.tsv", "/.bidsignore"}) EXPECT_TRUE(fs::exists(backup_ + name)) << name;
    for (const char* name : {"/sub-01/round", "/copies/data"}) EXPECT_FALSE(fs::exists(backup_ + name)) << name;
  }
}

// The list is for who does not have this program.
TEST_F(Backups, AreCheckedBySha256sum) {
  (void)backUp(dataset_, backup_);
  const std::string check = "cd '" + backup_ + "' && sha256sum --quiet -c sourcedata/sha256sums.txt > /dev/null 2>&1";
  EXPECT_EQ(std::system(check.c_str()), 0);
  std::ofstream(backup_ + "/README.md", std::ios::app) << "x";
  EXPECT_NE(std::system(check.c_str()), 0);
}

TEST_F(Backups, CopyOnlyWhatIsNew) {
  (void)backUp(dataset_, backup_);
  EXPECT_EQ(backUp(dataset_, backup_).copiedFiles, 0u);
  EXPECT_EQ(backUp(dataset_ + "/", backup_ + "/").copiedFiles, 0u) << "a folder is the same one with a slash";
  addRun(2);
  const BackupReport report = backUp(dataset_, backup_);
  EXPECT_EQ(report.runs, 2u);
  EXPECT_TRUE(fs::exists(inBackup(logOf(2))));
  EXPECT_EQ(contentOf(inBackup(dataset_ + "/sub-01/ses-01/sub-01_ses-01_scans.tsv")),
            contentOf(dataset_ + "/sub-01/ses-01/sub-01_ses-01_scans.tsv"))
      << "a table that the runs share is brought up to date";
}

TEST_F(Backups, LeaveARunAndItsTablesUntilItsLogIsClosed) {
  record::RunConfiguration configuration = record::madeConfiguration();
  configuration.run = configuration.firstRun = 2;
  auto recorder = std::make_unique<record::Recorder>(logOf(2), configuration, record::RecorderOptions{.threaded = false});
  const std::string table = dataset_ + "/sub-01/ses-01/motion/sub-01_ses-01_task-made_tracksys-haptic_run-02_motion.tsv";
  record::makeFolders(fs::path(table).parent_path().string());
  std::ofstream(table) << "half";
  const BackupReport report = backUp(dataset_, backup_);
  EXPECT_EQ(report.runs, 1u);
  EXPECT_EQ(report.pending, 1u);
  EXPECT_FALSE(fs::exists(inBackup(logOf(2))));
  EXPECT_FALSE(fs::exists(inBackup(table)));
  recorder->close();
  recorder.reset();
  (void)backUp(dataset_, backup_);
  EXPECT_TRUE(fs::exists(inBackup(logOf(2))));
  EXPECT_TRUE(fs::exists(inBackup(table)));
}

TEST_F(Backups, SayWhichFileHasOtherBytes) {
  (void)backUp(dataset_, backup_);
  {
    std::fstream log(inBackup(logOf(1)), std::ios::in | std::ios::out | std::ios::binary);
    log.seekp(100);
    log.put('!');
  }
  fs::remove(backup_ + "/README.md");
  const auto faults = faultsOfBackup(backup_);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0], backup_ + "/README.md: is missing");
  EXPECT_EQ(faults[1], inBackup(logOf(1)) + ": has other bytes than were copied");
}

TEST_F(Backups, NeverOverwriteALogOfAnother) {
  record::makeFolders(backup_ + "/sourcedata");
  std::ofstream(inBackup(logOf(1))) << "another laboratory's only copy";
  EXPECT_TRUE(holds(refusal(), "is there already with other bytes; nothing is overwritten"));
  EXPECT_EQ(contentOf(inBackup(logOf(1))), "another laboratory's only copy");
}

TEST_F(Backups, NeverOverwriteAFileThatNoBackupPutThere) {
  record::makeFolders(backup_);
  std::ofstream(backup_ + "/README.md") << "another dataset's";
  fs::copy_file(dataset_ + "/participants.tsv", backup_ + "/participants.tsv");
  EXPECT_EQ(refusal(), backup_ + "/README.md: is there already with other bytes, and no backup put it there; choose another folder");
  EXPECT_EQ(contentOf(backup_ + "/README.md"), "another dataset's");
  EXPECT_EQ(contentOf(inBackup(logOf(1))), contentOf(logOf(1))) << "the rest is copied";
  EXPECT_TRUE(faultsOfBackup(backup_).empty());
  fs::remove(backup_ + "/README.md");
  std::ofstream(dataset_ + "/participants.tsv", std::ios::app) << "changed since";
  EXPECT_EQ(refusal(), "made");
  EXPECT_EQ(contentOf(backup_ + "/participants.tsv"), contentOf(dataset_ + "/participants.tsv"));
}

TEST_F(Backups, LoseNoRowOfATableToAnotherDataset) {
  const std::string table = dataset_ + "/participants.tsv", first = contentOf(table);
  (void)backUp(dataset_, backup_);
  std::ofstream(table, std::ios::app) << "sub-02\tn/a\tn/a\tn/a\n";
  EXPECT_EQ(refusal(), "made") << "a dataset grows";
  std::ofstream(table) << first;
  EXPECT_TRUE(holds(refusal(), inBackup(table) + ": has a row of sub-02 that " + table + " lacks"));
  EXPECT_TRUE(holds(contentOf(inBackup(table)), "sub-02"));
}

TEST_F(Backups, OfARecoveredLogNameItAndKeepAllOthers) {
  (void)backUp(dataset_, backup_);
  const std::string before = contentOf(inBackup(logOf(1)));
  std::ofstream(logOf(1), std::ios::app) << "other bytes, as a recovery leaves them";
  addRun(2);
  EXPECT_TRUE(holds(refusal(), inBackup(logOf(1)) + ": is there already with other bytes"));
  EXPECT_EQ(contentOf(inBackup(logOf(1))), before);
  EXPECT_EQ(contentOf(inBackup(logOf(2))), contentOf(logOf(2)));
}

TEST_F(Backups, CountNoRunThatWasNotEndedInOrder) {
  addRun(2);
  fs::resize_file(logOf(2), fs::file_size(logOf(2)) - 1);  // a kill in the record that closes it
  std::ofstream(logOf(3)) << "";
  std::ofstream(logOf(4)) << std::string(5000, '\0');
  const std::string said = refusal();
  for (const int run : {2, 3, 4}) {
    EXPECT_TRUE(holds(said, logOf(run)));
    EXPECT_FALSE(fs::exists(inBackup(logOf(run))));
  }
  EXPECT_TRUE(fs::exists(inBackup(logOf(1))));
}

// What the system still has in memory would be right on any disk.
TEST_F(Backups, AreReadBackFromTheDisk) {
  const auto readFromDisk = [&] {
    std::set<std::string> paths;
    for (const std::string& path : forgotten())
      if (path.starts_with(fs::weakly_canonical(backup_).string() + "/")) paths.insert(path);
    forgotten().clear();
    return paths;
  };
  std::set<std::string> copies;
  (void)readFromDisk();
  (void)backUp(dataset_, backup_);
  for (const auto& entry : fs::recursive_directory_iterator(fs::canonical(backup_)))
    if (entry.is_regular_file() && !entry.path().string().ends_with(kBackupList)) copies.insert(entry.path().string());
  EXPECT_EQ(copies.size(), filesOfBackup(backup_));
  EXPECT_EQ(readFromDisk(), copies) << "when they are made";
  EXPECT_TRUE(faultsOfBackup(backup_).empty());
  EXPECT_EQ(readFromDisk(), copies) << "when they are checked";
  fs::remove(backup_ + "/" + kBackupList);
  (void)backUp(dataset_, backup_);
  EXPECT_EQ(readFromDisk(), copies) << "when they are there, and nobody knows of them";
}

// A disk that loses what it was given: somebody cuts the copy short as soon as it is there, before it has been read back.
TEST_F(Backups, LeaveNoCopyThatReadsBackOtherwise) {
  const std::string file = dataset_ + "/sourcedata/video.mp4", copy = inBackup(file);
  std::ofstream(file) << std::string(std::size_t{1} << 25, 'v');
  constexpr int kTries = 50;  // the copy may be read back before it is cut
  std::string said = "made";
  for (int k = 0; k < kTries && said == "made"; ++k) {
    std::jthread disk([&](const std::stop_token& stop) {
      while (!stop.stop_requested() && ::truncate(copy.c_str(), 1000) != 0) std::this_thread::yield();
    });
    said = refusal();
  }
  EXPECT_TRUE(holds(said, "reads back with other bytes than were written; the copy was removed"));
  EXPECT_FALSE(fs::exists(copy));
}

TEST_F(Backups, LieElsewhere) {
  const std::string dataset = dataset_;
  fs::create_directory_symlink(dataset, folder_ / "link");
  for (const std::string& backup : {dataset, (folder_ / "link").string(), dataset + "/copy"})
    for (const char* slash : {"", "/"}) {
      dataset_ = dataset + slash;
      backup_ = backup;
      EXPECT_TRUE(holds(refusal(), "lies in the dataset itself")) << backup_ << " of " << dataset_;
    }
  std::ofstream(folder_ / "file") << "no folder";
  backup_ = folder_ / "file";
  EXPECT_NE(refusal(), "made");
  EXPECT_THROW(faultsOfBackup(folder_ / "nowhere"), ResourceError);
}

TEST_F(Backups, AreMadeOnAThreadOfTheirOwnAndSayHowTheyStand) {
  BackupWorker worker(dataset_, backup_);
  EXPECT_EQ(worker.state().kind, BackupState::Kind::Idle);
  worker.request();
  BackupState state = worker.finish();
  EXPECT_EQ(state.kind, BackupState::Kind::Verified) << state.sentence;
  const std::string files = std::to_string(filesOfBackup(backup_));
  EXPECT_TRUE(holds(state.sentence, "all 1 finished run is there and verified (" + files + " files, "));
  for (const int count : {1, 2}) {
    for (int i = 0; i < count; ++i) std::ofstream(dataset_ + "/note" + std::to_string(i)) << count;
    worker.request();
    state = worker.finish();
    EXPECT_TRUE(holds(state.sentence, count == 1 ? "(1 file, " : "(2 files, "));
  }
  addRun(2);
  record::makeFolders(backup_ + "/sourcedata");
  std::ofstream(inBackup(logOf(2))) << "in the way";
  worker.request();
  state = worker.finish();
  EXPECT_EQ(state.kind, BackupState::Kind::Failed);
  EXPECT_TRUE(holds(state.sentence, "not made: "));
  EXPECT_TRUE(holds(state.sentence, "; the recording itself is safe"));
}

}  // namespace
}  // namespace reachlab::session
