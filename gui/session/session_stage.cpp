#include "gui/session/session_stage.h"

namespace reachlab::gui::app {

SessionStage stageOf(SessionController& session) {
  const session::RecordedRun* run = session.run();
  return session.observes()         ? SessionStage::Following
         : run == nullptr           ? SessionStage::Closed
         : session.underWay()       ? SessionStage::UnderWay
         : session.follows()        ? SessionStage::Following
         : run->trialsLeft() > 0    ? SessionStage::BetweenTrials
         : session.blocksLeft() > 0 ? SessionStage::BlockDone
                                    : SessionStage::Finished;
}

}  // namespace reachlab::gui::app
