#pragma once
#include "gui/session/session_controller.h"

namespace reachlab::gui::app {

/// The state of a session, which decides the next step and the enabled actions.
enum class SessionStage {
  Closed,
  BetweenTrials,
  UnderWay,
  BlockDone,  // the plan has a next block
  Finished,
  Following  // another station conducts
};
SessionStage stageOf(SessionController& session);

}  // namespace reachlab::gui::app
