#pragma once
#include "gui/scene/scene_overlay.h"

namespace reachlab::gui::subject {
class SubjectWords;
}

namespace reachlab::gui::app {

class SessionController;

/// Texts over the scene for the present state of the session. `mouse`: the mouse is the hand. `massesHide`: masses are at the same
/// position.
scene::OverlayState overlayOf(SessionController& session, bool mouse, bool massesHide);

/// The same for the subject: the next step and the outcome, without names, keys or numbers except the score.
scene::OverlayState subjectsOverlayOf(SessionController& session, const subject::SubjectWords& words, int score);

}  // namespace reachlab::gui::app
