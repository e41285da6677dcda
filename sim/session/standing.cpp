#include "sim/session/standing.h"

#include <algorithm>

#include "sim/session/progress.h"

namespace reachlab::session {

int SessionStanding::blocksDone() const {
  return static_cast<int>(std::count_if(blocks.begin(), blocks.end(), [](const BlockStanding& b) { return b.complete(); }));
}

bool SessionStanding::begun() const {
  return std::any_of(blocks.begin(), blocks.end(), [](const BlockStanding& b) { return b.begun(); });
}

SessionStanding standingOf(const SessionRequest& request, const Programme& programme) {
  SessionRequest fresh = request;
  fresh.resume = false;
  fresh.run.reset();
  SessionStanding standing;
  const SessionToRun session = planSession(fresh, programme);
  const std::vector<BlockProgress> progress = readProgress(request.place, standing.unreadable);
  for (const BlockToRun& block : session.blocks) {
    const record::RunConfiguration& c = block.configuration;
    BlockStanding one{c.block, c.condition,       c.experimentName,  c.practice, static_cast<int>(block.trials.size()),
                      0,       block.restSeconds, block.instructions};
    for (const BlockProgress& recorded : progress)
      if (recorded.configuration.planText == c.planText && recorded.configuration.block == c.block &&
          recorded.configuration.experimentName == c.experimentName)
        one.done = std::max(one.done, static_cast<int>(recorded.done.size()));
    standing.blocks.push_back(std::move(one));
  }
  return standing;
}

}  // namespace reachlab::session
