#include "sim/record/export/hdf5_file.h"

#include <algorithm>
#include <span>

#include "sim/record/export/hdf5_handle.h"
#include "sim/record/export/run_tables.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/atomic_file.h"

namespace reachlab::record {
namespace {

constexpr hsize_t kChunk = 1 << 14;  // rows
constexpr unsigned kCompression = 4;

Handle utf8Type() {
  const hid_t type = checked(H5Tcopy(H5T_C_S1));
  if (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0) throw Hdf5Fault{};
  return {type, H5Tclose};
}

void addAttribute(hid_t to, const char* name, const std::string& text) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle type = utf8Type();
  const Handle attribute(H5Acreate2(to, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const char* value = text.c_str();
  done(H5Awrite(attribute, type, &value));
}

void addAttribute(hid_t to, const char* name, int value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(to, name, H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  done(H5Awrite(attribute, H5T_NATIVE_INT, &value));
}

// Numbers in compressed chunks; an empty table has none to cut.
Handle numberLayout(hsize_t rows) {
  const hid_t layout = checked(H5Pcreate(H5P_DATASET_CREATE));
  const hsize_t chunk = std::min(rows, kChunk);
  if (rows > 0 && (H5Pset_chunk(layout, 1, &chunk) < 0 || H5Pset_shuffle(layout) < 0 || H5Pset_deflate(layout, kCompression) < 0))
    throw Hdf5Fault{};
  return {layout, H5Pclose};
}

void addNumbers(hid_t group, const std::string& name, std::span<const double> values, const Channel* channel = nullptr) {
  const hsize_t rows = values.size();
  const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
  const Handle layout = numberLayout(rows);
  const Handle set(H5Dcreate2(group, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, layout, H5P_DEFAULT), H5Dclose);
  done(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  if (channel == nullptr) return;
  addAttribute(set, "units", channel->units == "n/a" ? "" : channel->units);
  addAttribute(set, "description", channel->description);
}

void addTexts(hid_t group, const std::string& name, const std::vector<std::string>& texts) {
  const hsize_t rows = texts.size();
  const Handle space(H5Screate_simple(1, &rows, nullptr), H5Sclose);
  const Handle type = utf8Type();
  const Handle set(H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  done(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()));
}

void addTable(hid_t file, const char* name, const ColumnTable& table) {
  const Handle group(H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  for (const ColumnTable::Column& column : table.columns())
    if (column.isText) addTexts(group, column.name, column.texts);
    else addNumbers(group, column.name, column.numbers);
}

void addRun(hid_t file, const RunLog& run) {
  const RunConfiguration& c = run.configuration();
  addAttribute(file, "clock", clockStatement(run));
  addAttribute(file, "software", c.softwareVersion);
  addAttribute(file, "subject", c.subject);
  addAttribute(file, "session", c.session);
  addAttribute(file, "run", c.run);
  addAttribute(file, "condition", c.condition);
  addAttribute(file, "experiment", c.experimentName);
  addTable(file, "trials", trialTable(run));
  addTable(file, "events", eventTable(run));
  // As data sets: an attribute holds 64 kB at most.
  addTexts(file, "experiment_json", {c.experimentText});
  if (c.scenes) addTable(file, "scenes", sceneTable(c));
  const Handle samples(H5Gcreate2(file, "samples", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  eachSampleColumn(run, [&](std::size_t channel, std::span<const double> values) {
    addNumbers(samples, c.table.channels[channel].column, values, &c.table.channels[channel]);
  });
}

}  // namespace

void prepareHdf5() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::vector<std::string> writeHdf5(const std::vector<RunLog>& runs, const std::string& folder) {
  prepareHdf5();
  std::vector<std::string> written;
  for (const RunLog& run : runs) {
    const std::string path = folder + "/" + runName(run.configuration()) + ".h5";
    ForeignFile out(path);
    try {
      // The default driver looks the file's path up, and a file without a name has none.
      const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      done(H5Pset_fapl_stdio(access));
      Handle file(H5Fcreate(out.temporary().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
      addRun(file, run);
      done(H5Fflush(file, H5F_SCOPE_GLOBAL));
      file.close();
    } catch (const Hdf5Fault&) {
      out.giveUp("the HDF5 library failed");
    }
    out.commit();
    written.push_back(path);
  }
  return written;
}

}  // namespace reachlab::record
