#pragma once

namespace reachlab::gui::docks {
class TrialsDock;
}

namespace reachlab::gui::widgets {
class Messages;
}

namespace reachlab::gui::app {

class SessionController;

/// Connects flags and exclusions of the open run's trials. The dock asks for them and shows them, and a file beside the log keeps them at
/// once.
void wireMarking(docks::TrialsDock& dock, SessionController& session, widgets::Messages& message);

}  // namespace reachlab::gui::app
