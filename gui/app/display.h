#pragma once

namespace reachlab::gui::app {

/// Whether the X server that DISPLAY names accepts a window. Qt ends the program where it does not, so it is asked first.
bool displayAnswers();

}  // namespace reachlab::gui::app
