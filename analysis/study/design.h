#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.h"
#include "sim/session/plan.h"

namespace reachlab::study {

/// A varied key: a key of the experiment, `subject.KEY`, `plan.KEY`, `experiment` (names) or `trials`.
struct VariedKey {
  std::string path;
  std::vector<std::string> values;                   // as JSON; of a grid
  std::optional<std::pair<double, double>> uniform;  // drawn between these instead, one value a sample
};

/// A study file as read: virtual subjects on a grid of settings or a random sample of them. Points are numbered with the last axis of the
/// grid running fastest, the samples inside.
struct Design {
  std::string name;
  std::string text, file;  // as read
  std::uint64_t seed = 0;
  std::string experiment;                                    // a file or a shipped name; empty: a plan
  std::string plan;                                          // likewise
  std::vector<std::pair<std::string, std::string>> subject;  // options of the simulated device, in order
  std::int64_t subjects = 1;                                 // at each point
  int trials = 1;                                            // of a subject; a plan has its own
  std::vector<VariedKey> axes;
  std::int64_t samples = 1;  // draws of the axes with `uniform`; 1 where there are none
  std::vector<std::string> measures;
  std::vector<std::string> criteria;  // compared with where measures ask for it; empty: all
  bool profiles = false;              // the hand's and the last mass's velocity of each trial, 101 points
  int chunkTrials = 0;                // trials that are computed and kept together; 0: chosen by the size of the study

  /// Texts of the experiments and of the plan, by the names above: nothing is looked up again once the design is read.
  std::map<std::string, std::string> experimentTexts;
  std::string planText;
  std::map<std::string, std::string> definitionTexts;  // of the constraints that are not shipped, by their names
};

inline constexpr std::int64_t kMaxPoints = 100'000'000, kMaxSubjects = 100'000'000;

/// The texts that a design names. A design that is kept in a folder has them beside it, so that nothing is looked up.
struct NamedTexts {
  std::string planFile, plan;  // its name, its text
  std::map<std::string, std::string> experiments, definitions;
};

/// Throws FaultError with every fault, `FILE:LINE:COLUMN: KEY: what is wrong; allowed: …`. Points are checked when they are made.
Design parseDesign(const std::string& text, const std::string& file, const std::optional<NamedTexts>& named = {});
/// Reads a study file.
Design readDesign(const std::string& file);
/// The name that a block's experiment has in Design::experimentTexts, whatever folder it lay in.
std::string experimentNameOf(const session::PlanBlock& block);

}  // namespace reachlab::study
