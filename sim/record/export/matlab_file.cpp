#include "sim/record/export/matlab_file.h"

#include <matio.h>

#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "sim/record/export/run_tables.h"
#include "sim/record/export/tidy_csv.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/checksum.h"

namespace reachlab::record {
namespace {

struct MatlabFault {};

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, CloseFile>;
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

Variable owned(matvar_t* variable) {
  if (variable == nullptr) throw MatlabFault{};
  return Variable(variable);
}

// matio copies what it is given, and takes it without const.
Variable numbers(const char* name, std::span<const double> values) {
  std::array<std::size_t, 2> size{values.size(), 1};
  static const double kNothing = 0;
  const void* data = values.empty() ? &kNothing : values.data();
  return owned(Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), const_cast<void*>(data), 0));
}

Variable text(const char* name, const std::string& utf8) {
  std::u16string characters = utf16Of(utf8);
  std::array<std::size_t, 2> size{characters.empty() ? std::size_t{0} : 1, characters.size()};
  return owned(Mat_VarCreate(name, MAT_C_CHAR, MAT_T_UTF16, 2, size.data(), characters.data(), 0));
}

Variable cells(const std::vector<std::string>& texts) {
  std::array<std::size_t, 2> size{texts.size(), 1};
  Variable all = owned(Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, size.data(), nullptr, 0));
  for (std::size_t i = 0; i < texts.size(); ++i) Mat_VarSetCell(all.get(), static_cast<int>(i), text(nullptr, texts[i]).release());
  return all;
}

Variable structure(const char* name, const std::vector<std::string>& fields) {
  std::vector<const char*> names;
  for (const std::string& field : fields) names.push_back(field.c_str());
  std::array<std::size_t, 2> size{1, 1};
  return owned(Mat_VarCreateStruct(name, 2, size.data(), names.data(), static_cast<unsigned>(names.size())));
}
void setField(Variable& whole, std::size_t field, Variable value) { Mat_VarSetStructFieldByIndex(whole.get(), field, 0, value.release()); }

Variable tableOf(const char* name, const ColumnTable& table) {
  std::vector<std::string> names;
  for (const ColumnTable::Column& column : table.columns()) names.push_back(column.name);
  Variable whole = structure(name, names);
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    const ColumnTable::Column& column = table.columns()[i];
    setField(whole, i, column.isText ? cells(column.texts) : numbers(nullptr, column.numbers));
  }
  return whole;
}

// One text a channel.
Variable textsOf(const char* name, const ChannelTable& table, const std::function<std::string(const Channel&)>& textOf) {
  std::vector<std::string> columns;
  for (const Channel& channel : table.channels) columns.push_back(channel.column);
  Variable whole = structure(name, columns);
  for (std::size_t i = 0; i < columns.size(); ++i) setField(whole, i, text(nullptr, textOf(table.channels[i])));
  return whole;
}

// matio does not tell when the disk takes less than it was given: what is expected to be read back.
struct Written {
  std::string name;
  std::size_t rows = 0;
  std::uint32_t checksum = 0;  // of a column of numbers
  bool isColumn = false;
};

void put(mat_t* file, const Variable& variable, std::vector<Written>& written, const Written& expected) {
  if (Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_ZLIB) != 0) throw MatlabFault{};
  written.push_back(expected);
}

std::vector<Written> writeRun(mat_t* file, const RunLog& run) {
  const RunConfiguration& c = run.configuration();
  std::vector<Written> written;
  const auto whole = [&](const char* name, const Variable& variable) { put(file, variable, written, {name}); };
  whole("clock", text("clock", clockStatement(run)));
  whole("software", text("software", c.softwareVersion));
  whole("experiment_json", text("experiment_json", c.experimentText));
  if (c.scenes) whole("scenes", tableOf("scenes", sceneTable(c)));
  whole("units", textsOf("units", c.table, [](const Channel& channel) { return channel.units == "n/a" ? "" : channel.units; }));
  whole("descriptions", textsOf("descriptions", c.table, [](const Channel& channel) { return channel.description; }));
  whole("trials", tableOf("trials", trialTable(run)));
  whole("events", tableOf("events", eventTable(run)));
  eachSampleColumn(run, [&](std::size_t channel, std::span<const double> values) {
    const std::string& name = c.table.channels[channel].column;
    put(file, numbers(name.c_str(), values), written, {name, values.size(), checksum(values.data(), values.size_bytes()), true});
  });
  return written;
}

bool readsBack(const std::string& path, const std::vector<Written>& written) {
  const File file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) return false;
  for (const Written& expected : written) {
    const Variable variable(Mat_VarRead(file.get(), expected.name.c_str()));
    if (!variable) return false;
    if (!expected.isColumn) continue;
    if (variable->class_type != MAT_C_DOUBLE || variable->dims[0] != expected.rows || variable->nbytes != expected.rows * sizeof(double) ||
        checksum(variable->data, variable->nbytes) != expected.checksum)
      return false;
  }
  return true;
}

}  // namespace

std::vector<std::string> writeMatlab(const std::vector<RunLog>& runs, const std::string& folder) {
  std::vector<std::string> written;
  for (const RunLog& run : runs) {
    const std::string path = folder + "/" + runName(run.configuration()) + ".mat";
    ForeignFile out(path);
    try {
      File file(Mat_CreateVer(out.temporary().c_str(), "MATLAB MAT-file, written by reachlab", MAT_FT_MAT5));
      if (!file) throw MatlabFault{};
      const std::vector<Written> expected = writeRun(file.get(), run);
      if (Mat_Close(file.release()) != 0 || !readsBack(out.temporary(), expected)) throw MatlabFault{};
    } catch (const MatlabFault&) {
      out.giveUp("what the matio library wrote does not read back");
    }
    out.commit();
    written.push_back(path);
  }
  return written;
}

std::u16string utf16Of(const std::string& text) {
  constexpr char32_t kUnknown = 0xfffd;
  std::u16string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto lead = static_cast<unsigned char>(text[at++]);
    const int more = lead < 0x80                   ? 0
                     : lead >= 0xc2 && lead < 0xe0 ? 1
                     : lead >= 0xe0 && lead < 0xf0 ? 2
                     : lead >= 0xf0 && lead < 0xf5 ? 3
                                                   : -1;
    char32_t code = more <= 0 ? lead : lead & (0x3fu >> more);
    bool right = more >= 0;
    for (int k = 0; right && k < more; ++k) {
      right = at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0u) == 0x80u;
      if (right) code = (code << 6) | (static_cast<unsigned char>(text[at++]) & 0x3fu);
    }
    constexpr std::array<char32_t, 4> kLeast{0, 0x80, 0x800, 0x10000};
    const bool fits = code >= kLeast[static_cast<std::size_t>(std::max(more, 0))] && code < 0x10000 && (code < 0xd800 || code >= 0xe000);
    out += static_cast<char16_t>(right && fits ? code : kUnknown);
  }
  return out;
}

}  // namespace reachlab::record
