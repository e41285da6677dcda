#include "sim/record/log/append_file.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/folder_hold.h"
#include "sim/record/log/whole_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "base/fault.h"
#include "tests/in_a_folder.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

const std::string kTooLarge =
    "its disk or a limit of this process (ulimit -f) allows no larger file: choose another disk or raise the limit";

// As long as it is there, no file of this program grows beyond so many bytes.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) : signal_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FileLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ::signal(SIGXFSZ, signal_);
  }

 private:
  void (*signal_)(int);
  rlimit before_{};
};

// Under which this process holds the file open.
int descriptorOf(const std::string& path) {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    if (std::filesystem::equivalent(entry.path(), path, error)) return std::stoi(entry.path().filename());
  return -1;
}

std::size_t countFiles(const std::string& folder) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) count += entry.is_regular_file();
  return count;
}

class AppendedFile : public InAFolder {};

TEST_F(AppendedFile, GrowsByWhatIsAppendedInFoldersOfItsOwnMaking) {
  const std::string path = folder_ / "one/two/a_log.reach";
  AppendFile file = AppendFile::create(path);
  EXPECT_EQ(file.size(), 0u);
  file.append(asBytes("abc"));
  file.append(asBytes(""));
  file.append(asBytes("defgh"));
  EXPECT_EQ(file.size(), 8u);
  EXPECT_EQ(file.path(), path);
  EXPECT_NO_THROW(file.sync());
  EXPECT_EQ(readWholeFile(path), "abcdefgh");
}

TEST_F(AppendedFile, NothingIsOverwritten) {
  writeFileAtomically(log_, "precious");
  EXPECT_EQ(refusalOf([&] { AppendFile::create(log_); }),
            log_ + ": cannot be created: File exists; nothing is overwritten: choose another name");
  EXPECT_EQ(readWholeFile(log_), "precious");
}

TEST_F(AppendedFile, WhatTheDiskTakesOnlyInPartIsTakenBack) {
  AppendFile file = AppendFile::create(log_);
  file.append(asBytes(std::string(60, 'a')));
  {
    const FileLimit limit(100);
    EXPECT_EQ(refusalOf([&] { file.append(asBytes(std::string(60, 'b'))); }), log_ + ": cannot be written: File too large; " + kTooLarge);
    EXPECT_EQ(file.size(), 60u);
    EXPECT_EQ(std::filesystem::file_size(log_), 60u);
    EXPECT_NO_THROW(file.append(asBytes(std::string(40, 'c')))) << "what fits goes in";
  }
  file.append(asBytes("d"));
  EXPECT_EQ(readWholeFile(log_), std::string(60, 'a') + std::string(40, 'c') + "d");
}

// A file in memory that nothing makes shorter again.
TEST_F(AppendedFile, WhatCannotBeTakenBackIsKnownAndNothingIsWrittenBehindIt) {
  const int memory = ::memfd_create("log", MFD_ALLOW_SEALING | MFD_CLOEXEC);
  ASSERT_GE(memory, 0);
  const std::string path = "/proc/self/fd/" + std::to_string(memory), good(60, 'a'), part(40, 'b');
  {
    AppendFile file = AppendFile::create(log_);
    ASSERT_GE(::dup2(memory, descriptorOf(log_)), 0);
    file.append(asBytes(good));
    ASSERT_EQ(::fcntl(memory, F_ADD_SEALS, F_SEAL_SHRINK), 0);
    const FileLimit limit(100);
    for (const char* words : {"cannot be written: File too large", "cannot be cut to its good part: Operation not permitted"}) {
      EXPECT_TRUE(holds(refusalOf([&] { file.append(asBytes(std::string(60, 'b'))); }), words)) << words;
      EXPECT_EQ(file.size(), 60u) << "the good part stays, whatever follows";
      EXPECT_EQ(readWholeFile(path), good + part);
    }
  }
  ::close(memory);
}

TEST_F(AppendedFile, OneThatIsMovedKeepsItsLockAndItsPlace) {
  const std::string other = folder_ / "b_log.reach";
  {
    AppendFile first = AppendFile::create(log_);
    first.append(asBytes("abc"));
    AppendFile second(std::move(first));
    EXPECT_EQ(second.size(), 3u);
    EXPECT_TRUE(isBeingWritten(log_));
    AppendFile third = AppendFile::create(other);
    third = std::move(second);
    EXPECT_EQ(third.path(), log_);
    EXPECT_EQ(third.size(), 3u);
    third.append(asBytes("d"));
    EXPECT_EQ(third.size(), 4u);
    EXPECT_NO_THROW(third.sync());
  }
  EXPECT_EQ(readWholeFile(log_), "abcd");
  EXPECT_EQ(readWholeFile(other), "");
  EXPECT_FALSE(isBeingWritten(log_));
}

TEST_F(AppendedFile, IsBeingWrittenAsLongAsItIsThere) {
  EXPECT_FALSE(isBeingWritten(log_)) << "there is none";
  EXPECT_EQ(writerOf(log_), "");
  {
    const AppendFile file = AppendFile::create(log_);
    EXPECT_TRUE(isBeingWritten(log_));
    EXPECT_EQ(writerOf(log_), " (process " + std::to_string(::getpid()) + ")");
    EXPECT_EQ(writerOf(folder_ / ""), "") << "of another file";
  }
  EXPECT_FALSE(isBeingWritten(log_));
  EXPECT_EQ(writerOf(log_), "");
}

TEST_F(AppendedFile, NoticesThatItIsNoLongerUnderItsName) {
  const std::string words = log_ + ": is no longer there: its disk was taken away or it was deleted; put it back before the next run";
  AppendFile file = AppendFile::create(log_);
  file.sync();
  std::filesystem::rename(log_, folder_ / "b_log.reach");
  EXPECT_EQ(refusalOf([&] { file.sync(); }), words);
  writeFileAtomically(log_, "another file of the same name");
  EXPECT_EQ(refusalOf([&] { file.sync(); }), words);
  std::filesystem::remove(log_);
  std::filesystem::rename(folder_ / "b_log.reach", log_);
  EXPECT_NO_THROW(file.sync());
}

TEST(AtomicFile, TakesItsNameOnlyWhenItIsWhole) {
  const TemporaryFolder folder;
  const std::string path = folder / "sub/table.tsv";
  std::string whole;
  {
    AtomicFile file(path);
    for (int i = 0; i < 30; ++i) {  // in pieces, of which some are larger than what is gathered for a write
      const std::string piece(static_cast<std::size_t>(i * i * 113), static_cast<char>('a' + i % 26));
      whole += piece;
      file.append(piece);
    }
    EXPECT_FALSE(std::filesystem::exists(path));
    file.commit();
  }
  EXPECT_EQ(readWholeFile(path), whole);
  {
    AtomicFile given(path);
    given.append("half");
  }
  EXPECT_EQ(readWholeFile(path), whole) << "never committed";
  EXPECT_EQ(countFiles(folder / ""), 1u) << "and nothing is left of it";
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  EXPECT_EQ(status.st_mode & 0777, 0644u & ~mask);
}

TEST(AtomicFile, OneThatCannotBeWrittenLeavesTheOldOne) {
  const TemporaryFolder folder;
  const std::string path = folder / "table.tsv";
  writeFileAtomically(path, "old");
  {
    const FileLimit limit(1000);
    EXPECT_EQ(refusalOf([&] { writeFileAtomically(path, std::string(1001, 'n')); }),
              path + ": cannot be written: File too large; " + kTooLarge);
    EXPECT_EQ(readWholeFile(path), "old");
    EXPECT_EQ(countFiles(folder / ""), 1u);
    writeFileAtomically(path, std::string(1000, 'n'));
  }
  EXPECT_EQ(readWholeFile(path), std::string(1000, 'n'));
}

// The renamed file would stand in the place of /dev/null.
TEST(AtomicFile, CannotTakeTheNameOfAFolderOrADevice) {
  const TemporaryFolder folder;
  const std::string path = folder / "table.tsv", pipe = folder / "pipe";
  std::filesystem::create_directories(path + "/inside");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& name : {path, pipe}) {
    const std::string refusal = name + ": cannot be written: is no regular file; choose a file on a disk";
    EXPECT_EQ(refusalOf([&] { writeFileAtomically(name, "new"); }), refusal);
    EXPECT_EQ(refusalOf([&] { ForeignFile{name}; }), refusal);
  }
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_EQ(countFiles(folder / ""), 0u);
}

TEST(AtomicFile, AFolderThatIsAFileIsTold) {
  const TemporaryFolder folder;
  const std::string file = folder / "file";
  writeFileAtomically(file, "x");
  EXPECT_EQ(refusalOf([&] { writeFileAtomically(file + "/table.tsv", "new"); }),
            file + ": cannot be made: Not a directory; check the folder and its permissions");
  EXPECT_NO_THROW(makeFolders(""));
  EXPECT_NO_THROW(makeFolders(folder / "a/b"));
  EXPECT_NO_THROW(makeFolders(folder / "a/b")) << "they are there already";
}

TEST(ForeignFile, TakesItsNameWhenItIsCommitted) {
  const TemporaryFolder folder;
  const std::string path = folder / "sub/run.mat";
  {
    ForeignFile file(path);
    std::ofstream(file.temporary()) << "by a library";
    EXPECT_FALSE(std::filesystem::exists(path));
    file.commit();
    EXPECT_EQ(readWholeFile(path), "by a library");
  }
  EXPECT_EQ(countFiles(folder / ""), 1u);
  {
    ForeignFile file(path);
    std::ofstream(file.temporary()) << "half";
    EXPECT_EQ(refusalOf([&] { file.giveUp("the library failed"); }),
              path + ": cannot be written: the library failed; check the folder and the space on its disk");
  }
  {
    ForeignFile file(path);
    const FileLimit limit(1000);
    EXPECT_EQ(refusalOf([&] { file.giveUp("the library failed"); }), path + ": cannot be written: File too large; " + kTooLarge);
  }
  EXPECT_EQ(readWholeFile(path), "by a library");
  EXPECT_EQ(countFiles(folder / ""), 1u);
}

TEST(ReadWholeFile, GivesEveryByte) {
  const TemporaryFolder folder;
  const std::string path = folder / "file";
  std::string bytes;
  for (int i = 0; i < 100'000; ++i) bytes.push_back(static_cast<char>(i * 37 >> 3));
  for (const std::string& content : {bytes, std::string(), std::string(1, '\0')}) {
    writeFileAtomically(path, content);
    EXPECT_EQ(readWholeFile(path), content);
  }
}

TEST(ReadWholeFile, RefusesWhatIsNotThereNoFileOrTooLarge) {
  const TemporaryFolder folder;
  const std::string path = folder / "file";
  EXPECT_EQ(refusalOf([&] { readWholeFile(path); }), path + ": cannot be read: No such file or directory");
  EXPECT_EQ(refusalOf([&] { readWholeFile(folder / ""); }), (folder / "").string() + ": is no regular file; allowed: a file on a disk");
  writeFileAtomically(path, "");
  std::filesystem::resize_file(path, (1u << 30) + 1);  // takes no room on the disk
  EXPECT_EQ(refusalOf([&] { readWholeFile(path); }), path + ": has 1073741825 bytes; allowed: up to 1073741824");
}

TEST(Leftovers, AreFilesOfTheirNameThatAreOlderThanTenMinutes) {
  const TemporaryFolder folder;
  const std::string name = "/.0123456789abcdef.reachlab-tmp";
  const auto now = std::filesystem::file_time_type::clock::now();
  std::map<std::string, bool> stays;
  const auto put = [&](const std::string& file, std::chrono::seconds age, bool staying) {
    writeFileAtomically(folder / file, "part");
    std::filesystem::last_write_time(folder / file, now - age);
    stays[file] = staying;
  };
  using std::chrono::minutes;
  put("young" + name, minutes(9), true);
  put("old" + name, minutes(11), false);
  put("deep/down" + name, minutes(60), false);
  put("shown/0123456789abcdef.reachlab-tmp", minutes(60), true);
  put("other/.0123456789abcdef.tmp", minutes(60), true);
  std::filesystem::create_directories(folder / ("folder" + name));
  std::filesystem::last_write_time(folder / ("folder" + name), now - minutes(60));
  removeLeftovers(folder / "");
  for (const auto& [file, staying] : stays) EXPECT_EQ(std::filesystem::exists(folder / file), staying) << file;
  EXPECT_TRUE(std::filesystem::exists(folder / ("folder" + name)));
  EXPECT_NO_THROW(removeLeftovers(folder / "nothing"));
}

}  // namespace
}  // namespace reachlab::record
