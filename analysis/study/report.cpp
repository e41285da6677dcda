#include "analysis/study/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "analysis/conclusions/conclusion.h"
#include "analysis/conclusions/person_fit.h"
#include "analysis/study/points.h"
#include "base/fault.h"
#include "base/math/philox.h"
#include "sim/predict/prediction/criterion.h"

namespace reachlab::study {
namespace {

constexpr std::size_t kStretch = 10;  // trials a point of the learning curve, as the analysis has it
constexpr const char* kTruth = "subject.criterion";

std::size_t placeOf(const std::vector<Column>& columns, const std::string& name) {
  for (std::size_t k = 0; k < columns.size(); ++k)
    if (columns[k].name == name) return k;
  return columns.size();
}

std::string wordOf(const Column& column, double value) {
  return column.words.empty() ? fmt::format("{}", value) : std::isfinite(value) ? column.words.at(static_cast<std::size_t>(value)) : "";
}

/// The trials of one virtual person in one condition.
struct ConditionTrials {
  std::vector<int> trial;            // number of each used one
  analysis::ConditionScores scores;  // of the criteria and then the reference
};
using PersonTrials = std::map<std::string, ConditionTrials>;

/// Virtual people who are alike but for chance: one truth, one combination of everything else.
struct Population {
  std::string truth, cell;
  std::map<std::pair<std::int64_t, std::int64_t>, PersonTrials> people;  // by point and subject
  std::size_t trials = 0;                                                // most in one condition
};

/// Criteria whose scores are the same everywhere predict the same hand; those without scores are not defined.
struct Named {
  std::vector<std::vector<predict::Criterion>> candidates;  // the reference last, without criteria
  std::vector<std::size_t> column;                          // score of each
};

Named nameCandidates(const Design& design, const std::vector<Population>& populations) {
  const std::vector<predict::Criterion> criteria = criteriaOf(design);
  Named out;
  const auto same = [&](std::size_t a, std::size_t b) {
    for (const Population& population : populations)
      for (const auto& [who, person] : population.people)
        for (const auto& [condition, trials] : person)
          for (std::size_t i = 0; i < trials.trial.size(); ++i)
            if (!(trials.scores.score[a][i] == trials.scores.score[b][i])) return false;
    return true;
  };
  for (std::size_t k = 0; k < criteria.size(); ++k) {
    if (!same(k, k)) continue;  // NaN somewhere
    const auto known = std::find_if(out.column.begin(), out.column.end(), [&](std::size_t other) { return same(other, k); });
    if (known != out.column.end()) {
      out.candidates[static_cast<std::size_t>(known - out.column.begin())].push_back(criteria[k]);
    } else {
      out.candidates.push_back({criteria[k]});
      out.column.push_back(k);
    }
  }
  out.candidates.emplace_back();
  out.column.push_back(criteria.size());
  return out;
}

/// What the rule for people sees of one of them who made `most` trials in each condition; no conditions where one has too few.
analysis::PersonScores scoresOf(const PersonTrials& person, std::size_t most, const Named& named) {
  analysis::PersonScores out;
  for (const auto& [name, trials] : person) {
    const auto tooLate = [&](int number) { return static_cast<std::size_t>(number) > most; };
    const auto used = std::find_if(trials.trial.begin(), trials.trial.end(), tooLate) - trials.trial.begin();
    if (used < static_cast<std::ptrdiff_t>(analysis::kFewestTrials)) return {};
    const auto usedOf = [&](const std::vector<double>& all) { return std::vector<double>(all.begin(), all.begin() + used); };
    analysis::ConditionScores& scores = out.conditions.emplace_back();
    scores.condition = out.conditions.size() - 1;
    scores.effectiveSamples = trials.scores.effectiveSamples;
    for (const std::size_t column : named.column) scores.score.push_back(usedOf(trials.scores.score[column]));
    scores.own = usedOf(trials.scores.own);
    scores.r2.assign(named.column.size(), 1);
  }
  return out;
}

/// `count` of `of`, without replacement; the same for the same study number.
std::vector<std::size_t> drawPeople(std::size_t count, std::size_t of, std::uint32_t study, std::uint32_t population) {
  std::vector<std::size_t> order(of);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < count; ++i) {
    const auto words = philox({study, static_cast<std::uint32_t>(i), population, 0}, {0x706f7765, 0x72});
    std::swap(order[i], order[i + words[0] % (of - i)]);
  }
  order.resize(count);
  return order;
}

std::vector<std::size_t> ladder(std::size_t least, std::size_t most) {
  std::vector<std::size_t> steps;
  for (const std::size_t step : {5u, 6u, 7u, 8u, 10u, 12u, 15u, 20u, 25u, 30u, 40u, 50u, 70u, 100u, 150u, 200u, 300u, 500u, 1000u})
    if (step >= least && step <= most) steps.push_back(step);
  if (steps.empty() || steps.back() != most) steps.push_back(most);
  return steps;
}

/// Which candidate a truth is among; none: nullopt.
std::optional<std::size_t> candidateOf(const Named& named, const std::string& truth) {
  const auto criterion = predict::criterionFromName(truth);
  return criterion ? analysis::placeOf(named.candidates, *criterion) : std::nullopt;
}

class Reader {
 public:
  explicit Reader(const StudyFolder& folder)
      : folder_(folder), columns_(columnsOf(folder.design)), identity_(identityColumns(folder.design)),
        firstAxis_(identity_ - folder.design.axes.size()), needs_(needsOf(folder.design)), criteria_(criteriaOf(folder.design).size()) {}

  void read(StudyReport& report) {
    for (std::int64_t chunk = 0; chunk < folder_.chunks.count(); ++chunk) {
      const ChunkRows rows = readChunk(folder_.path, chunk, folder_.fingerprint);
      report.trials += rows.rows;
      countSuccess(rows);
      if (needs_.fits) takeScores(rows);
    }
    for (auto& [key, at] : success_) report.success.push_back(std::move(at));
    for (auto& [key, at] : learning_) report.learning.push_back(std::move(at));
  }
  std::vector<Population> populations() {
    std::vector<Population> out;
    for (auto& [key, population] : populations_) out.push_back(std::move(population));
    return out;
  }

 private:
  double at(const ChunkRows& rows, std::size_t column, std::int64_t row) const {
    return rows.values[column * static_cast<std::size_t>(rows.rows) + static_cast<std::size_t>(row)];
  }

  void countSuccess(const ChunkRows& rows) {
    numbered_.reset();
    for (std::int64_t row = 0; row < rows.rows; ++row) {
      const auto outcome = static_cast<trial::Outcome>(at(rows, identity_, row));
      if (isPractice(rows, row)) continue;
      const std::size_t number = numberOf(rows, row);
      if (outcome != trial::Outcome::Success && outcome != trial::Outcome::Failure) continue;
      if (!folder_.design.planText.empty() && at(rows, column::CatchTrial, row) == 1) continue;
      const auto count = [&](std::size_t column, std::size_t order) {
        const double value = at(rows, column, row);
        SuccessAt& share = success_[{order, value}];
        if (share.trials++ == 0) share.key = columns_[column].name, share.value = wordOf(columns_[column], value), share.number = value;
        if (outcome == trial::Outcome::Success) ++share.successes;
      };
      for (std::size_t k = firstAxis_; k < identity_; ++k) count(k, k);
      const std::string block = blockOf(rows, row);
      const std::size_t stretch = (number - 1) / kStretch;
      LearningAt& learning = learning_[{block, stretch}];
      learning.block = block;
      learning.firstTrial = stretch * kStretch + 1;
      learning.lastTrial = std::max(learning.lastTrial, number);
      ++learning.trials;
      if (outcome == trial::Outcome::Success) ++learning.successes;
    }
  }

  std::string blockOf(const ChunkRows& rows, std::int64_t row) const {
    if (folder_.design.planText.empty()) return {};
    const double day = at(rows, column::Day, row);
    return wordOf(columns_[column::Condition], at(rows, column::Condition, row)) + (day > 0 ? fmt::format(" day {}", day) : "");
  }

  bool isPractice(const ChunkRows& rows, std::int64_t row) const {
    return !folder_.design.planText.empty() && at(rows, column::Practice, row) == 1;
  }

  std::pair<std::int64_t, std::int64_t> personOf(const ChunkRows& rows, std::int64_t row) const {
    return {static_cast<std::int64_t>(at(rows, column::Point, row)), static_cast<std::int64_t>(at(rows, column::Subject, row))};
  }

  /// Number of a trial in its condition and day, for rows in their order. A block of a plan may have several conditions, and a condition
  /// several blocks.
  std::size_t numberOf(const ChunkRows& rows, std::int64_t row) {
    if (folder_.design.planText.empty()) return static_cast<std::size_t>(at(rows, firstAxis_ - 2, row));
    if (const auto person = personOf(rows, row); person != numbered_) numbered_ = person, numbers_.clear();
    return ++numbers_[blockOf(rows, row)];
  }

  void takeScores(const ChunkRows& rows) {
    const std::size_t truth = placeOf(columns_, kTruth);
    numbered_.reset();
    // Behind the criteria are the reference, effective samples, and the score of the subject's own mean.
    const std::size_t score = placeOf(columns_, "score_reference") - criteria_;
    for (std::int64_t row = 0; row < rows.rows; ++row) {
      std::string cell;
      for (std::size_t k = firstAxis_; k < identity_; ++k)
        if (k != truth) cell += fmt::format("{}{}={}", cell.empty() ? "" : ", ", columns_[k].name, wordOf(columns_[k], at(rows, k, row)));
      const std::string name = truth < columns_.size() ? wordOf(columns_[truth], at(rows, truth, row)) : usualTruth();
      Population& population = populations_[{cell, name}];
      population.cell = cell;
      population.truth = name;
      PersonTrials& person = population.people[personOf(rows, row)];  // who has no scores is drawn, too
      if (isPractice(rows, row)) continue;
      const std::size_t place = numberOf(rows, row);
      population.trials = std::max(population.trials, place);
      if (!std::isfinite(at(rows, score + criteria_, row))) continue;
      auto& [number, scores] = person[blockOf(rows, row)];
      scores.score.resize(criteria_ + 1);
      for (std::size_t k = 0; k < scores.score.size(); ++k) scores.score[k].push_back(at(rows, score + k, row));
      scores.effectiveSamples = at(rows, score + criteria_ + 1, row);
      scores.own.push_back(at(rows, score + criteria_ + 2, row));
      number.push_back(static_cast<int>(place));
    }
  }

  std::string usualTruth() const {
    for (const auto& [key, value] : folder_.design.subject)
      if (key == "criterion") return value;
    return "min-hand-jerk";  // what a subject who is told none follows
  }

  const StudyFolder& folder_;
  std::vector<Column> columns_;
  std::size_t identity_, firstAxis_;
  Needs needs_;
  std::size_t criteria_;
  std::map<std::pair<std::size_t, double>, SuccessAt> success_;
  std::map<std::pair<std::string, std::size_t>, LearningAt> learning_;  // by block and stretch
  std::map<std::pair<std::string, std::string>, Population> populations_;
  std::optional<std::pair<std::int64_t, std::int64_t>> numbered_;  // whose trials are being numbered
  std::map<std::string, std::size_t> numbers_;                     // the latest of each condition and day
};

/// Draws studies of one design; counts by candidate, undecided last.
std::vector<std::size_t> drawStudies(const Population& population, std::uint32_t number, std::size_t subjects, std::size_t trials,
                                     std::size_t studies, const Named& named) {
  std::vector<const PersonTrials*> people;
  for (const auto& [who, person] : population.people) people.push_back(&person);
  const std::size_t candidates = named.candidates.size();
  std::vector<std::size_t> counts(candidates + 1, 0);
  for (std::size_t study = 0; study < studies; ++study) {
    std::vector<analysis::PersonScores> scores;
    for (const std::size_t i : drawPeople(subjects, people.size(), static_cast<std::uint32_t>(study), number))
      scores.push_back(scoresOf(*people[i], trials, named));
    ++counts[analysis::concludePeople(scores, candidates, candidates - 1).follows.value_or(candidates)];
  }
  return counts;
}

/// The designs that are asked for, from the smallest: the largest gives the confusion.
std::vector<std::size_t> asked(std::vector<std::size_t> numbers, const char* key, std::size_t least, std::size_t most) {
  for (const std::size_t n : numbers)
    if (n < least || n > most)
      throw FaultError(Fault{key, fmt::format("is {}", n), fmt::format("{} to the {} of this study", least, most)});
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

void judgeDesigns(std::vector<Population>& populations, const Named& named, const ReportOptions& options, StudyReport& report) {
  const auto studies = static_cast<std::size_t>(options.studies);
  std::map<std::string, Confusion> confusions;
  for (std::size_t p = 0; p < populations.size(); ++p) {
    const Population& population = populations[p];
    const auto own = candidateOf(named, population.truth);
    const std::size_t there = population.people.size();
    const auto fitted = static_cast<std::size_t>(
        std::count_if(population.people.begin(), population.people.end(), [](const auto& person) { return !person.second.empty(); }));
    if (!own || fitted < analysis::kFewestSubjects) {
      report.notes.push_back(fmt::format("{}{}: {} virtual subjects with {} successes; {}", population.truth,
                                         population.cell.empty() ? "" : " at " + population.cell, fitted, analysis::kFewestTrials,
                                         own ? "nothing is drawn from fewer than five" : "its criterion is not compared"));
      continue;
    }
    const std::vector<std::size_t> people = options.subjects.empty()
                                                ? ladder(analysis::kFewestSubjects, std::max(analysis::kFewestSubjects, there / 2))
                                                : asked(options.subjects, "subjects", analysis::kFewestSubjects, there);
    const std::vector<std::size_t> trials = options.trials.empty()
                                                ? ladder(analysis::kFewestTrials, population.trials)
                                                : asked(options.trials, "trials", analysis::kFewestTrials, population.trials);
    for (const std::size_t s : people)
      for (const std::size_t n : trials) {
        const std::vector<std::size_t> counts = drawStudies(population, static_cast<std::uint32_t>(p), s, n, studies, named);
        report.power.push_back({population.truth, population.cell, s, n, studies, counts[*own], studies - counts[*own] - counts.back()});
        if (s != people.back() || n != trials.back()) continue;
        Confusion& confusion = confusions[population.cell];
        confusion.cell = population.cell;
        confusion.subjects = s;
        confusion.trials = n;
        confusion.named.studies = options.studies;
        confusion.named.candidates = named.candidates;
        confusion.named.counts.resize(named.candidates.size(), std::vector<std::size_t>(named.candidates.size() + 1, 0));
        for (std::size_t k = 0; k < counts.size(); ++k) confusion.named.counts[*own][k] += counts[k];  // truths may have the same hand
      }
    for (const double level : {0.8, 0.95}) {
      SmallestDesign least{population.truth, population.cell, level, 0, 0};
      for (const PowerAt& power : report.power) {
        if (power.truth != population.truth || power.cell != population.cell ||
            static_cast<double>(power.right) < level * static_cast<double>(power.studies))
          continue;
        if (least.subjects == 0 || power.subjects * power.trials < least.subjects * least.trials)
          least.subjects = power.subjects, least.trials = power.trials;
      }
      report.smallest.push_back(least);
    }
  }
  for (auto& [cell, confusion] : confusions) report.confusion.push_back(std::move(confusion));
}

}  // namespace

StudyReport makeReport(const StudyFolder& folder, const ReportOptions& options) {
  if (const std::size_t missing = chunksToDo(folder).missing.size(); missing > 0)
    throw FaultError(Fault{"study", fmt::format("{}: {} of {} chunks are not there yet", folder.path, missing, folder.chunks.count()),
                           "a study that is done"});
  StudyReport report;
  report.name = folder.design.name;
  report.points = pointCount(folder.design);
  report.subjects = folder.design.subjects;
  Reader reader(folder);
  reader.read(report);
  if (!needsOf(folder.design).fits) {
    report.notes.emplace_back("confusion and power need the measure score, which this study did not ask for");
    return report;
  }
  std::vector<Population> populations = reader.populations();
  judgeDesigns(populations, nameCandidates(folder.design, populations), options, report);
  return report;
}

}  // namespace reachlab::study
