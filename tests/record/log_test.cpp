// The log's frame byte by byte as docs/recording.md has it, and how it is read.
#include "sim/record/log/log.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/fault.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/whole_file.h"
#include "tests/in_a_folder.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

namespace reachlab::record {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes payloadOf(std::size_t size, std::uint8_t first = 1) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(first + i * 7);
  return bytes;
}

template <typename Number>
Number numberAt(const std::string& bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

std::uint32_t crcOf(const std::string& bytes, std::size_t from, std::size_t size) {
  return static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(bytes.data() + from), static_cast<uInt>(size)));
}

// A log of these payloads, alternately of ticks and of samples.
std::vector<std::uint64_t> writeLog(const std::string& path, const std::vector<Bytes>& payloads) {
  LogWriter writer = LogWriter::create(path);
  std::vector<std::uint64_t> offsets;
  for (std::size_t i = 0; i < payloads.size(); ++i)
    offsets.push_back(writer.append(i % 2 == 0 ? RecordType::Ticks : RecordType::Samples, payloads[i]));
  return offsets;
}

void overwriteByte(const std::string& path, std::size_t at, std::uint8_t value) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(at));
  file.put(static_cast<char>(value));
}

// With a CRC that is right.
void sealRecord(const std::string& path, std::size_t offset) {
  const std::string bytes = readWholeFile(path);
  const std::size_t whole = 12 + numberAt<std::uint32_t>(bytes, offset);
  const std::uint32_t crc = crcOf(bytes, offset, whole);
  for (std::size_t i = 0; i < 4; ++i) overwriteByte(path, offset + whole + i, static_cast<std::uint8_t>(crc >> 8 * i));
}

TEST(ByteReader, GivesWhatAWriterPutAndZerosBehindIt) {
  ByteWriter out;
  out.put(std::uint16_t{0x1234});
  out.putText("reach");
  out.put(2.5);
  out.overwrite(0, std::uint16_t{0x4321});
  EXPECT_EQ(out.size(), 2u + 4 + 5 + 8);
  EXPECT_EQ(out.bytes()[0], 0x21) << "little-endian";
  ByteReader in(out.bytes());
  EXPECT_EQ(in.left(), 19u);
  EXPECT_EQ(in.get<std::uint16_t>(), 0x4321);
  EXPECT_EQ(in.getText(), "reach");
  EXPECT_EQ(in.left(), 8u);
  EXPECT_EQ(in.get<double>(), 2.5);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.left(), 0u);
  EXPECT_EQ(in.get<std::uint8_t>(), 0);
  EXPECT_FALSE(in.ok());
}

TEST(ByteReader, ReadsNothingMoreAfterItWasAskedForMoreThanThereIs) {
  ByteWriter out;
  out.put(std::uint32_t{0xffffffff});
  out.put(std::uint16_t{7});
  ByteReader number(out.bytes());
  number.get<std::uint32_t>();
  EXPECT_EQ(number.get<std::uint32_t>(), 0u);
  EXPECT_EQ(number.left(), 0u);
  EXPECT_EQ(number.get<std::uint16_t>(), 0u) << "nor what would have fitted";
  ByteReader text(out.bytes());
  EXPECT_EQ(text.getText(), "");
  EXPECT_FALSE(text.ok());
  EXPECT_EQ(text.left(), 0u);
  ByteWriter empty;
  empty.putText("");
  ByteReader none(empty.bytes());
  EXPECT_EQ(none.getText(), "");
  EXPECT_TRUE(none.ok()) << "a text of no characters is one";
}

class WrittenLog : public InAFolder {};

TEST_F(WrittenLog, WritesHeaderAndRecordsByteByByteAsDocumented) {
  {
    LogWriter writer = LogWriter::create(log_);
    EXPECT_EQ(writer.size(), 16u);
    EXPECT_EQ(writer.append(RecordType::Event, payloadOf(5)), 16u);
    EXPECT_EQ(writer.nextSequence(), 1u);
    EXPECT_EQ(writer.append(RecordType::PeerTicks, {}), 16u + 21);
    EXPECT_EQ(writer.nextSequence(), 2u);
    EXPECT_EQ(writer.size(), 16u + 21 + 16);
    EXPECT_EQ(writer.path(), log_);
  }
  const std::string bytes = readWholeFile(log_);
  ASSERT_EQ(bytes.size(), 53u);
  EXPECT_EQ(bytes.substr(0, 8), "REACHLOG");
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 8), 2u);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 12), crcOf(bytes, 0, 12));
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 16), 5u);
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 20), 4u);
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 22), 0u);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 24), 0u);
  EXPECT_EQ(bytes.substr(28, 5), (std::string{1, 8, 15, 22, 29}));
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 33), crcOf(bytes, 16, 17));
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 37), 0u);
  EXPECT_EQ(numberAt<std::uint16_t>(bytes, 41), 9u);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 45), 1u);
  EXPECT_EQ(numberAt<std::uint32_t>(bytes, 49), crcOf(bytes, 37, 12));
}

TEST_F(WrittenLog, ARecordHolds64MiBAndNoByteMore) {
  LogWriter writer = LogWriter::create(log_);
  const Bytes most(64u << 20, 5);
  Bytes more = most;
  more.push_back(5);
  EXPECT_EQ(refusalOf([&] { writer.append(RecordType::Samples, more); }),
            log_ + ": a record of 67108865 bytes; allowed: up to 67108864: plan fewer trials a run");
  EXPECT_EQ(writer.size(), 16u);
  writer.append(RecordType::Samples, most);
  LogReader reader(log_);
  RecordView record;
  ASSERT_TRUE(reader.next(record));
  EXPECT_EQ(record.payload.size(), most.size());
}

class ReadLog : public InAFolder {};

TEST_F(ReadLog, GivesEveryRecordWhereverTheWindowOntoTheFileEnds) {
  std::vector<Bytes> payloads;
  for (std::size_t i = 0; i < 60; ++i)
    payloads.push_back(payloadOf(i * i * 97 % 5003 + (i == 40 ? 300'000 : 0), static_cast<std::uint8_t>(i)));
  const auto offsets = writeLog(log_, payloads);
  LogReader reader(log_);
  const auto expectNext = [&](std::size_t i) {
    SCOPED_TRACE(i);
    RecordView record;
    EXPECT_EQ(reader.nextSequence(), i);
    ASSERT_TRUE(reader.next(record));
    EXPECT_EQ(record.type, i % 2 == 0 ? RecordType::Ticks : RecordType::Samples);
    EXPECT_EQ(record.sequence, i);
    EXPECT_EQ(record.offset, offsets[i]);
    EXPECT_TRUE(std::equal(record.payload.begin(), record.payload.end(), payloads[i].begin(), payloads[i].end()));
    EXPECT_EQ(reader.goodEnd(), i + 1 < offsets.size() ? offsets[i + 1] : reader.fileSize());
  };
  const auto expectAt = [&](std::size_t i) {
    reader.seek(offsets[i], static_cast<std::uint32_t>(i));
    expectNext(i);
  };
  for (std::size_t i = 0; i < payloads.size(); ++i) expectNext(i);
  RecordView none;
  EXPECT_FALSE(reader.next(none));
  for (std::size_t i = payloads.size(); i-- > 0;) expectAt(i);  // from the last to the first, as the chain of trials is read
  for (std::size_t i = 0; i < payloads.size(); ++i) expectAt(i * 23 % payloads.size());
  EXPECT_EQ(reader.path(), log_);
  EXPECT_EQ(reader.fileSize(), std::filesystem::file_size(log_));
}

TEST_F(ReadLog, ARecordIsReadWhereOneOfItsTypeAndLengthLies) {
  const auto offsets = writeLog(log_, {payloadOf(10), payloadOf(20), payloadOf(0)});
  LogReader reader(log_);
  RecordView record;
  EXPECT_TRUE(reader.readAt(offsets[1], RecordType::Samples, 20, record));
  EXPECT_EQ(record.offset, offsets[1]);
  EXPECT_EQ(record.sequence, 1u);
  EXPECT_FALSE(reader.readAt(offsets[1], RecordType::Samples, 21, record));
  EXPECT_FALSE(reader.readAt(offsets[1], RecordType::Ticks, 20, record));
  EXPECT_FALSE(reader.readAt(offsets[1] + 1, RecordType::Samples, 20, record));
  EXPECT_TRUE(reader.readAt(offsets[2], RecordType::Ticks, 0, record)) << "the last one, of no payload";
  EXPECT_FALSE(reader.readAt(reader.fileSize() - 15, RecordType::Ticks, 0, record)) << "reaches beyond the end";
  overwriteByte(log_, offsets[1] + 6, 1);
  EXPECT_FALSE(LogReader(log_).readAt(offsets[1], RecordType::Samples, 20, record)) << "the two bytes behind the type are zero";
}

TEST_F(ReadLog, EndsAtTheFirstRecordThatIsNotRight) {
  const auto readable = [&] {
    LogReader reader(log_);
    RecordView record;
    std::size_t count = 0;
    while (reader.next(record)) ++count;
    return count;
  };
  // Each with a CRC that is right: type, zero and sequence number are looked at for themselves.
  struct Wrong {
    std::size_t at;
    std::uint8_t value;
    std::size_t good;
  };
  for (const Wrong& wrong :
       {Wrong{4, 0, 1}, {4, 1, 3}, {4, 9, 3}, {4, 10, 1}, {5, 1, 1}, {6, 1, 1}, {7, 1, 1}, {8, 0, 1}, {8, 2, 1}, {11, 1, 1}}) {
    std::filesystem::remove(log_);
    const auto offsets = writeLog(log_, {payloadOf(10), payloadOf(20), payloadOf(30)});
    overwriteByte(log_, offsets[1] + wrong.at, wrong.value);
    EXPECT_EQ(readable(), 1u) << "a wrong CRC";
    sealRecord(log_, offsets[1]);
    EXPECT_EQ(readable(), wrong.good) << "byte " << wrong.at << " is " << int{wrong.value};
  }
}

TEST_F(ReadLog, ALengthBeyondTheFileOrTheBoundIsTheEnd) {
  const auto offsets = writeLog(log_, {payloadOf(10), payloadOf(20)});
  for (const int highest : {1, 4, 5, 255}) {  // of four bytes: 16 MiB and more, 64 MiB and more, nearly 4 GiB
    overwriteByte(log_, offsets[1] + 3, static_cast<std::uint8_t>(highest));
    LogReader reader(log_);
    RecordView record;
    EXPECT_TRUE(reader.next(record));
    EXPECT_FALSE(reader.next(record));
    EXPECT_EQ(reader.goodEnd(), offsets[1]);
  }
}

TEST_F(ReadLog, OneThatIsMovedReadsOn) {
  const std::string other = folder_ / "b_log.reach";
  const auto offsets = writeLog(log_, {payloadOf(10), payloadOf(20), payloadOf(30)});
  writeLog(other, {payloadOf(1)});
  LogReader first(log_);
  RecordView record;
  ASSERT_TRUE(first.next(record));
  LogReader second(std::move(first));
  ASSERT_TRUE(second.next(record));
  EXPECT_EQ(record.payload.size(), 20u);
  LogReader third(other);
  third = std::move(second);
  EXPECT_EQ(third.path(), log_);
  EXPECT_EQ(third.goodEnd(), offsets[2]);
  EXPECT_EQ(third.nextSequence(), 2u);
  ASSERT_TRUE(third.next(record));
  EXPECT_EQ(record.payload.size(), 30u);
  EXPECT_EQ(third.goodEnd(), third.fileSize());
}

TEST_F(ReadLog, RefusesWhatIsNoLogInWords) {
  const auto refusal = [&] { return refusalOf([&] { const LogReader reader(log_); }, log_ + "opened").substr(log_.size()); };
  EXPECT_EQ(refusal(), ": cannot be opened: No such file or directory");
  const std::string damaged = ": not a log of reachlab, or its first 16 bytes are damaged";
  writeFileAtomically(log_, "");
  EXPECT_EQ(refusal(), damaged);
  writeFileAtomically(log_, "REACHLOG");
  EXPECT_EQ(refusal(), damaged);
  std::filesystem::remove(log_);
  writeLog(log_, {});
  const std::string header = readWholeFile(log_);
  ASSERT_EQ(header.size(), 16u);
  EXPECT_EQ(refusal(), "opened") << "a log of no record";
  for (std::size_t at = 0; at < header.size(); ++at) {
    std::string other = header;
    other[at] = static_cast<char>(other[at] ^ 1);
    writeFileAtomically(log_, other);
    EXPECT_EQ(refusal(), damaged) << "byte " << at;
  }
  for (const int version : {1, 3}) {
    std::string other = header;
    other[8] = static_cast<char>(version);
    const std::uint32_t crc = crcOf(other, 0, 12);
    std::memcpy(other.data() + 12, &crc, 4);
    writeFileAtomically(log_, other);
    EXPECT_EQ(refusal(), ": log of schema version " + std::to_string(version) + "; allowed: 2, the version that this program reads");
  }
  std::filesystem::remove(log_);
  std::filesystem::create_directory(log_);
  EXPECT_EQ(refusal(), ": no regular file, so no log of reachlab");
}

}  // namespace
}  // namespace reachlab::record
