#include "gui/plot/criterion_style.h"

#include "analysis/report/figures.h"
#include "gui/widgets/themes.h"

namespace reachlab::gui::plot {

QColor colourOf(predict::Criterion criterion) {
  const analysis::CriterionLook look = analysis::lookOf({criterion});
  const auto& [red, green, blue] = widgets::theme() == widgets::Theme::Light ? look.onLight : look.onDark;
  return {red, green, blue};
}

QString titleOf(predict::Criterion criterion) {
  const std::string_view name = predict::nameOf(criterion);
  QString title = QString::fromUtf8(name.data(), static_cast<int>(name.size()));
  return title.replace(QStringLiteral("min-"), QStringLiteral("min. ")).replace(QLatin1Char('-'), QLatin1Char(' '));
}

}  // namespace reachlab::gui::plot
