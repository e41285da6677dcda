#include "analysis/study/hdf5_table.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "sim/record/export/hdf5_file.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::study {
namespace {

constexpr hsize_t kRowsAPiece = 8192, kProfilesAPiece = 256;

[[noreturn]] void fail(const std::string& path) {
  throw ResourceError(path + ": cannot be written; is the disk full? Every chunk is kept: resume the study");
}

/// An identifier of the library, closed by its own function.
class Handle {
 public:
  Handle() = default;
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& path) : id_(id), close_(close) {
    if (id < 0) fail(path);
  }
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  bool reset() { return id_ < 0 || close_(std::exchange(id_, -1)) >= 0; }
  hid_t id() const { return id_; }

 private:
  hid_t id_ = -1;
  herr_t (*close_)(hid_t) = nullptr;
};

// Text of a fixed length, as readers of every language take it.
void putText(hid_t object, const char* name, const std::vector<std::string>& texts, const std::string& path) {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, path);
  H5Tset_size(type.id(), longest);
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  const hsize_t count = texts.size();
  const Handle space(texts.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose, path);
  const Handle attribute(H5Acreate2(object, name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path);
  std::string bytes;
  for (const std::string& text : texts) bytes += text + std::string(longest - text.size(), '\0');
  if (H5Awrite(attribute.id(), type.id(), bytes.data()) < 0) fail(path);
}

// No time of making: the same rows are to give the same bytes.
Handle plain(hid_t kind, const std::string& path) {
  Handle list(H5Pcreate(kind), H5Pclose, path);
  H5Pset_obj_track_times(list.id(), false);
  return list;
}

}  // namespace

struct Hdf5Table::Parts {
  explicit Parts(const std::string& file_) : path(file_), out(file_) {}
  std::string path;
  record::ForeignFile out;  // goes after what is open in it
  std::vector<Column> columns;
  Handle file, trials, profiles;
  std::vector<Handle> data, profileData;
  std::size_t profileNumbers = 0;
  hsize_t rows = 0;

  // One or two dimensions, growing along the first.
  Handle makeData(hid_t group, const char* name, hid_t type, hsize_t width, hsize_t piece) const {
    const hsize_t none[] = {0, width}, most[] = {H5S_UNLIMITED, width}, chunk[] = {piece, width};
    const int rank = width > 1 ? 2 : 1;
    const Handle space(H5Screate_simple(rank, none, most), H5Sclose, path);
    const Handle how = plain(H5P_DATASET_CREATE, path);
    H5Pset_chunk(how.id(), rank, chunk);
    H5Pset_shuffle(how.id());
    H5Pset_deflate(how.id(), 4);
    return {H5Dcreate2(group, name, type, space.id(), H5P_DEFAULT, how.id(), H5P_DEFAULT), H5Dclose, path};
  }

  void extend(hid_t set, hid_t type, hsize_t width, hsize_t count, const void* values) const {
    const int rank = width > 1 ? 2 : 1;
    const hsize_t size[] = {rows + count, width}, from[] = {rows, 0}, part[] = {count, width};
    if (H5Dset_extent(set, size) < 0) fail(path);
    const Handle space(H5Dget_space(set), H5Sclose, path), memory(H5Screate_simple(rank, part, nullptr), H5Sclose, path);
    if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, from, nullptr, part, nullptr) < 0 ||
        H5Dwrite(set, type, memory.id(), space.id(), H5P_DEFAULT, values) < 0)
      fail(path);
  }
};

Hdf5Table::Hdf5Table(const std::string& path, const std::vector<Column>& columns, const std::string& dictionary, std::size_t profileNumbers)
    : parts_(std::make_unique<Parts>(path)) {
  Parts& p = *parts_;
  p.columns = columns;
  p.profileNumbers = profileNumbers;
  record::prepareHdf5();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, path);
  H5Pset_fapl_stdio(access.id());  // the default driver looks the file's path up, and a file without a name has none
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_V18);
  const Handle making = plain(H5P_FILE_CREATE, path);
  p.file = {H5Fcreate(p.out.temporary().c_str(), H5F_ACC_TRUNC, making.id(), access.id()), H5Fclose, path};
  const auto group = [&](const char* name) {
    const Handle how = plain(H5P_GROUP_CREATE, path);
    return Handle(H5Gcreate2(p.file.id(), name, H5P_DEFAULT, how.id(), H5P_DEFAULT), H5Gclose, path);
  };
  p.trials = group("trials");
  const auto meanings = nlohmann::json::parse(dictionary);
  for (const Column& column : columns) {
    const hid_t type = column.words.empty() ? H5T_IEEE_F64LE : H5T_STD_I32LE;
    p.data.push_back(p.makeData(p.trials.id(), column.name.c_str(), type, 1, kRowsAPiece));
    const auto& meaning = meanings.at(column.name);
    putText(p.data.back().id(), "Description", {meaning.at("Description").get<std::string>()}, path);
    if (meaning.contains("Units")) putText(p.data.back().id(), "Units", {meaning.at("Units").get<std::string>()}, path);
    if (!column.words.empty()) putText(p.data.back().id(), "words", column.words, path);
  }
  if (profileNumbers == 0) return;
  p.profiles = group("profiles");
  for (const char* name : {"hand_m_per_s", "object_m_per_s"}) {
    p.profileData.push_back(p.makeData(p.profiles.id(), name, H5T_IEEE_F32LE, profileNumbers / 2, kProfilesAPiece));
    putText(p.profileData.back().id(), "Description",
            {"Velocity at 101 instants from onset to offset, as measured; NaN where there is no movement"}, path);
    putText(p.profileData.back().id(), "Units", {"m/s"}, path);
  }
}

Hdf5Table::~Hdf5Table() = default;

void Hdf5Table::append(const ChunkRows& rows) {
  Parts& p = *parts_;
  const auto count = static_cast<std::size_t>(rows.rows);
  std::vector<std::int32_t> codes(count);
  for (std::size_t k = 0; k < p.columns.size(); ++k) {
    const double* values = rows.values.data() + k * count;
    if (p.columns[k].words.empty()) {
      p.extend(p.data[k].id(), H5T_NATIVE_DOUBLE, 1, count, values);
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) codes[i] = std::isfinite(values[i]) ? static_cast<std::int32_t>(values[i]) : -1;
    p.extend(p.data[k].id(), H5T_NATIVE_INT32, 1, count, codes.data());
  }
  const std::size_t half = p.profileNumbers / 2;
  std::vector<float> part(count * half);
  for (std::size_t k = 0; k < p.profileData.size(); ++k) {
    for (std::size_t i = 0; i < count; ++i)
      std::copy_n(rows.profiles.data() + i * p.profileNumbers + k * half, half, part.data() + i * half);
    p.extend(p.profileData[k].id(), H5T_NATIVE_FLOAT, half, count, part.data());
  }
  p.rows += count;
}

void Hdf5Table::commit() {
  Parts& p = *parts_;
  bool fine = true;
  for (Handle& data : p.data) fine = data.reset() && fine;
  for (Handle& data : p.profileData) fine = data.reset() && fine;
  fine = p.trials.reset() && p.profiles.reset() && p.file.reset() && fine;
  if (!fine) fail(p.path);
  p.out.commit();
}

}  // namespace reachlab::study
