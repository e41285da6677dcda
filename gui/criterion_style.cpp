#include "gui/criterion_style.h"

namespace reachlab {

QColor colourOf(Criterion criterion) {
  switch (criterion) {
    case Criterion::MinHandJerk: return {240, 228, 66};
    case Criterion::MinTorqueChange: return {204, 121, 167};
    case Criterion::MinCrackle: return {0, 200, 160};
    case Criterion::MinHandForce: return {230, 90, 90};
    case Criterion::MinHandForceChange: return {86, 220, 110};
    case Criterion::MinComAcceleration: return {190, 150, 255};
    case Criterion::MinHandCrackle: break;
  }
  return {180, 180, 180};
}

QString titleOf(Criterion criterion) {
  const std::string_view name = nameOf(criterion);
  QString title = QString::fromUtf8(name.data(), static_cast<int>(name.size()));
  return title.replace(QStringLiteral("min-"), QStringLiteral("min. ")).replace(QLatin1Char('-'), QLatin1Char(' '));
}

}  // namespace reachlab
