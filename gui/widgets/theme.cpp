#include "gui/widgets/theme.h"

#include <QApplication>
#include <QLocale>
#include <QPalette>
#include <QStyleFactory>
#include <clocale>

namespace reachlab::gui::widgets {

namespace {

Theme active = Theme::Dark;

bool same(const Colour& a, const Colour& b) { return a.red == b.red && a.green == b.green && a.blue == b.blue; }

}  // namespace

void setTheme(Theme theme) { active = theme; }
Theme theme() { return active; }

Colour themed(const Colour& colour) {
  using namespace colours;
  if (active == Theme::Dark) return colour;
  // Dark ink on light ground; the hues of Okabe and Ito, darker, so that lines keep 3 : 1 and words 4.5 : 1.
  static const std::pair<Colour, Colour> kLight[] = {
      {kSkyTop, {0.90, 0.93, 0.97}},   {kSkyBottom, {0.76, 0.80, 0.86}},   {kRail, {0.34, 0.38, 0.44}},
      {kSurface, {0.22, 0.46, 0.70}},  {kSurfaceLine, {0.08, 0.24, 0.42}}, {kStart, {0.38, 0.43, 0.50}},
      {kTarget, {0.62, 0.46, 0.00}},   {kDriven, {0.05, 0.35, 0.68}},      {kMiddle, {0.42, 0.46, 0.52}},
      {kLast, {0.75, 0.34, 0.00}},     {kHand, {0.12, 0.14, 0.18}},        {kSpring, {0.30, 0.34, 0.40}},
      {kCoupling, {0.10, 0.42, 0.62}}, {kNeutral, {0.42, 0.46, 0.52}},     {kGreen, {0.02, 0.45, 0.18}},
      {kRed, {0.75, 0.12, 0.10}},      {kText, {0.07, 0.09, 0.12}},        {kFaintText, {0.28, 0.32, 0.38}},
      {kWindow, {0.925, 0.935, 0.95}}, {kBase, {0.985, 0.988, 0.995}},     {kButton, {0.86, 0.88, 0.91}},
      {kAccent, {0.08, 0.38, 0.72}},   {kLampNeutral, {0.42, 0.46, 0.52}}, {kLampGreen, {0.02, 0.52, 0.20}},
      {kTrace, {0.70, 0.08, 0.44}},    {kBadText, {0.62, 0.09, 0.06}}};
  for (const auto& [dark, light] : kLight)
    if (same(dark, colour)) return light;
  return colour;
}

Colour colourOf(const std::string& hex) {
  const QColor colour(QString::fromStdString(hex));
  return {colour.redF(), colour.greenF(), colour.blueF()};
}

QColor toQColor(const Colour& colour) {
  const Colour c = themed(colour);
  return QColor::fromRgbF(c.red, c.green, c.blue);
}

void applyTheme(QApplication& application) {
  std::setlocale(LC_NUMERIC, "C");  // Qt has taken the user's; ours and every library's numbers stay as the files have them
  QLocale numbers = QLocale::c();
  numbers.setNumberOptions(QLocale::OmitGroupSeparator | QLocale::RejectGroupSeparator);
  QLocale::setDefault(numbers);

  QApplication::setStyle(QStyleFactory::create("Fusion"));
  QPalette palette;
  using namespace colours;
  const std::pair<QPalette::ColorRole, Colour> roles[] = {
      {QPalette::Window, kWindow},    {QPalette::WindowText, kText},    {QPalette::Base, kBase},        {QPalette::AlternateBase, kWindow},
      {QPalette::Text, kText},        {QPalette::Button, kButton},      {QPalette::ButtonText, kText},  {QPalette::BrightText, kTarget},
      {QPalette::Highlight, kAccent}, {QPalette::ToolTipBase, kButton}, {QPalette::ToolTipText, kText}, {QPalette::Link, kAccent}};
  for (const auto& [role, colour] : roles) palette.setColor(role, toQColor(colour));
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::PlaceholderText, ink(155));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, toQColor(kNeutral));
  palette.setColor(QPalette::Disabled, QPalette::Light, toQColor(kBase));  // of the etching beside a menu's words: not seen
  QApplication::setPalette(palette);
  const auto either = [](const char* light, const char* dark) { return QString::fromLatin1(theme() == Theme::Light ? light : dark); };
  // Fusion draws an empty box darker than the dark it stands on.
  application.setStyleSheet(
      QStringLiteral(
          "QDockWidget { font-weight: 600; }"
          "QDockWidget::close-button, QDockWidget::float-button { subcontrol-position: top right; subcontrol-origin: margin;"
          " position: absolute; top: 8px; bottom: 8px; width: 14px; background: %5; border-radius: 2px; }"
          "QDockWidget::close-button { right: 8px; } QDockWidget::float-button { right: 28px; }"
          "QDockWidget::title { background: %1; padding: 6px 9px; }"
          "QToolTip { border: 1px solid %2; padding: 4px; }"
          "QLineEdit, QAbstractSpinBox, QComboBox { padding: 2px 5px; min-height: 20px; }"
          "QLabel[role=\"fault\"] { color: %3; }"
          "QLabel[role=\"quiet\"] { color: %4; }"
          "QCheckBox::indicator:unchecked, QTableView::indicator:unchecked { width: 11px; height: 11px; border: 1px solid #6b7788;"
          " border-radius: 2px; background: %5; }"
          "QPushButton { padding: 5px 14px; }"
          // The border is set, because without it the Fusion style draws a lighter blue, on which white words are hard to read.
          "QPushButton[role=\"go\"] { background: #2463a8; color: white; font-weight: 600; border: 1px solid #1b4b80; border-radius: 3px; }"
          "QPushButton[role=\"go\"]:hover { background: #2a6fba; } QPushButton[role=\"go\"]:pressed { background: #1b4b80; }"
          "QPushButton[role=\"go\"]:focus { border: 2px solid %9; }"
          "QPushButton[role=\"go\"]:disabled { background: %6; color: %8; border: 1px solid %2; }"
          "*:focus { outline: 2px solid %9; }"
          "QTableView:focus, QTreeView:focus, QListView:focus { border: 1px solid %9; }"  // an empty one has no line to be outlined
          "QFrame[role=\"card\"] { background: %7; border: 1px solid %2; border-radius: 8px; }"
          "QToolBar { background: %7; border: none; }"
          "QStatusBar { background: %7; } QStatusBar QLabel { color: %4; padding: 0 6px; }"
          "QSplitter::handle { background: %1; }")
          .arg(either("#d3d8e0", "#262c37"), either("#8a94a3", "#46505f"), either("#a01810", "#ff9d8c"), either("#39424f", "#a8b5c7"),
               either("#ffffff", "#11151c"), either("#b9c0ca", "#2d333f"), either("#e1e5eb", "#181c23"), toQColor(kNeutral).name(),
               either("#0b4f9c", "#7cc0ff")));
}

}  // namespace reachlab::gui::widgets
