#include "gui/plot/criterion_style.h"

#include "gui/widgets/themes.h"

namespace reachlab::gui::plot {

// Of words and lines on the theme's ground: the same hues, darker on light.
QColor colourOf(predict::Criterion criterion) {
  const auto either = [](const QColor& onLight, const QColor& onDark) {
    return widgets::theme() == widgets::Theme::Light ? onLight : onDark;
  };
  switch (criterion) {
    case predict::Criterion::MinHandJerk: return either({140, 110, 0}, {240, 228, 66});
    case predict::Criterion::MinTorqueChange: return either({160, 60, 115}, {204, 121, 167});
    case predict::Criterion::MinCrackle: return either({0, 120, 105}, {0, 200, 160});
    case predict::Criterion::MinHandForce: return either({190, 35, 35}, {230, 90, 90});
    case predict::Criterion::MinHandForceChange: return either({55, 125, 0}, {86, 220, 110});
    case predict::Criterion::MinComAcceleration: return either({110, 70, 190}, {190, 150, 255});
    default: return either({95, 95, 95}, {180, 180, 180});  // one that has no colour of its own yet
  }
}

QString titleOf(predict::Criterion criterion) {
  const std::string_view name = predict::nameOf(criterion);
  QString title = QString::fromUtf8(name.data(), static_cast<int>(name.size()));
  return title.replace(QStringLiteral("min-"), QStringLiteral("min. ")).replace(QLatin1Char('-'), QLatin1Char(' '));
}

}  // namespace reachlab::gui::plot
