#pragma once
#include <string>

#include "gui/widgets/colours.h"

namespace reachlab::gui::widgets {

enum class Theme { Dark, Light };

/// Call it before the first widget is made. Widgets that are already drawn keep their colours.
void setTheme(Theme theme);
Theme theme();
/// A colour of the dark palette as the theme has it. Other colours are unchanged.
Colour themed(const Colour& colour);
/// Of "#rrggbb".
Colour colourOf(const std::string& hex);

}  // namespace reachlab::gui::widgets
