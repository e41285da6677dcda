#include "sim/record/log/log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>

#include "base/error.h"
#include "base/fault.h"
#include "sim/record/log/checksum.h"

namespace reachlab::record {

static_assert(std::endian::native == std::endian::little, "the log is written as it lies in memory");

namespace {

constexpr std::size_t kMinAhead = 4096, kMaxAhead = 1 << 20;

constexpr std::array<char, 8> kSignature{'R', 'E', 'A', 'C', 'H', 'L', 'O', 'G'};

template <typename T>
T load(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

bool isKnown(std::uint16_t type) {
  return type >= static_cast<std::uint16_t>(RecordType::Configuration) && type <= static_cast<std::uint16_t>(RecordType::PeerTicks);
}

}  // namespace

void ByteWriter::putText(std::string_view text) {
  put(static_cast<std::uint32_t>(text.size()));
  putBytes(text.data(), text.size());
}

void ByteWriter::putBytes(const void* data, std::size_t size) {
  const auto* first = static_cast<const std::uint8_t*>(data);
  bytes_.insert(bytes_.end(), first, first + size);
}

std::string ByteReader::getText() {
  const auto size = get<std::uint32_t>();
  if (size > left()) return fail(), std::string();
  std::string text(reinterpret_cast<const char*>(bytes_.data() + at_), size);
  at_ += size;
  return text;
}

LogWriter LogWriter::create(const std::string& path) {
  LogWriter writer(AppendFile::create(path));
  ByteWriter header;
  header.putBytes(kSignature.data(), kSignature.size());
  header.put(kLogSchemaVersion);
  header.put(checksum(header.bytes().data(), header.size()));
  writer.file_.append(header.bytes());
  return writer;
}

std::uint64_t LogWriter::append(RecordType type, std::span<const std::uint8_t> payload) {
  if (payload.size() > kMaxPayloadBytes)
    throw FaultError(fileFault(path(), fmt::format("a record of {} bytes", payload.size()),
                               fmt::format("up to {}: plan fewer trials a run", kMaxPayloadBytes)));
  frame_.clear();
  frame_.put(static_cast<std::uint32_t>(payload.size()));
  frame_.put(static_cast<std::uint16_t>(type));
  frame_.put(std::uint16_t{0});
  frame_.put(sequence_);
  frame_.putBytes(payload.data(), payload.size());
  frame_.put(checksum(frame_.bytes().data(), frame_.size()));
  const std::uint64_t offset = file_.size();
  file_.append(frame_.bytes());
  ++sequence_;
  return offset;
}

// Without O_NONBLOCK opening a pipe would wait for somebody to write into it.
LogReader::LogReader(const std::string& path) : path_(path), descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0) throw ResourceError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode))
    throw FaultError(fileFault(path, "no regular file, so no log of reachlab"));
  size_ = static_cast<std::uint64_t>(status.st_size);
  const std::span<const std::uint8_t> header = bytesAt(0, kLogHeaderBytes);
  const bool signature = !header.empty() && std::memcmp(header.data(), kSignature.data(), kSignature.size()) == 0 &&
                         checksum(header.data(), 12) == load<std::uint32_t>(header.data() + 12);
  if (!signature) throw FaultError(fileFault(path, "not a log of reachlab, or its first 16 bytes are damaged"));
  if (const auto version = load<std::uint32_t>(header.data() + 8); version != kLogSchemaVersion)
    throw FaultError(fileFault(path, fmt::format("log of schema version {}", version),
                               fmt::format("{}, the version that this program reads", kLogSchemaVersion)));
}

// `size` bytes of the file, or none when it does not reach that far (any more). Throws ResourceError when the disk cannot be read.
std::span<const std::uint8_t> LogReader::bytesAt(std::uint64_t offset, std::size_t size) {
  if (offset > size_ || size > size_ - offset) return {};
  const auto inWindow = [&] { return offset >= windowBegin_ && offset + size <= windowBegin_ + window_.size(); };
  if (!inWindow()) {
    const bool backwards = offset < windowBegin_;
    const std::uint64_t length = std::min<std::uint64_t>(std::max(size, ahead_), size_);
    const std::uint64_t begin = backwards ? offset + size - std::min(offset + size, length) : offset;
    window_.resize(static_cast<std::size_t>(std::min(length, size_ - begin)));
    windowBegin_ = begin;
    std::size_t done = 0;
    while (done < window_.size()) {
      const ssize_t count = ::pread(descriptor_, window_.data() + done, window_.size() - done, static_cast<off_t>(begin + done));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) {
        window_.clear();
        throw ResourceError(fmt::format("{}: cannot be read at byte {}: {}; copy what can be read and check the disk", path_, begin + done,
                                        std::strerror(errno)));
      }
      if (count == 0) break;  // it has become shorter
      done += static_cast<std::size_t>(count);
    }
    window_.resize(done);
    ahead_ = std::min(2 * ahead_, kMaxAhead);
    if (!inWindow()) return {};
  }
  return std::span<const std::uint8_t>(window_).subspan(static_cast<std::size_t>(offset - windowBegin_), size);
}

bool LogReader::next(RecordView& record) {
  std::span<const std::uint8_t> bytes = bytesAt(at_, kRecordHeaderBytes);
  if (bytes.empty()) return false;
  const auto length = load<std::uint32_t>(bytes.data());
  const auto type = load<std::uint16_t>(bytes.data() + 4);
  if (!isKnown(type) || load<std::uint16_t>(bytes.data() + 6) != 0 || load<std::uint32_t>(bytes.data() + 8) != sequence_) return false;
  if (length > kMaxPayloadBytes) return false;
  bytes = bytesAt(at_, kRecordFrameBytes + length);
  if (bytes.empty()) return false;
  const std::uint8_t* at = bytes.data();
  if (checksum(at, kRecordHeaderBytes + length) != load<std::uint32_t>(at + kRecordHeaderBytes + length)) return false;
  record = {static_cast<RecordType>(type), sequence_, at_, bytes.subspan(kRecordHeaderBytes, length)};
  at_ += kRecordFrameBytes + length;
  ++sequence_;
  return true;
}

bool LogReader::readAt(std::uint64_t offset, RecordType type, std::uint32_t length, RecordView& record) {
  const std::span<const std::uint8_t> bytes = bytesAt(offset, kRecordFrameBytes);
  if (bytes.empty() || load<std::uint32_t>(bytes.data()) != length ||
      load<std::uint32_t>(bytes.data() + 4) != static_cast<std::uint16_t>(type))
    return false;
  seek(offset, load<std::uint32_t>(bytes.data() + 8));
  return next(record);
}

void LogReader::seek(std::uint64_t offset, std::uint32_t sequence) {
  at_ = offset;
  sequence_ = sequence;
  ahead_ = kMinAhead;
}

}  // namespace reachlab::record
