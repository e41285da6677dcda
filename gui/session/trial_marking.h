#pragma once

namespace reachlab::gui::docks {
class TrialsDock;
}

namespace reachlab::gui::app {

class MessageBar;
class SessionController;

/// Flags and exclusions of the trials of the run that is open: asked for in the dock, kept beside the log at once, shown in the dock.
void wireMarking(docks::TrialsDock& dock, SessionController& session, MessageBar& message);

}  // namespace reachlab::gui::app
