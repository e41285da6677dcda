#pragma once
#include <string>
#include <vector>

#include "analysis/recovery.h"
#include "analysis/study/study_folder.h"

namespace reachlab::study {

/// Share of successes at one value of one varied key, over everything else that is varied.
struct SuccessAt {
  std::string key, value;
  double number = 0;  // of a key with numbers
  std::size_t successes = 0, trials = 0;
};

/// Share of successes in a stretch of a block's trials, over all subjects and points.
struct LearningAt {
  std::string block;  // of a plan "slow day 1"; empty: an experiment
  std::size_t firstTrial = 1, lastTrial = 1, successes = 0, trials = 0;
};

/// How often studies of so many people and trials name the truth. People are drawn without replacement from the virtual subjects of one
/// truth, and judged by the rule for recorded people.
struct PowerAt {
  std::string truth, cell;  // what was varied beside the criterion
  std::size_t subjects = 0, trials = 0;
  std::size_t studies = 0, right = 0, wrong = 0;  // the remaining studies are undecided
};

/// The smallest examined design (subjects times trials) whose share of right studies reaches the level. 0 subjects: no design did.
struct SmallestDesign {
  std::string truth, cell;
  double level = 0.8;
  std::size_t subjects = 0, trials = 0;
};

/// One cell's confusion at its largest design.
struct Confusion {
  std::string cell;
  std::size_t subjects = 0, trials = 0;
  analysis::TruthRecovery named;
};

struct StudyReport {
  std::string name;
  std::int64_t points = 0, subjects = 0, trials = 0;
  std::vector<SuccessAt> success;
  std::vector<LearningAt> learning;
  std::vector<Confusion> confusion;
  std::vector<PowerAt> power;
  std::vector<SmallestDesign> smallest;
  std::vector<std::string> notes;
};

struct ReportOptions {
  int studies = 200;                  // drawn for each design
  std::vector<std::size_t> subjects;  // looked at; empty: a ladder up to half of those there are
  std::vector<std::size_t> trials;    // the same, up to all
};

/// Reads the study's chunks. Throws FaultError where some are missing.
StudyReport makeReport(const StudyFolder& folder, const ReportOptions& options);
/// success.csv, confusion.csv, power.csv, smallest.csv with their dictionaries, figures as SVG and PDF, and report.md into `out`. Returns
/// the files. Throws ResourceError.
std::vector<std::string> writeReport(const StudyReport& report, const std::string& out);

}  // namespace reachlab::study
