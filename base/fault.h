#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace reachlab {

/// A location in a file. Lines and columns count from 1, and 0 means unknown. Without a file, `column` counts the characters of a text (a
/// formula).
struct FilePlace {
  std::string file;
  int line = 0, column = 0;
  bool operator==(const FilePlace&) const = default;
};

/// A fault of something that was given. All wrong input is reported in this form. A fault names keys and values, never an option or a
/// widget. The file's reader adds the location, and each front end adds the words of its options or widgets.
struct Fault {
  std::string key = {};                           // "object.masses_kg[1]" as in the files, or a request's "trials"; empty: the whole
  std::string what = {};                          // "is -1"
  std::string allowed = {};                       // "more than 0 kg"; empty where `what` says it all
  std::optional<FilePlace> place = std::nullopt;  // in the file, where there is one
  bool operator==(const Fault&) const = default;
};

/// A fault of a file as a whole.
Fault fileFault(const std::string& file, const std::string& what, const std::string& allowed = {});
/// `FILE:LINE:COLUMN: KEY: fault; allowed: …`, without the parts that are empty.
std::string toText(const Fault& fault);
/// A line each.
std::string toText(const std::vector<Fault>& faults);

/// "constraint.shape" of "constraint" and "shape". Without an outer key it is the inner key.
std::string keyIn(const std::string& outer, const std::string& inner);

/// The same faults told from outside: those of "index" in "trials[3]" are of "trials[3].index".
std::vector<Fault> inside(const std::string& key, std::vector<Fault> faults);
/// The faults, with the file added to each fault that has no location yet.
std::vector<Fault> inFile(const std::string& file, std::vector<Fault> faults);

/// Wrong usage or a bad file, as a list of faults. `reach` ends with 2.
struct FaultError : Error {
  explicit FaultError(std::vector<Fault> all) : Error(toText(all)), faults(std::move(all)) {}
  explicit FaultError(Fault fault) : FaultError(std::vector<Fault>{std::move(fault)}) {}
  std::vector<Fault> faults;
};

/// Calls `work` and puts `key` before the key of each fault that `work` throws. The fault loses its place, because the parsed text is in no
/// file.
template <class Work>
auto underKey(const std::string& key, const Work& work) {
  try {
    return work();
  } catch (const FaultError& error) {
    std::vector<Fault> faults = inside(key, error.faults);
    for (Fault& fault : faults) fault.place.reset();
    throw FaultError(std::move(faults));
  }
}

}  // namespace reachlab
