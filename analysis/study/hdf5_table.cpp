#include "analysis/study/hdf5_table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "sim/record/export/hdf5_file.h"
#include "sim/record/export/hdf5_handle.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::study {
namespace {

constexpr hsize_t kRowsAPiece = 8192, kProfilesAPiece = 256;

using record::done;
using record::Handle;

// Text of a fixed length, as readers of every language take it.
void putText(hid_t object, const char* name, const std::vector<std::string>& texts) {
  std::size_t longest = 1;
  for (const std::string& text : texts) longest = std::max(longest, text.size());
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, longest);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  const hsize_t count = texts.size();
  const Handle space(texts.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle attribute(H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  std::string bytes;
  for (const std::string& text : texts) bytes += text + std::string(longest - text.size(), '\0');
  done(H5Awrite(attribute, type, bytes.data()));
}

// No time of making: the same rows are to give the same bytes.
Handle plain(hid_t kind) {
  Handle list(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(list, false);
  return list;
}

Handle makeGroup(hid_t file, const char* name) {
  return {H5Gcreate2(file, name, H5P_DEFAULT, plain(H5P_GROUP_CREATE), H5P_DEFAULT), H5Gclose};
}

/// A dataset of one or two dimensions that grows along the first.
class GrowingData {
 public:
  GrowingData(hid_t group, const char* name, hid_t type, hsize_t width, hsize_t piece)
      : rank_(width > 1 ? 2 : 1), width_(width), set_(make(group, name, type, piece)) {}
  void append(hid_t type, hsize_t count, const void* values) {
    const hsize_t size[] = {rows_ + count, width_}, from[] = {rows_, 0}, part[] = {count, width_};
    done(H5Dset_extent(set_, size));
    const Handle space(H5Dget_space(set_), H5Sclose), memory(H5Screate_simple(rank_, part, nullptr), H5Sclose);
    done(H5Sselect_hyperslab(space, H5S_SELECT_SET, from, nullptr, part, nullptr));
    done(H5Dwrite(set_, type, memory, space, H5P_DEFAULT, values));
    rows_ += count;
  }
  hid_t id() const { return set_; }
  void close() { set_.close(); }

 private:
  Handle make(hid_t group, const char* name, hid_t type, hsize_t piece) const {
    const hsize_t none[] = {0, width_}, most[] = {H5S_UNLIMITED, width_}, chunk[] = {piece, width_};
    const Handle space(H5Screate_simple(rank_, none, most), H5Sclose);
    const Handle how = plain(H5P_DATASET_CREATE);
    H5Pset_chunk(how, rank_, chunk);
    H5Pset_shuffle(how);
    H5Pset_deflate(how, 4);
    return {H5Dcreate2(group, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT), H5Dclose};
  }
  int rank_;
  hsize_t width_, rows_ = 0;
  Handle set_;
};

std::vector<GrowingData> makeColumns(hid_t group, const std::vector<Column>& columns, const std::string& dictionary) {
  std::vector<GrowingData> data;
  const auto meanings = nlohmann::json::parse(dictionary);
  for (const Column& column : columns) {
    const hid_t type = column.words.empty() ? H5T_IEEE_F64LE : H5T_STD_I32LE;
    const hid_t made = data.emplace_back(group, column.name.c_str(), type, 1, kRowsAPiece).id();
    const auto& meaning = meanings.at(column.name);
    putText(made, "Description", {meaning.at("Description").get<std::string>()});
    if (meaning.contains("Units")) putText(made, "Units", {meaning.at("Units").get<std::string>()});
    if (!column.words.empty()) putText(made, "words", column.words);
  }
  return data;
}

std::vector<GrowingData> makeProfiles(hid_t group, std::size_t points) {
  std::vector<GrowingData> data;
  for (const char* name : {"hand_m_per_s", "object_m_per_s"}) {
    const hid_t made = data.emplace_back(group, name, H5T_IEEE_F32LE, points, kProfilesAPiece).id();
    putText(made, "Description", {"Velocity at 101 instants from onset to offset, as measured; NaN where there is no movement"});
    putText(made, "Units", {"m/s"});
  }
  return data;
}

void appendColumns(std::vector<GrowingData>& data, const std::vector<Column>& columns, const ChunkRows& rows) {
  const auto count = static_cast<std::size_t>(rows.rows);
  std::vector<std::int32_t> codes(count);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const double* values = rows.values.data() + k * count;
    if (columns[k].words.empty()) {
      data[k].append(H5T_NATIVE_DOUBLE, count, values);
      continue;
    }
    for (std::size_t i = 0; i < count; ++i) codes[i] = std::isfinite(values[i]) ? static_cast<std::int32_t>(values[i]) : -1;
    data[k].append(H5T_NATIVE_INT32, count, codes.data());
  }
}

void appendProfiles(std::vector<GrowingData>& data, std::size_t points, const ChunkRows& rows) {
  const auto count = static_cast<std::size_t>(rows.rows);
  std::vector<float> part(count * points);
  for (std::size_t k = 0; k < data.size(); ++k) {
    for (std::size_t i = 0; i < count; ++i)
      std::copy_n(rows.profiles.data() + (i * data.size() + k) * points, points, part.data() + i * points);
    data[k].append(H5T_NATIVE_FLOAT, count, part.data());
  }
}

}  // namespace

void writeHdf5Table(const std::string& path, const std::vector<Column>& columns, const std::string& dictionary, std::size_t profileNumbers,
                    const std::function<std::optional<ChunkRows>()>& nextRows) try {
  record::ForeignFile out(path);
  record::prepareHdf5();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_stdio(access);  // the default driver looks the file's path up, and a file without a name has none
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  Handle file(H5Fcreate(out.temporary().c_str(), H5F_ACC_TRUNC, plain(H5P_FILE_CREATE), access), H5Fclose);
  std::vector<Handle> groups;
  groups.push_back(makeGroup(file, "trials"));
  std::vector<GrowingData> data = makeColumns(groups.front(), columns, dictionary), profiles;
  if (profileNumbers > 0) {
    groups.push_back(makeGroup(file, "profiles"));
    profiles = makeProfiles(groups.back(), profileNumbers / 2);
  }
  while (const std::optional<ChunkRows> rows = nextRows()) {
    appendColumns(data, columns, *rows);
    appendProfiles(profiles, profileNumbers / 2, *rows);
  }
  for (std::vector<GrowingData>* all : {&data, &profiles})
    for (GrowingData& one : *all) one.close();
  for (Handle& group : groups) group.close();
  file.close();
  out.commit();
} catch (const record::Hdf5Fault&) {
  throw ResourceError(path + ": cannot be written; is the disk full? Every chunk is kept: resume the study");
}

}  // namespace reachlab::study
