#pragma once
#include "gui/scene/scene_overlay.h"
#include "gui/session/session_controller.h"
#include "gui/subject/subject_words.h"

namespace reachlab::gui::app {

/// Texts over the scene for the present state of the session. `mouse`: the mouse is the hand. `massesHide`: masses are at the same
/// position.
scene::OverlayState overlayOf(SessionController& session, bool mouse, bool massesHide);

/// The same for the subject: the next step and the outcome, without names, keys or numbers except the score.
/// `before`: the instructions of the block that a plan begins with, shown until its run is open.
scene::OverlayState subjectsOverlayOf(SessionController& session, const subject::SubjectWords& words, int score,
                                      const QString& before = {});

}  // namespace reachlab::gui::app
