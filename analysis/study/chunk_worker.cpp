#include "analysis/study/chunk_worker.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/study/gzip.h"
#include "base/error.h"
#include "base/table_text.h"
#include "sim/experiment/experiment.h"
#include "sim/session/block_scenes.h"
#include "sim/session/planned_trials.h"
#include "sim/subjects/subject_kinds.h"
#include "sim/trial/task_check.h"

namespace reachlab::study {
namespace {

constexpr std::size_t kMostKits = 16;  // a plan's conditions, some points apart

// Text and numbers of the table, from its rows.
std::string csvOf(const std::vector<Column>& columns, const std::vector<double>& rows, std::size_t count) {
  TableText table(',', "");
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double value = rows[row * columns.size() + k];
      const std::vector<std::string>& words = columns[k].words;
      if (words.empty()) table.number(value);
      else table.cell(std::isfinite(value) ? words.at(static_cast<std::size_t>(value)) : "");
    }
    table.endRow();
  }
  return table.takeText();
}

experiment::CompiledExperiment openPoint(const PointExperiment& point) {
  experiment::CompiledExperiment experiment = experiment::openExperimentText(point.text, point.name, point.definition);
  trial::checkTask(experiment, point.name);
  if (!experiment.experiment().hands.empty())
    throw FaultError(Fault{"hands", "are several, and a virtual subject has one", "an experiment for one hand"});
  return experiment;
}

std::vector<experiment::CompiledExperiment> openScenes(const PointExperiment& point, const session::PlanBlock& block) {
  std::vector<experiment::CompiledExperiment> scenes;
  for (const session::BlockScene& scene : session::scenesOf(block, openPoint(point))) scenes.push_back(scene.experiment);
  return scenes;
}

std::string textOf(const PointExperiment& experiment, const session::PlanBlock& block) {
  nlohmann::ordered_json mix;
  session::writeMix(mix, block.mix);
  return experiment.text + mix.dump();
}

std::size_t placeOf(const std::vector<std::string>& words, const std::string& word) {
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), word) - words.begin());
}

}  // namespace

ChunkWorker::ChunkWorker(const Design& design)
    : design_(design), needs_(needsOf(design)), columns_(columnsOf(design)), identity_(identityColumns(design)) {}

ChunkWorker::Kit& ChunkWorker::kitFor(const std::string& device, const PointExperiment& experiment, const session::PlanBlock& block) {
  const std::string text = textOf(experiment, block);
  for (Kit& kit : kits_)
    if (kit.device == device && kit.text == text) return kit;
  Kit kit;
  kit.device = device;
  kit.text = text;
  for (const Kit& other : kits_)
    if (other.text == kit.text) kit.scenes = other.scenes;
  if (kit.scenes.empty()) kit.scenes = openScenes(experiment, block);
  kit.hands = subjects::prepareSubjects(kit.scenes, device);
  for (const experiment::CompiledExperiment& scene : kit.scenes) kit.measurers.push_back(std::make_unique<Measurer>(design_, scene));
  kits_.push_front(std::move(kit));
  kits_.front().run = std::make_unique<BlockRun>(kits_.front().scenes, needs_.samples);
  if (kits_.size() > kMostKits) kits_.pop_back();
  return kits_.front();
}

void ChunkWorker::computeSubject(std::int64_t subject, std::vector<MeasuredTrial>& trials, std::vector<double>& identity) {
  const bool ofPlan = !design_.planText.empty();
  std::shared_ptr<void> learnt;
  std::vector<double> who(identity_, std::nan(""));
  who[column::Point] = static_cast<double>(point_->index);
  who[column::Subject] = static_cast<double>(subject);
  const std::size_t firstAxis = identity_ - design_.axes.size(), trialColumn = firstAxis - 2;
  for (std::size_t k = 0; k < design_.axes.size(); ++k) {
    const Column& column = columns_[firstAxis + k];
    const VariedKey& axis = design_.axes[k];
    who[firstAxis + k] = column.words.empty() ? std::strtod(point_->ofAxes[k].value.c_str(), nullptr)
                                              : static_cast<double>(placeOf(axis.values, point_->ofAxes[k].value));
  }
  for (const int day : task_.days) {
    const std::uint64_t seed = seedOf(design_, point_->index, subject, day);
    int number = 0;
    for (const int index : session::blockOrder(task_.plan, labelOfSubject(subject), day)) {
      const session::PlanBlock& block = task_.plan.blocks[static_cast<std::size_t>(index)];
      const std::uint64_t own = session::blockSeed(seed, ++number);
      Kit& kit = kitFor(task_.device, task_.experiments[static_cast<std::size_t>(index)], block);
      BlockRun& run = *kit.run;
      run.begin(kit.hands(own, day, learnt));
      if (ofPlan) {
        who[column::Session] = who[column::Day] = day;
        who[column::Block] = number;
        who[column::Practice] = block.practice ? 1 : 0;
      }
      who[trialColumn + 1] = static_cast<double>(seed);
      const std::size_t first = trials.size();
      const std::vector<session::SceneName> names = session::sceneNames(block);
      for (const trial::PlannedTrial& planned : session::planTrials(block, own)) {
        const record::RecordedTrial& recorded = run.runTrial(planned);
        const auto scene = static_cast<std::size_t>(planned.scene);
        trials.push_back(kit.measurers[scene]->measure(run, recorded, block.practice, trials.size() - first));
        if (ofPlan) {
          const std::size_t condition = placeOf(columns_[column::Condition].words, names[scene].condition);
          if (condition == columns_[column::Condition].words.size())
            throw FaultError(Fault{"plan.blocks", "have a condition that the plan has not", "the plan's own conditions"});
          who[column::Condition] = static_cast<double>(condition);
          who[column::CatchTrial] = planned.catchTrial ? 1 : 0;
        }
        who[trialColumn] = recorded.trial;
        identity.insert(identity.end(), who.begin(), who.end());
      }
      for (const auto& measurer : kit.measurers) measurer->fitBlock(trials, first);
    }
  }
}

std::optional<ChunkRows> ChunkWorker::compute(const PairRange& pairs, const std::function<bool(std::int64_t trials)>& goOn) {
  std::vector<double> rows;
  ChunkRows out;
  out.columns = columns_.size();
  std::vector<MeasuredTrial> trials;
  std::vector<double> identity;
  for (std::int64_t pair = pairs.first; pair < pairs.end; ++pair) {
    const std::int64_t index = pair / design_.subjects, subject = pair % design_.subjects + 1;
    if (!point_ || point_->index != index) {
      const Point point = pointAt(design_, index);
      task_ = taskOf(design_, point);
      point_ = point;
    }
    trials.clear();
    identity.clear();
    try {
      computeSubject(subject, trials, identity);
    } catch (const Error&) {
      rethrowAt(*point_);
    }
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const auto begin = identity.begin() + static_cast<std::ptrdiff_t>(i * identity_);
      rows.insert(rows.end(), begin, begin + static_cast<std::ptrdiff_t>(identity_));
      rows.resize(rows.size() + out.columns - identity_);
      putMeasures(design_, trials[i], {rows.data() + rows.size() - out.columns, out.columns});
      if (!design_.profiles) continue;
      trials[i].profile.resize(kProfileNumbers, std::nanf(""));
      out.profiles.insert(out.profiles.end(), trials[i].profile.begin(), trials[i].profile.end());
    }
    if (!goOn(static_cast<std::int64_t>(trials.size()))) return std::nullopt;
  }
  const std::size_t count = rows.size() / out.columns;
  out.rows = static_cast<std::int64_t>(count);
  out.csvGz = gzipMember(csvOf(columns_, rows, count));
  out.values.resize(rows.size());
  for (std::size_t row = 0; row < count; ++row)
    for (std::size_t k = 0; k < out.columns; ++k) out.values[k * count + row] = rows[row * out.columns + k];
  return out;
}

void checkPoint(const Design& design, std::int64_t index, std::set<std::pair<std::string, std::string>>& seen) {
  const Point point = pointAt(design, index);
  const PointTask task = taskOf(design, point);
  for (std::size_t i = 0; i < task.experiments.size(); ++i) {
    const PointExperiment& one = task.experiments[i];
    const session::PlanBlock& block = task.plan.blocks[i];
    if (!seen.emplace(task.device, textOf(one, block)).second) continue;
    try {
      const std::vector<experiment::CompiledExperiment> scenes = openScenes(one, block);
      std::shared_ptr<void> learnt;
      BlockRun(scenes, false).begin(subjects::prepareSubjects(scenes, task.device)(1, 0, learnt));
    } catch (const Error&) {
      rethrowAt(point);
    }
  }
}

}  // namespace reachlab::study
