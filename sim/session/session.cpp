#include "sim/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "base/as_number.h"
#include "base/fault.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "sim/experiment/experiment.h"
#include "sim/record/export/bids.h"
#include "sim/record/log/append_file.h"
#include "sim/record/log/run_writer.h"
#include "sim/session/recorded_blocks.h"
#include "sim/session/planned_trials.h"
#include "sim/trial/task_check.h"

namespace reachlab::session {
namespace {

// A single experiment has as many trials as are asked for, or on offer.
Plan planOf(const SessionRequest& request, const Programme& programme) {
  Plan plan = programme.plan;
  if (programme.isPlan() && request.trials) throw FaultError(Fault{"trials", "a plan says how many", "none, or an experiment instead"});
  if (!programme.isPlan()) plan.blocks.at(0).trials = request.trials.value_or(request.trialsOnOffer);
  return plan;
}

bool isOf(const record::RunConfiguration& c, const experiment::Experiment& experiment) {
  return c.experimentText == experiment.text && (c.definitionText.empty() || c.definitionText == experiment::definitionTextOf(experiment));
}

// The plan's text is the same, and so are the scenes, unless another program has made them.
bool hasScenes(const record::RunConfiguration& c, const std::vector<BlockScene>& scenes) {
  if (!c.scenes) return scenes.size() == 1;
  return std::equal(c.scenes->begin(), c.scenes->end(), scenes.begin(), scenes.end(), [](const record::RunScene& a, const BlockScene& b) {
    return a.condition == b.condition && a.experimentText == b.experiment.experiment().text;
  });
}

// `first`: the recording of the session's first block that has one. Those of the blocks after it are of the same session, and not of one that
// was recorded before it.
const RecordedBlock* findRecordedBlock(const std::vector<RecordedBlock>& blocks, const Plan& plan, int day, int number,
                                       const experiment::Experiment& experiment, const RecordedBlock* first) {
  const RecordedBlock* found = nullptr;
  for (const RecordedBlock& block : blocks) {
    const record::RunConfiguration& c = block.configuration;
    const bool same = plan.text.empty() ? c.planText.empty() && isOf(c, experiment) : isBlockOf(c, plan.text, day, number);
    const bool ofSession =
        first == nullptr || (c.sessionSeed == first->configuration.sessionSeed && c.firstRun > first->configuration.firstRun);
    if (same && ofSession) found = &block;
  }
  return found;
}

[[noreturn]] void refuseToResume(const std::string& changed, int run) {
  throw FaultError(Fault{"resume", fmt::format("{} has changed since run {}, so that run cannot be resumed", changed, run),
                         "the file as it was, or a new run"});
}

// A changed file under the name of a recorded one is no longer the same block.
void refuseChanged(const std::vector<RecordedBlock>& blocks, const Plan& plan, const experiment::Experiment& experiment) {
  for (const RecordedBlock& block : blocks) {
    const record::RunConfiguration& c = block.configuration;
    const bool changed = plan.text.empty() ? c.planText.empty() && c.experimentName == experiment.name
                                           : c.planName == plan.name && c.planText != plan.text;  // or it is of another day
    if (changed && !block.complete()) refuseToResume(plan.text.empty() ? experiment.name : plan.name, c.run);
  }
}

void checkSameWishes(const SessionRequest& request, const RecordedBlock& block) {
  const auto planned = static_cast<int>(block.configuration.trials.size());
  if (request.trials && *request.trials != planned)
    throw FaultError(
        Fault{"trials",
              fmt::format("are {}, and run {}, which is resumed, was planned with {}", *request.trials, block.configuration.run, planned),
              fmt::format("none, or {}", planned)});
  if (request.seed && *request.seed != block.configuration.sessionSeed)
    throw FaultError(Fault{"seed", fmt::format("is {}, and run {}, which is resumed, has another", *request.seed, block.configuration.run),
                           fmt::format("none, or {}", block.configuration.sessionSeed)});
}

record::RunConfiguration freshConfiguration(const SessionRequest& request, const Plan& plan, const PlanBlock& block, int day,
                                            const experiment::Experiment& experiment, const std::vector<BlockScene>& scenes) {
  record::RunConfiguration c;
  c.subject = request.place.subject;
  c.session = request.place.session;
  c.task = labelOf(experiment.name);
  c.practice = block.practice;
  c.condition = block.condition;
  c.day = day;
  c.pauseSeconds = block.pauseSeconds;
  c.repeatAborted = block.repeatAborted;
  c.experimentName = experiment.name;
  c.condition = record::conditionOf(c);
  c.experimentText = experiment.text;
  c.definitionText = experiment::definitionTextOf(experiment);
  c.planName = plan.text.empty() ? "" : plan.name;
  c.planText = plan.text;
  c.orderSeed = plan.orderSeed;
  if (block.mix.isPlain()) return c;
  c.scenes.emplace();
  for (const BlockScene& scene : scenes)
    c.scenes->push_back({scene.kind, scene.target, scene.condition, scene.experiment.experiment().text, {}, {}});
  return c;
}

std::vector<experiment::CompiledExperiment> experimentsOf(const std::vector<BlockScene>& scenes) {
  std::vector<experiment::CompiledExperiment> experiments;
  for (const BlockScene& scene : scenes) experiments.push_back(scene.experiment);
  return experiments;
}

// What a log will hold of a block, as far as it is known without a device, goes through the rules of its reader.
void addUnreadable(record::RunConfiguration c, const experiment::CompiledExperiment& experiment, const std::vector<BlockScene>& scenes,
                   std::vector<Fault>& faults) {
  const std::string& name = experiment.experiment().name;
  if (const auto fault = record::labelFault(c.task, "task"))
    return faults.push_back({"name", fmt::format("\"{}\" has {} letters and digits", name, c.task.size()),
                             fault->allowed + ", of which the names of its recordings are made"});
  c.table = record::makeChannelTable(record::channelsOfAll(experimentsOf(scenes)), experiment.constraint().parameterCount());
  c.otherHands.resize(static_cast<std::size_t>(c.table.hands - 1));
  try {
    (void)record::readableText(c, name);
  } catch (const FaultError& error) {
    faults.insert(faults.end(), error.faults.begin(), error.faults.end());
  }
}

// In their order, and behind them the repeats of aborted ones.
void addRemainingTrials(BlockToRun& block, const RecordedBlock* before) {
  std::vector<trial::PlannedTrial> repeats;
  for (const trial::PlannedTrial& planned : block.configuration.trials) {
    if (before != nullptr && before->done.contains(planned.index)) continue;
    (before != nullptr && before->putUpAgain.contains(planned.index) ? repeats : block.trials).push_back(planned);
  }
  block.trials.insert(block.trials.end(), repeats.begin(), repeats.end());
  block.repeats = repeats.size();
}

// A block that broke off goes on with the number of the trial it broke off in. Where single trials are left (repeats of aborted
// ones), they get numbers that were not used yet.
int firstTrialOf(const std::vector<trial::PlannedTrial>& remaining, const RecordedBlock* before) {
  if (before == nullptr) return 1;
  const bool oneStretch = remaining.back().index - remaining.front().index + 1 == static_cast<int>(remaining.size());
  return oneStretch && before->lastTrial <= remaining.front().index + 1 ? remaining.front().index + 1 : before->lastTrial + 1;
}

// A block of the session in its order, with what was recorded of it.
struct OrderedBlock {
  int number;  // from 1
  const PlanBlock& planned;
  const experiment::CompiledExperiment& experiment;
  const std::vector<BlockScene>& scenes;
  const RecordedBlock* recorded;  // null: nothing
};

void checkRequest(const SessionRequest& request) {
  std::vector<Fault> faults = record::problems(request.participant);
  for (const auto& [key, label] : {std::pair{"subject", request.place.subject}, std::pair{"session", request.place.session}})
    if (const auto fault = record::labelFault(label, key)) faults.push_back(*fault);
  if (liesInSourcedata(request.place.data))
    faults.push_back({"data", fmt::format("is {}, which lies in a dataset's sourcedata", request.place.data),
                      "a folder elsewhere: recordings and inputs are not written over"});
  if (!faults.empty()) throw FaultError(std::move(faults));
}

void refuseOpenRuns(const SessionPlace& place) {
  for (const RunOnDisk& run : recordedRuns(place))
    if (record::isBeingWritten(run.path))
      throw ResourceError(fmt::format("run {} is being recorded{} into {}; wait until it has ended, then resume", run.run,
                                      record::writerOf(run.path), run.path));
}

std::vector<OrderedBlock> orderBlocks(const SessionRequest& request, const Programme& programme, const Plan& plan, int day,
                                      const std::vector<int>& order, const std::vector<RecordedBlock>& recorded) {
  std::vector<OrderedBlock> blocks;
  const RecordedBlock* first = nullptr;
  for (const int index : order) {
    const auto k = static_cast<std::size_t>(index);
    const int number = static_cast<int>(blocks.size()) + 1;
    const experiment::CompiledExperiment& experiment = programme.experiments.at(k);
    trial::checkTask(experiment, programme.isPlan() ? plan.blocks[k].experiment : request.what);
    const RecordedBlock* found = findRecordedBlock(recorded, plan, day, number, experiment.experiment(), first);
    if (first == nullptr) first = found;
    blocks.push_back({number, plan.blocks[k], experiment, programme.scenes.at(k), found});
  }
  return blocks;
}

// The first block that was recorded of the session to resume; null if there is none. Throws FaultError if a file has changed since.
const RecordedBlock* findResumed(const SessionRequest& request, const Plan& plan, const std::vector<OrderedBlock>& blocks,
                                 const std::vector<RecordedBlock>& recorded) {
  const auto first = std::find_if(blocks.begin(), blocks.end(), [](const OrderedBlock& block) { return block.recorded != nullptr; });
  if (first == blocks.end()) {
    refuseChanged(recorded, plan, blocks.front().experiment.experiment());
    return nullptr;
  }
  checkSameWishes(request, *first->recorded);
  for (const OrderedBlock& block : blocks) {
    if (block.recorded == nullptr) continue;
    const record::RunConfiguration& c = block.recorded->configuration;
    const experiment::Experiment& experiment = block.experiment.experiment();
    if (!isOf(c, experiment) || !hasScenes(c, block.scenes)) refuseToResume(experiment.name, c.run);
  }
  return first->recorded;
}

// The seed of the session that is resumed, before that the one asked for, else a drawn one.
void chooseSeed(const SessionRequest& request, const RecordedBlock* resumed, SessionToRun& session) {
  if (resumed != nullptr) session.seed = resumed->configuration.sessionSeed;
  else if (request.seed) session.seed = *request.seed;
  else {
    session.seed = drawSeed();
    session.notice.seedDrawn = true;
  }
}

// What is left of a block, without its run. `before`: the part that is resumed.
BlockToRun makeBlock(const SessionRequest& request, const Plan& plan, int day, const OrderedBlock& ordered, const RecordedBlock* before,
                     std::uint64_t seed) {
  BlockToRun block{
      .experiment = ordered.experiment, .scenes = experimentsOf(ordered.scenes), .configuration = {}, .logPath = {}, .trials = {}};
  block.restSeconds = ordered.planned.restSeconds;
  block.instructions = ordered.planned.instructions;
  record::RunConfiguration& c = block.configuration;
  if (before != nullptr) {
    c = before->configuration;
  } else {
    c = freshConfiguration(request, plan, ordered.planned, day, block.experiment.experiment(), ordered.scenes);
    c.block = ordered.number;
    c.sessionSeed = seed;
    c.seed = blockSeed(seed, c.block);
    c.trials = planTrials(ordered.planned, c.seed);
  }
  addRemainingTrials(block, before);
  c.device = request.device;
  c.participant = request.participant;
  c.notes = request.notes;
  c.sampleEveryTicks = request.everyTick ? 1 : 10;
  c.samplingHz = kTicksPerSecond / c.sampleEveryTicks;
  return block;
}

}  // namespace

void checkRecordable(const Programme& programme) {
  std::vector<Fault> faults;
  for (std::size_t k = 0; k < programme.experiments.size(); ++k) {
    const PlanBlock& block = programme.plan.blocks.at(k);
    record::RunConfiguration c =
        freshConfiguration({}, programme.plan, block, block.day, programme.experiments[k].experiment(), programme.scenes.at(k));
    c.trials = planTrials(block, 0);
    addUnreadable(std::move(c), programme.experiments[k], programme.scenes.at(k), faults);
  }
  if (!faults.empty()) throw FaultError(std::move(faults));
}

int sessionDay(const SessionRequest& request, const Plan& plan) {
  const bool daysMatter = std::any_of(plan.blocks.begin(), plan.blocks.end(), [](const PlanBlock& block) { return block.day != 0; });
  if (!daysMatter && request.day)
    throw FaultError(
        Fault{"day", fmt::format("is {}, and {} has no days", *request.day, plan.text.empty() ? "an experiment" : "the plan " + plan.name),
              "none"});
  if (!daysMatter) return 0;
  const std::string& label = request.place.session;
  const std::optional<int> asked = request.day ? request.day : asNumber<int>(label);
  if (!asked)
    throw FaultError(Fault{"session", fmt::format("\"{}\" is no number, and the plan {} has days", label, plan.name),
                           "01, 02 …, or a day given separately"});
  if (*asked < 1)
    throw FaultError(
        Fault{"session", fmt::format("\"{}\" is day 0, and the days of the plan {} begin with 1", label, plan.name), "01, 02 …"});
  return *asked;
}

std::string seedFault(const std::string& text) {
  return asNumber<std::uint64_t>(text) ? std::string() : toText({{}, "is " + text, "0 to 18446744073709551615"});
}

std::uint64_t drawSeed() {
  std::random_device entropy;
  return (static_cast<std::uint64_t>(entropy()) << 21) ^ entropy();  // at most 2^53, so that every reader of the dataset keeps it exact
}

SessionToRun planSession(const SessionRequest& request, const Programme& programme) {
  checkRequest(request);
  const Plan plan = planOf(request, programme);
  const int day = sessionDay(request, plan);
  const std::vector<int> order = blockOrder(plan, request.place.subject, day);
  if (order.empty())
    throw FaultError(Fault{"day", fmt::format("is {}, for which the plan {} has no block", day, plan.name), "a day that it has"});

  SessionToRun session;
  if (request.resume) refuseOpenRuns(request.place);
  const std::vector<RecordedBlock> recorded = readRecordedBlocks(request.place, session.notice.leftOut, request.resume);
  const std::vector<OrderedBlock> blocks = orderBlocks(request, programme, plan, day, order, recorded);
  const RecordedBlock* resumed = request.resume ? findResumed(request, plan, blocks, recorded) : nullptr;
  chooseSeed(request, resumed, session);
  if (resumed != nullptr) session.notice.deviceBefore = otherDeviceBefore(recorded, request.device);

  std::vector<Fault> faults;
  int run = chooseRun(request.place, request.run);
  for (const OrderedBlock& ordered : blocks) {
    const RecordedBlock* before = request.resume ? ordered.recorded : nullptr;
    BlockToRun block = makeBlock(request, plan, day, ordered, before, session.seed);
    if (block.trials.empty()) continue;
    if (!session.blocks.empty()) run = chooseRun(request.place, run + 1);
    block.configuration.run = run;
    block.configuration.firstTrial = firstTrialOf(block.trials, before);
    if (before == nullptr) block.configuration.firstRun = run;
    block.logPath = logPath(request.place, block.configuration.task, run);
    addUnreadable(block.configuration, block.experiment, ordered.scenes, faults);
    session.blocks.push_back(std::move(block));
  }
  if (!faults.empty()) throw FaultError(std::move(faults));
  const auto anyRecorded = [&](bool complete) {
    return std::any_of(blocks.begin(), blocks.end(),
                       [&](const OrderedBlock& block) { return block.recorded != nullptr && block.recorded->complete() == complete; });
  };
  session.notice.unfinished = !request.resume && anyRecorded(false);
  session.notice.again = !request.resume && programme.isPlan() && anyRecorded(true);
  session.notice.nothingToResume = request.resume && resumed == nullptr;
  for (std::string& sentence : record::keptOfParticipant(request.place.data, request.place.subject, request.participant))
    session.notice.leftOut.push_back(std::move(sentence));
  return session;
}

void takeFreeRun(BlockToRun& block, const SessionPlace& place, bool askedFor) {
  record::RunConfiguration& c = block.configuration;
  const std::vector<RunOnDisk> runs = takenRuns(place);
  if (std::none_of(runs.begin(), runs.end(), [&](const RunOnDisk& run) { return run.run == c.run; })) return;
  if (c.firstRun != c.run)
    throw ResourceError(
        fmt::format("run {} of this session was taken by another program that resumes it as well{}; wait until it has ended, then resume",
                    c.run, record::writerOf(block.logPath)));
  const int run = chooseRun(place, askedFor ? std::optional(c.run) : std::nullopt);
  if (c.firstRun == c.run) c.firstRun = run;
  c.run = run;
  block.logPath = logPath(place, c.task, run);
}

}  // namespace reachlab::session
