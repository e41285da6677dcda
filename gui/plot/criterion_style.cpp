#include "gui/plot/criterion_style.h"

namespace reachlab::gui::plot {

QColor colourOf(predict::Criterion criterion) {
  switch (criterion) {
    case predict::Criterion::MinHandJerk: return {240, 228, 66};
    case predict::Criterion::MinTorqueChange: return {204, 121, 167};
    case predict::Criterion::MinCrackle: return {0, 200, 160};
    case predict::Criterion::MinHandForce: return {230, 90, 90};
    case predict::Criterion::MinHandForceChange: return {86, 220, 110};
    case predict::Criterion::MinComAcceleration: return {190, 150, 255};
    default: return {180, 180, 180};  // one that has no colour of its own yet
  }
}

QString titleOf(predict::Criterion criterion) {
  const std::string_view name = predict::nameOf(criterion);
  QString title = QString::fromUtf8(name.data(), static_cast<int>(name.size()));
  return title.replace(QStringLiteral("min-"), QStringLiteral("min. ")).replace(QLatin1Char('-'), QLatin1Char(' '));
}

}  // namespace reachlab::gui::plot
