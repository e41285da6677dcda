#pragma once
#include <string>
#include <vector>

#include "base/fault.h"

namespace CLI {
class App;
}

namespace reachlab::cli {

/// An analysis that was planned before the data: options of `reach analyze`, and the day of the plan.
struct AnalysisPlan {
  struct Option {
    std::string name;                 // without dashes in front: "cutoff"
    std::vector<std::string> values;  // as on the command line, "true" for a flag
    FilePlace place;
  };
  std::string file, date;  // "2026-11-25"
  std::string sha256;      // of the file's bytes, in hexadecimal digits
  std::vector<Option> options;
  std::vector<std::string> departures;  // sentences, filled in by `applyPlan` and `checkDate`
};

/// Throws FaultError with every fault and its place, ResourceError if the file cannot be read.
AnalysisPlan readAnalysisPlan(const std::string& file);

/// Gives the options of the plan to `command`. An option that the command line gives too keeps the value of the command line, and is a departure
/// if the values differ. An option that changes numbers and is not in the plan is a departure too. Throws FaultError for an option that
/// `reach analyze` does not have or that changes no number, or for a value that it refuses.
void applyPlan(CLI::App& command, AnalysisPlan& plan);

/// Adds a departure if the plan is not older than the first recording. `startedUtc` has the starts of all runs, "2026-11-25T…".
void checkDate(AnalysisPlan& plan, const std::vector<std::string>& startedUtc);

}  // namespace reachlab::cli
