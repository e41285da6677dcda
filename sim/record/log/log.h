#pragma once
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/record/log/append_file.h"

/// The append-only log of one run (docs/recording.md has it byte by byte). All numbers little-endian.
///
///     file   = "REACHLOG" | u32 schema version | u32 CRC-32 of the twelve bytes before | record*
///     record = u32 payload length | u16 type | u16 zero | u32 sequence number, from 0 | payload | u32 CRC-32 of all before in
///     this record
///
/// A record counts only if its CRC, its sequence number and its type are right. Reading ends at the first wrong record. A flipped bit, a
/// cut, zeros or a repeated part can end a log early, but never change a number in it.
namespace reachlab::record {

inline constexpr std::string_view kLogEnding = "_log.reach";  // of the file's name
inline constexpr std::uint32_t kLogSchemaVersion = 2;
inline constexpr std::size_t kLogHeaderBytes = 16;
inline constexpr std::size_t kRecordHeaderBytes = 12;
inline constexpr std::size_t kRecordFrameBytes = kRecordHeaderBytes + 4;
inline constexpr std::uint32_t kMaxPayloadBytes = 64u << 20;

enum class RecordType : std::uint16_t {
  Configuration = 1,  // JSON text of RunConfiguration, always the first record
  Ticks = 2,          // every tick's raw device input and command
  Samples = 3,        // rows of derived channels
  Event = 4,          // one thing that happened at a tick
  Trial = 5,          // a trial's result
  End = 6,            // the run was closed in order; where the last trial record lies
  TrialSetup = 7,     // a trial is about to be put up
  HandTicks = 8,      // a further hand's raw device input for the ticks of the Ticks record before
  PeerTicks = 9,      // what other stations' samples were in force at those ticks
};

inline std::string_view asText(std::span<const std::uint8_t> bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }
inline std::span<const std::uint8_t> asBytes(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Bytes of a payload that is written or read, little-endian. Reading past the end gives zeros and clears `ok`.
class ByteWriter {
 public:
  template <typename T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  void putText(std::string_view text);  // u32 length, then UTF-8
  void putBytes(const void* data, std::size_t size);
  template <typename T>
  void overwrite(std::size_t at, T value) {
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  void clear() { bytes_.clear(); }
  void reserve(std::size_t size) { bytes_.reserve(size); }
  std::size_t size() const { return bytes_.size(); }
  std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <typename T>
  T get() {
    static_assert(std::is_arithmetic_v<T>);
    T value{};
    if (left() < sizeof value) return fail(), value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::string getText();
  bool ok() const { return ok_; }
  /// Nothing more is read, and the bytes are not ok.
  void fail() {
    ok_ = false;
    at_ = bytes_.size();
  }
  std::size_t left() const { return bytes_.size() - at_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

/// Appends records to a new log. Move-only. One thread at a time. Every member may throw ResourceError ("disk full …").
class LogWriter {
 public:
  /// Creates the file with its header. A file that exists is refused (ResourceError).
  static LogWriter create(const std::string& path);
  /// Hands the record to the kernel in one write and returns its offset in the file. A write cut short by a full disk is taken
  /// back, so that the log still ends with a good record.
  std::uint64_t append(RecordType type, std::span<const std::uint8_t> payload);
  /// The records so far survive a power cut once this returns.
  void sync() { file_.sync(); }
  std::uint64_t size() const { return file_.size(); }
  std::uint32_t nextSequence() const { return sequence_; }
  const std::string& path() const { return file_.path(); }

 private:
  explicit LogWriter(AppendFile file) : file_(std::move(file)) {}
  AppendFile file_;
  std::uint32_t sequence_ = 0;
  ByteWriter frame_;
};

/// One good record where it lies in the file.
struct RecordView {
  RecordType type{};
  std::uint32_t sequence = 0;
  std::uint64_t offset = 0;               // of its header in the file
  std::span<const std::uint8_t> payload;  // into the reader's memory, until its next member is called
};

/// Reads a log through a window onto the file, not through a map. A log that another program cuts short meanwhile ends early, where a map
/// would end the program. Any thread, one at a time. Records are checked as they are read. If the disk cannot be read, any member throws
/// ResourceError.
class LogReader {
 public:
  /// Throws FaultError when the file is no log or of a newer schema, ResourceError when it cannot be opened.
  explicit LogReader(const std::string& path);

  /// The next good record. False at the end or at the first damage (`goodEnd() < fileSize()` tells them apart).
  bool next(RecordView& record);
  /// Continues reading at `offset`, where record number `sequence` is expected (from an index).
  void seek(std::uint64_t offset, std::uint32_t sequence);
  /// Reads a good record of that type and length at `offset`, whatever its number. False if there is no such record.
  bool readAt(std::uint64_t offset, RecordType type, std::uint32_t length, RecordView& record);
  /// Where the last good record that was read ends.
  std::uint64_t goodEnd() const { return at_; }
  std::uint32_t nextSequence() const { return sequence_; }
  std::uint64_t fileSize() const { return size_; }
  const std::string& path() const { return path_; }

 private:
  std::span<const std::uint8_t> bytesAt(std::uint64_t offset, std::size_t size);

  std::string path_;
  os::Descriptor descriptor_;
  std::uint64_t size_ = 0;               // of the file when it was opened
  std::vector<std::uint8_t> window_;     // the part of the file that was read last,
  std::uint64_t windowBegin_ = 0;        // and where it begins
  std::size_t ahead_ = kLogHeaderBytes;  // how much to read at a time: more while reading on, little after a seek
  std::uint64_t at_ = kLogHeaderBytes;
  std::uint32_t sequence_ = 0;
};

}  // namespace reachlab::record
