#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"

namespace reachlab {

/// Where something stands in a file; lines and columns count from 1, 0: not known. Without a file: the character of a text (a formula).
struct FilePlace {
  std::string file;
  int line = 0, column = 0;
  bool operator==(const FilePlace&) const = default;
};

/// What is wrong with something that was given: the one currency of wrong input. It speaks of keys and values, never of an option or a
/// widget: the file's reader adds the place, and each front end the words of its own door.
struct Fault {
  std::string key = {};                           // "object.masses_kg[1]" as in the files, or a request's "trials"; empty: the whole
  std::string what = {};                          // "is -1"
  std::string allowed = {};                       // "more than 0 kg"; empty where `what` says it all
  std::optional<FilePlace> place = std::nullopt;  // in the file, where there is one
  bool operator==(const Fault&) const = default;
};

/// `FILE:LINE:COLUMN: KEY: what is wrong; allowed: …`, without what is not there.
std::string toText(const Fault& fault);
/// A line each.
std::string toText(const std::vector<Fault>& faults);

/// "constraint.shape" of "constraint" and "shape"; without an outer one the inner.
std::string keyIn(const std::string& outer, const std::string& inner);

/// The same faults told from outside: those of "index" in "trials[3]" are of "trials[3].index".
std::vector<Fault> inside(const std::string& key, std::vector<Fault> faults);
/// The same faults of a file, those that have no place yet.
std::vector<Fault> inFile(const std::string& file, std::vector<Fault> faults);

/// Wrong usage or a bad file, fault by fault; `reach` ends with 2.
struct FaultError : Error {
  explicit FaultError(std::vector<Fault> all) : Error(toText(all)), faults(std::move(all)) {}
  explicit FaultError(Fault fault) : FaultError(std::vector<Fault>{std::move(fault)}) {}
  std::vector<Fault> faults;
};

}  // namespace reachlab
