#include "sim/session/recorded_blocks.h"

#include <algorithm>

#include "base/error.h"
#include "sim/record/recover.h"

namespace reachlab::session {
namespace {

// The hand, or who else moves the object, was gone: a run that ends with such a trial has not done it.
bool lostHand(const trial::TrialResult& result) {
  return result.outcome == trial::Outcome::Interrupted &&
         (result.reason == trial::Reason::DeviceLost || result.reason == trial::Reason::PeerLost);
}

}  // namespace

std::vector<RecordedBlock> readRecordedBlocks(const SessionPlace& place, std::vector<std::string>& faults, bool mustRead) {
  std::vector<RecordedBlock> blocks;
  for (const RunOnDisk& run : recordedRuns(place)) {
    try {
      // What lies behind damage is in no table, so it is not done: a session that is resumed does it again.
      const record::RunLog log = record::RunLog::open(run.path, mustRead ? record::LogCheck::Everything : record::LogCheck::Trials);
      if (mustRead && log.goodBytes() < log.fileBytes()) faults.push_back(record::lossOf(log));
      const record::RunConfiguration& configuration = log.configuration();
      auto block = std::find_if(blocks.begin(), blocks.end(),
                                [&](const RecordedBlock& b) { return b.configuration.firstRun == configuration.firstRun; });
      if (block == blocks.end()) block = blocks.insert(blocks.end(), RecordedBlock{.configuration = configuration});
      for (const record::RecordedTrial& trial : log.trials()) {
        block->lastTrial = std::max(block->lastTrial, trial.trial);
        const int index = trial.planned.index;
        const bool last = &trial == &log.trials().back();
        if (trial::endsRun(trial.result) || (last && lostHand(trial.result))) continue;
        const bool again = trial::isPutUpAgain(trial.result) && configuration.repeatAborted && !block->putUpAgain.contains(index);
        (again ? block->putUpAgain : block->done).insert(index);
      }
    } catch (const Error& error) {
      if (mustRead && dynamic_cast<const ResourceError*>(&error) != nullptr) throw;
      faults.emplace_back(error.what());
    }
  }
  return blocks;
}

bool isBlockOf(const record::RunConfiguration& c, const std::string& planText, int day, int block) {
  const bool ofDay = c.day == day || c.day == 0;  // a block of every day was recorded without its day before
  return c.planText == planText && ofDay && c.block == block;
}

std::string otherDeviceBefore(const std::vector<RecordedBlock>& blocks, const std::string& device) {
  const std::string before = blocks.empty() ? device : blocks.back().configuration.device;
  return before == device ? std::string() : before;
}

}  // namespace reachlab::session
