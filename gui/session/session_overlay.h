#pragma once
#include "gui/scene/scene_overlay.h"

namespace reachlab::gui::subject {
class SubjectWords;
}

namespace reachlab::gui::app {

class SessionController;

/// What stands over the scene for the session as it is. `mouse`: the pointer is the hand; `massesHide`: masses stand at one place.
scene::OverlayState overlayOf(SessionController& session, bool mouse, bool massesHide);

/// The same for the subject, of what its screen shows: what to do and how it went, without a number (but the score), a name or a key.
scene::OverlayState subjectsOverlayOf(SessionController& session, const subject::SubjectWords& words, int score);

}  // namespace reachlab::gui::app
