#pragma once
#include <string>

#include "gui/widgets/colours.h"

namespace reachlab::gui::widgets {

enum class Theme { Dark, Light };

/// Before the first widget is made; what is drawn already keeps its colours.
void setTheme(Theme theme);
Theme theme();
/// One of the dark palette as the theme has it; any other colour as it is.
Colour themed(const Colour& colour);
/// Of "#rrggbb".
Colour colourOf(const std::string& hex);

}  // namespace reachlab::gui::widgets
