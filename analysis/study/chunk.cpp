#include "analysis/study/chunk.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>

#include "analysis/study/points.h"
#include "base/error.h"
#include "base/math/seeded.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/whole_file.h"

namespace reachlab::study {
namespace {

static_assert(std::endian::native == std::endian::little, "chunks are read where they were written, byte for byte");

constexpr char kMagic[8] = {'R', 'L', 'C', 'H', 'U', 'N', 'K', '1'};
constexpr std::int64_t kFewestTrials = 2'000, kMostTrials = 100'000, kWantedChunks = 1'000;

// Plain, and without padding.
struct Header {
  char magic[8];
  std::uint64_t fingerprint, chunk;
  std::int64_t rows;
  std::uint64_t columns, profileNumbers;  // in all
  std::uint64_t csvBytes, packedBytes;    // behind the header
  std::uint64_t crc;                      // of what is behind the header
};
static_assert(sizeof(Header) == 72);

std::string pack(std::span<const unsigned char> bytes) {
  uLongf size = compressBound(bytes.size());
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, bytes.data(), bytes.size(), 1) != Z_OK)
    throw ResourceError("the rows of a chunk cannot be compressed: no memory");
  packed.resize(size);
  return packed;
}

template <class T>
std::span<const unsigned char> bytesOf(const std::vector<T>& values) {
  return {reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T)};
}

std::uint64_t crcOf(std::string_view a, std::string_view b) {
  uLong crc = crc32_z(0, reinterpret_cast<const Bytef*>(a.data()), a.size());
  crc = crc32_z(crc, reinterpret_cast<const Bytef*>(b.data()), b.size());
  return crc;
}

bool readHeader(const std::string& path, Header& header) {
  std::ifstream in(path, std::ios::binary);
  return in.read(reinterpret_cast<char*>(&header), sizeof header) && std::memcmp(header.magic, kMagic, sizeof kMagic) == 0;
}

/// Deflate makes 1032 bytes of one at most: counts that ask for more are no chunk's, and no memory is asked for them.
bool couldBePacked(const Header& h) {
  constexpr double kMostOfAByte = 1032;
  const double values = static_cast<double>(h.rows) * static_cast<double>(h.columns) * sizeof(double);
  return h.rows >= 0 && values + static_cast<double>(h.profileNumbers) * sizeof(float) <= kMostOfAByte * static_cast<double>(h.packedBytes);
}

[[noreturn]] void failDamaged(const std::string& path) { throw ResourceError(path + ": is damaged; delete it, and resume the study"); }

}  // namespace

ChunkPlan planChunks(const Design& design) {
  ChunkPlan plan;
  plan.pairs = pairCount(design);
  const std::int64_t ofSubject = std::max<std::int64_t>(1, mostTrialsOfSubject(design));
  const std::int64_t wanted =
      design.chunkTrials > 0 ? design.chunkTrials : std::clamp(plan.pairs * ofSubject / kWantedChunks, kFewestTrials, kMostTrials);
  plan.pairsPerChunk = std::max<std::int64_t>(1, wanted / ofSubject);
  return plan;
}

std::uint64_t fingerprintOf(const Design& design) {
  std::uint64_t print = hashOf(design.text);
  const auto add = [&](std::string_view text) { print = mixBits(print ^ hashOf(text)); };
  add(design.name);
  add(design.planText);
  for (const auto* texts : {&design.experimentTexts, &design.definitionTexts})
    for (const auto& [name, text] : *texts) add(name), add(text);
  add(REACHLAB_VERSION);
  return print;
}

std::string chunkPath(const std::string& out, std::int64_t chunk) {
  return fmt::format("{}/chunks/{:03}/{:08}.chunk", out, chunk / 1000, chunk);
}

bool isChunkThere(const std::string& out, std::int64_t chunk, std::uint64_t fingerprint) {
  const std::string path = chunkPath(out, chunk);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  Header header{};
  if (error) return false;
  if (!readHeader(path, header) || size != sizeof header + header.csvBytes + header.packedBytes) failDamaged(path);
  if (header.fingerprint != fingerprint || header.chunk != static_cast<std::uint64_t>(chunk))
    throw ResourceError(path + ": is of another study or of another version of the program; allowed: a folder of its own for each study");
  return true;
}

void writeChunk(const std::string& out, std::int64_t chunk, std::uint64_t fingerprint, const ChunkRows& rows) {
  std::vector<unsigned char> numbers;
  for (const auto bytes : {bytesOf(rows.values), bytesOf(rows.profiles)}) numbers.insert(numbers.end(), bytes.begin(), bytes.end());
  const std::string packed = pack(numbers);
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.fingerprint = fingerprint;
  header.chunk = static_cast<std::uint64_t>(chunk);
  header.rows = rows.rows;
  header.columns = rows.columns;
  header.profileNumbers = rows.profiles.size();
  header.csvBytes = rows.csvGz.size();
  header.packedBytes = packed.size();
  header.crc = crcOf(rows.csvGz, packed);
  record::AtomicFile file(chunkPath(out, chunk));
  file.append({reinterpret_cast<const char*>(&header), sizeof header});
  file.append(rows.csvGz);
  file.append(packed);
  file.commit();
}

ChunkRows readChunk(const std::string& out, std::int64_t chunk, std::uint64_t fingerprint) {
  const std::string path = chunkPath(out, chunk);
  if (!isChunkThere(out, chunk, fingerprint)) throw ResourceError(path + ": is not there any more; resume the study");
  const std::string bytes = record::readWholeFile(path);
  Header header{};
  if (bytes.size() < sizeof header) failDamaged(path);
  std::memcpy(&header, bytes.data(), sizeof header);
  if (bytes.size() != sizeof header + header.csvBytes + header.packedBytes) failDamaged(path);
  ChunkRows rows;
  rows.rows = header.rows;
  rows.columns = header.columns;
  rows.csvGz = bytes.substr(sizeof header, header.csvBytes);
  const std::string_view packed(bytes.data() + sizeof header + header.csvBytes, header.packedBytes);
  if (crcOf(rows.csvGz, packed) != header.crc || !couldBePacked(header)) failDamaged(path);
  rows.values.resize(static_cast<std::size_t>(header.rows) * header.columns);
  rows.profiles.resize(header.profileNumbers);
  const std::size_t ofValues = rows.values.size() * sizeof(double), ofProfiles = rows.profiles.size() * sizeof(float);
  std::vector<unsigned char> numbers(ofValues + ofProfiles + 1);  // + 1: not empty
  uLongf size = numbers.size();
  if (uncompress(numbers.data(), &size, reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK ||
      size != ofValues + ofProfiles)
    failDamaged(path);
  std::memcpy(rows.values.data(), numbers.data(), ofValues);
  if (ofProfiles > 0) std::memcpy(rows.profiles.data(), numbers.data() + ofValues, ofProfiles);
  return rows;
}

}  // namespace reachlab::study
