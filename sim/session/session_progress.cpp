#include "sim/session/session_progress.h"

#include <algorithm>

#include "sim/session/recorded_blocks.h"

namespace reachlab::session {

int SessionProgress::blocksDone() const {
  return static_cast<int>(std::count_if(blocks.begin(), blocks.end(), [](const BlockProgress& b) { return b.complete(); }));
}

bool SessionProgress::begun() const {
  return std::any_of(blocks.begin(), blocks.end(), [](const BlockProgress& b) { return b.begun(); });
}

SessionProgress progressOf(const SessionRequest& request, const Programme& programme) {
  SessionRequest fresh = request;
  fresh.resume = false;
  fresh.run.reset();
  SessionProgress progress;
  const SessionToRun session = planSession(fresh, programme);
  const std::vector<RecordedBlock> before = readRecordedBlocks(request.place, progress.unreadable);
  for (const BlockToRun& block : session.blocks) {
    const record::RunConfiguration& c = block.configuration;
    BlockProgress one{c.block, c.condition,       c.experimentName,  c.practice, static_cast<int>(block.trials.size()),
                      0,       block.restSeconds, block.instructions};
    for (const RecordedBlock& recorded : before)
      if (isBlockOf(recorded.configuration, c.planText, c.day, c.block) && recorded.configuration.experimentName == c.experimentName)
        one.done = std::max(one.done, static_cast<int>(recorded.done.size()));
    progress.blocks.push_back(std::move(one));
  }
  return progress;
}

}  // namespace reachlab::session
