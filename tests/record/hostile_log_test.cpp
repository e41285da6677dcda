// What is in a log is the word of whoever made the file: every record here has its right CRC and says something that no recording of ours does.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/fault.h"
#include "base/system/os.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/disk_fault.h"
#include "sim/record/log/records.h"
#include "sim/record/log/run_writer.h"
#include "sim/record/log/whole_file.h"
#include "sim/record/recover.h"
#include "sim/record/replay.h"
#include "tests/in_a_folder.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace {
bool diskIsFull = false;
}  // namespace

/// In the place of the C library's.
extern "C" int statvfs(const char* path, struct statvfs* disk) noexcept {
  struct statfs real {};
  if (::statfs(path, &real) != 0) return -1;
  *disk = {};
  disk->f_frsize = static_cast<unsigned long>(real.f_bsize);
  disk->f_blocks = real.f_blocks;
  disk->f_bavail = diskIsFull ? 0 : real.f_bavail;
  return 0;
}

namespace reachlab::record {
namespace {

using nlohmann::json;

// A log whose configuration is `edit`ed; the other records are those of a good one.
template <typename Edit>
std::string logWith(const TemporaryFolder& folder, Edit&& edit) {
  const std::string good = folder / "good_log.reach", path = folder / "edited_log.reach";
  if (!std::filesystem::exists(good)) writeMadeRun(good, 2);
  json j = json::parse(toJson(madeConfiguration()));
  edit(j);
  copyLogAs(good, path, j.dump());
  return path;
}

void expectRefusal(const std::string& path, const std::string& key) {
  const std::string said = toText(faultsToldBy([&] { RunLog::open(path); }));
  EXPECT_TRUE(said.starts_with(path)) << key << ": " << said;
  EXPECT_TRUE(holds(said, key));
  EXPECT_FALSE(holds(said, "json.exception"));
}

class HostileLog : public InAFolder {};

TEST_F(HostileLog, AnEditedButHonestConfigurationIsRead) {
  EXPECT_EQ(RunLog::open(logWith(folder_, [](json& j) { j["run"] = 7; })).configuration().run, 7);
}

TEST_F(HostileLog, LabelsAreLabelsBecauseTheyBecomeNamesOfFiles) {
  for (const char* key : {"subject", "session", "task"})
    for (const char* label : {"x/../../escaped", "", "..", "a b", "a\nb", "\x1b[31m", "/etc"})
      expectRefusal(logWith(folder_, [&](json& j) { j[key] = label; }), key);
  expectRefusal(logWith(folder_, [](json& j) { j["subject"] = std::string(300, 'a'); }), "subject");
}

// The place of a value in the configuration, the value that is put there, and what its refusal names.
TEST_F(HostileLog, EveryNumberIsWithinItsBoundsAndTheTableHasTheChannelsThatItsCountsAskFor) {
  const json cases = json::parse(R"([["/run", 0, "run"], ["/run", -3, "run"], ["/run", 100000, "run"], ["/run", 1e300, "run"],
    ["/run", 2.5, "run"], ["/run", "1", "run"], ["/run", null, "run"], ["/first_run", -1, "first_run"], ["/first_trial", 0, "first_trial"],
    ["/first_trial", 5e9, "first_trial"], ["/block", -1, "block"], ["/day", -1, "day"], ["/pause_s", -1, "pause_s"], ["/seed", -1, "seed"],
    ["/seed", 1e30, "seed"], ["/sampling_hz", 0, "sampling_hz"], ["/sampling_hz", -1, "sampling_hz"],
    ["/device_max_force_n", -1, "device_max_force_n"], ["/sample_every_ticks", 0, "sample_every_ticks"],
    ["/sample_every_ticks", 4294967297, "sample_every_ticks"], ["/practice", 1, "practice"], ["/notes", 3, "notes"], ["/trials", 7, "trials"],
    ["/participant", "F", "participant"], ["/trials", [{"index": -1, "foreperiod_ms": 0, "catch": false}], "index"],
    ["/table", 3, "table: is no object"], ["/table/mass_count", 2000000000, "mass_count"], ["/table/mass_count", -1, "mass_count"],
    ["/table/mass_count", 3, "channels"], ["/table/parameter_count", 50, "parameter_count"], ["/table/parameter_count", 4, "parameter_count"],
    ["/table/parameter_count", 2, "channels"], ["/table/body", true, "channels"], ["/table/channels", [], "channels"],
    ["/table/channels/0/name", 5, "name"]])");
  for (const json& c : cases)
    expectRefusal(logWith(folder_, [&](json& j) { j[json::json_pointer(c[0].get<std::string>())] = c[1]; }), c[2]);
  expectRefusal(logWith(folder_, [](json& j) { j.erase("clock"); }), "clock: is missing");
}

TEST_F(HostileLog, ATextThatIsNoJsonIsRefusedInWords) {
  for (const std::string text : {"", "[1]", "{\"run\": ", "\"run\"", "\xff\xfe"}) {
    const std::string path = folder_ / "text_log.reach";
    std::filesystem::remove(path);
    LogWriter::create(path).append(RecordType::Configuration, asBytes(text));
    expectRefusal(path, "configuration");
  }
}

// A record of this type with these bytes after the configuration of a good log.
std::string logWithRecord(const TemporaryFolder& folder, RecordType type, const ByteWriter& payload) {
  const std::string path = folder / "record_log.reach";
  std::filesystem::remove(path);
  LogWriter writer = LogWriter::create(path);
  writer.append(RecordType::Configuration, asBytes(toJson(madeConfiguration())));
  writer.append(type, payload.bytes());
  return path;
}

TEST_F(HostileLog, CountsOfSamplesThatOverflowTheirProductAreRefused) {
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> cases{
      {0x80000000u, 0x1fffffffu}, {0xffffffffu, 0xffffffffu}, {1u << 31, (1u << 30) - 1}, {1, 0}, {0xffffffffu, 0}, {3, 46}};
  for (const auto& [count, columns] : cases) {
    ByteWriter payload;
    payload.put(count);
    payload.put(columns);
    const RunLog log = RunLog::open(logWithRecord(folder_, RecordType::Samples, payload));
    EXPECT_THROW(log.allRows(), FaultError) << count << " x " << columns;
  }
}

TEST_F(HostileLog, TrialsAndEventsOfUnknownKindsAreRefused) {
  ByteWriter trial, event;
  encode(RecordedTrial{}, {}, trial);
  trial.overwrite(13, std::uint8_t{200});  // the outcome, behind the trial's setup
  EXPECT_THROW(RunLog::open(logWithRecord(folder_, RecordType::Trial, trial)), FaultError);
  encode(RecordedEvent{1, static_cast<EventKind>(99), 1, 0, "x"}, event);
  EXPECT_THROW(RunLog::open(logWithRecord(folder_, RecordType::Event, event)), FaultError);
}

TEST_F(HostileLog, OneThatIsCutShortWhileItIsReadEndsEarly) {
  const std::string path = folder_ / "cut_log.reach";
  writeMadeRun(path, 40);
  const RunLog log = RunLog::open(path);
  LogReader reader(path);
  RecordView record;
  ASSERT_TRUE(reader.next(record));
  ASSERT_EQ(::truncate(path.c_str(), 20'000), 0);
  while (reader.next(record)) {}
  EXPECT_LE(reader.goodEnd(), 1u << 20) << "what had been read before may still be given";
  EXPECT_THROW(log.allRows(), FaultError);
}

TEST_F(HostileLog, WhatIsNoRegularFileIsRefusedWithoutWaiting) {
  const std::string pipe = folder_ / "pipe_log.reach";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(RunLog::open(pipe), FaultError);
  EXPECT_THROW(RunLog::open("/dev/zero"), FaultError);
  EXPECT_THROW(readWholeFile(pipe), ResourceError);
  EXPECT_THROW(readWholeFile("/dev/zero"), ResourceError);
}

TEST(AtomicFile, IsNotWrittenThroughALinkThatSomebodyPlanted) {
  const TemporaryFolder folder;
  const std::string outside = folder / "outside", target = folder / "table.tsv";
  writeFileAtomically(outside, "precious");
  // The name that was guessable, and the target itself.
  std::filesystem::create_symlink(outside, target + "." + std::to_string(::getpid()) + ".tmp");
  std::filesystem::create_symlink(outside, target);
  writeFileAtomically(target, "new");
  EXPECT_EQ(readWholeFile(outside), "precious");
  EXPECT_EQ(readWholeFile(target), "new");
  EXPECT_FALSE(std::filesystem::is_symlink(target));
}

TEST(Recorder, SaysHowMuchIsLeftOfTheDiskAndHowMuchOfItIsKeptFree) {
  constexpr std::uint64_t kMega = 1'000'000;
  EXPECT_EQ(reserveFault("a.reach", {500 * kMega, 100'000 * kMega}, 500 * kMega), "");
  EXPECT_EQ(
      reserveFault("a.reach", {123 * kMega, 100'000 * kMega}, 500 * kMega),
      "a.reach: 123 MB are left on the disk, less than the 500 MB that are kept free; what was recorded is safe: free space, keep less "
      "free, or choose another folder");
  EXPECT_EQ(reserveFault("a.reach", {5 * kMega, 100 * kMega}, 500 * kMega), "") << "a twentieth of a small disk is enough";
  EXPECT_TRUE(
      reserveFault("a.reach", {4 * kMega, 100 * kMega}, 500 * kMega).starts_with("a.reach: 4 MB are left on the disk, less than the 5 MB"));
  EXPECT_EQ(reserveFault("a.reach", {}, 500 * kMega), "") << "a disk of which nothing is known";
}

TEST(Recorder, StopsBeforeTheDiskIsFull) {
  const TemporaryFolder folder;
  const std::string path = folder / "a_log.reach";
  diskIsFull = true;
  const std::string said = refusalOf<ResourceError>([&] { Recorder(path, madeConfiguration(), {.threaded = false}); });
  diskIsFull = false;
  EXPECT_TRUE(holds(said, path + ": 0 MB are left on the disk"));
  EXPECT_FALSE(std::filesystem::exists(path)) << "it would take a run's number";
}

}  // namespace
}  // namespace reachlab::record
