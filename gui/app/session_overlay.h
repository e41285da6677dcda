#pragma once
#include "gui/scene/scene_overlay.h"

namespace reachlab::gui::app {

class SessionController;

/// What stands over the scene for the session as it is. `mouse`: the pointer is the hand; `massesHide`: masses stand at one place.
scene::OverlayState overlayOf(SessionController& session, bool mouse, bool massesHide);

/// The same for the subject: what to do and how it went, without a number, a name or a key.
scene::OverlayState subjectsOverlayOf(SessionController& session);

}  // namespace reachlab::gui::app
