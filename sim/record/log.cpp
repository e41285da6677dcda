#include "sim/record/log.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <cerrno>
#include <utility>

#include "base/error.h"

namespace reachlab::record {

static_assert(std::endian::native == std::endian::little, "the log is written as it lies in memory");

namespace {

constexpr std::array<char, 8> kSignature{'R', 'E', 'A', 'C', 'H', 'L', 'O', 'G'};

std::uint32_t checksum(const std::uint8_t* data, std::size_t size) {
  return static_cast<std::uint32_t>(crc32_z(crc32_z(0, nullptr, 0), data, size));
}

template <typename T>
T load(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::vector<std::uint8_t> makeHeader() {
  ByteWriter header;
  header.putBytes(kSignature.data(), kSignature.size());
  header.put(kLogSchemaVersion);
  header.put(checksum(header.bytes().data(), header.size()));
  return {header.bytes().begin(), header.bytes().end()};
}

bool isKnown(std::uint16_t type) {
  return type >= static_cast<std::uint16_t>(RecordType::Configuration) && type <= static_cast<std::uint16_t>(RecordType::TrialSetup);
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
  if (size > left()) {
    ok_ = false;
    at_ = bytes_.size();
    return {};
  }
  std::string text(reinterpret_cast<const char*>(bytes_.data() + at_), size);
  at_ += size;
  return text;
}

LogWriter LogWriter::create(const std::string& path) {
  LogWriter writer(AppendFile::create(path));
  writer.file_.append(makeHeader());
  return writer;
}

LogWriter LogWriter::resume(const std::string& path, std::uint64_t size, std::uint32_t nextSequence) {
  LogWriter writer(AppendFile::openAt(path, size));
  writer.sequence_ = nextSequence;
  return writer;
}

std::uint64_t LogWriter::append(RecordType type, std::span<const std::uint8_t> payload) {
  frame_.resize(kRecordFrameBytes + payload.size());
  const auto length = static_cast<std::uint32_t>(payload.size());
  const auto number = static_cast<std::uint16_t>(type);
  const std::uint16_t zero = 0;
  std::uint8_t* at = frame_.data();
  std::memcpy(at, &length, 4);
  std::memcpy(at + 4, &number, 2);
  std::memcpy(at + 6, &zero, 2);
  std::memcpy(at + 8, &sequence_, 4);
  if (!payload.empty()) std::memcpy(at + kRecordHeaderBytes, payload.data(), payload.size());
  const std::uint32_t crc = checksum(at, kRecordHeaderBytes + payload.size());
  std::memcpy(at + kRecordHeaderBytes + payload.size(), &crc, 4);
  const std::uint64_t offset = file_.size();
  file_.append(frame_);
  ++sequence_;
  return offset;
}

void LogWriter::sync() { file_.sync(); }

LogReader::LogReader(const std::string& path) : path_(path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw ResourceError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  struct stat status {};
  const bool regular = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const auto size = static_cast<std::size_t>(status.st_size);
  void* memory = regular && size > 0 ? ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0) : MAP_FAILED;
  ::close(descriptor);
  if (memory != MAP_FAILED) bytes_ = {static_cast<const std::uint8_t*>(memory), size};
  const bool signature = bytes_.size() >= kLogHeaderBytes && std::memcmp(bytes_.data(), kSignature.data(), kSignature.size()) == 0 &&
                         checksum(bytes_.data(), 12) == load<std::uint32_t>(bytes_.data() + 12);
  if (signature) version_ = load<std::uint32_t>(bytes_.data() + 8);
  if (!signature || version_ > kLogSchemaVersion) {
    if (memory != MAP_FAILED) ::munmap(memory, size);
    bytes_ = {};
    throw UsageError(signature ? fmt::format("{}: log of schema version {}; this program reads up to {}: use a newer one", path, version_,
                                             kLogSchemaVersion)
                               : path + ": not a log of reachlab, or its first 16 bytes are damaged");
  }
}

LogReader::~LogReader() {
  if (!bytes_.empty()) ::munmap(const_cast<std::uint8_t*>(bytes_.data()), bytes_.size());
}

LogReader::LogReader(LogReader&& other) noexcept
    : path_(std::move(other.path_)), bytes_(std::exchange(other.bytes_, {})), at_(other.at_), sequence_(other.sequence_),
      version_(other.version_) {}

LogReader& LogReader::operator=(LogReader&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(bytes_, other.bytes_);
  std::swap(at_, other.at_);
  std::swap(sequence_, other.sequence_);
  std::swap(version_, other.version_);
  return *this;
}

bool LogReader::next(RecordView& record) {
  if (at_ > bytes_.size() || bytes_.size() - at_ < kRecordFrameBytes) return false;
  const std::uint8_t* at = bytes_.data() + at_;
  const auto length = load<std::uint32_t>(at);
  const auto type = load<std::uint16_t>(at + 4);
  if (length > kMaxPayloadBytes || length > bytes_.size() - at_ - kRecordFrameBytes) return false;
  if (!isKnown(type) || load<std::uint16_t>(at + 6) != 0 || load<std::uint32_t>(at + 8) != sequence_) return false;
  if (checksum(at, kRecordHeaderBytes + length) != load<std::uint32_t>(at + kRecordHeaderBytes + length)) return false;
  record = {static_cast<RecordType>(type), sequence_, at_, bytes_.subspan(at_ + kRecordHeaderBytes, length)};
  at_ += kRecordFrameBytes + length;
  ++sequence_;
  return true;
}

bool LogReader::looksLike(std::uint64_t offset, RecordType type, std::uint32_t length) const {
  if (offset > bytes_.size() || bytes_.size() - offset < kRecordFrameBytes) return false;
  const std::uint8_t* at = bytes_.data() + offset;
  return load<std::uint32_t>(at) == length && load<std::uint32_t>(at + 4) == static_cast<std::uint16_t>(type);
}

std::uint32_t LogReader::sequenceAt(std::uint64_t offset) const { return load<std::uint32_t>(bytes_.data() + offset + 8); }

void LogReader::seek(std::uint64_t offset, std::uint32_t sequence) {
  at_ = offset;
  sequence_ = sequence;
}

}  // namespace reachlab::record
