#pragma once
#include <string>

/// The window's palette: dark, legible from a distance, and distinct for colour-blind eyes (blue, orange and sky of Okabe and Ito).
/// Components in [0, 1]. toQColor is with the widgets.
namespace reachlab::gui::widgets {

struct Colour {
  double red = 0, green = 0, blue = 0;
};

namespace colours {
inline constexpr Colour kSkyTop{0.125, 0.155, 0.205}, kSkyBottom{0.045, 0.055, 0.080};
inline constexpr Colour kRail{0.62, 0.66, 0.72};
inline constexpr Colour kSurface{0.30, 0.55, 0.78}, kSurfaceLine{0.72, 0.84, 0.95};
inline constexpr Colour kStart{0.60, 0.66, 0.74}, kTarget{0.98, 0.86, 0.30};
inline constexpr Colour kDriven{0.24, 0.60, 0.96}, kMiddle{0.70, 0.74, 0.80}, kLast{0.96, 0.52, 0.13};
inline constexpr Colour kHand{0.97, 0.98, 1.00}, kHandLost{0.85, 0.25, 0.25};
inline constexpr Colour kTrace{1.00, 0.47, 0.76};
inline constexpr Colour kSpring{0.80, 0.84, 0.90}, kCoupling{0.55, 0.80, 0.98};
inline constexpr Colour kNeutral{0.42, 0.46, 0.52}, kGreen{0.20, 0.82, 0.42}, kRed{0.94, 0.26, 0.24};
// The semaphore's lamps: at least 3 : 1 in luminance between green and red, for deuteranopes too, and against the background.
inline constexpr Colour kLampNeutral{0.50, 0.54, 0.60}, kLampGreen{0.30, 0.95, 0.50}, kLampRed{0.76, 0.08, 0.10};
inline constexpr Colour kText{0.93, 0.95, 0.98}, kFaintText{0.66, 0.71, 0.78}, kBadText{1.00, 0.62, 0.55};
inline constexpr Colour kWindow{0.115, 0.130, 0.160}, kBase{0.075, 0.086, 0.108}, kButton{0.175, 0.198, 0.240}, kAccent{0.24, 0.60, 0.96};
}  // namespace colours

enum class Theme { Dark, Light };

/// Call it before the first widget is made. Widgets that are already drawn keep their colours.
void setTheme(Theme theme);
Theme theme();
/// A colour of the dark palette as the theme has it. Other colours are unchanged.
Colour themed(const Colour& colour);
/// Of "#rrggbb".
Colour colourOf(const std::string& hex);

}  // namespace reachlab::gui::widgets
