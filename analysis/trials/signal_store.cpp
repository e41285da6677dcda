#include "analysis/trials/signal_store.h"

#include <cerrno>
#include <cstring>

#include "base/error.h"

namespace reachlab::analysis {
namespace {

[[noreturn]] void fail(const char* what) {
  throw ResourceError(std::string("the temporary file of the analysis cannot be ") + what + ": " + std::strerror(errno));
}

}  // namespace

SignalStore::Row SignalStore::put(std::span<const double> values) {
  const Row row{stored_, static_cast<std::uint32_t>(values.size())};
  stored_ += values.size();
  if (!file_ && stored_ <= most_) {
    memory_.insert(memory_.end(), values.begin(), values.end());
    return row;
  }
  if (!file_) {
    file_.reset(std::tmpfile());
    if (!file_) fail("made");
  }
  // Rows in the file stand at their own place; what memory holds leaves a hole at its beginning.
  if (std::fseek(file_.get(), static_cast<long>(row.place * sizeof(double)), SEEK_SET) != 0 ||
      std::fwrite(values.data(), sizeof(double), values.size(), file_.get()) != values.size())
    fail("written");
  return row;
}

std::vector<double> SignalStore::get(Row row) const {
  if (row.place + row.size <= memory_.size())
    return {memory_.begin() + static_cast<std::ptrdiff_t>(row.place), memory_.begin() + static_cast<std::ptrdiff_t>(row.place + row.size)};
  std::vector<double> out(row.size);
  if (std::fseek(file_.get(), static_cast<long>(row.place * sizeof(double)), SEEK_SET) != 0 ||
      std::fread(out.data(), sizeof(double), out.size(), file_.get()) != out.size())
    fail("read");
  return out;
}

}  // namespace reachlab::analysis
