#pragma once
#include "gui/scene/scene_overlay.h"
#include "gui/session/session_controller.h"
#include "gui/subject/subject_words.h"

namespace reachlab::gui::app {

/// Texts over the scene for the present state of the session. `mouse`: the mouse is the hand. `massesHide`: masses are at the same
/// position.
scene::OverlayState overlayOf(SessionController& session, bool mouse, bool massesHide);

/// The same for the subject: the next step and the outcome, without names, keys or numbers except the score.
scene::OverlayState subjectsOverlayOf(SessionController& session, const subject::SubjectWords& words, int score);

}  // namespace reachlab::gui::app
