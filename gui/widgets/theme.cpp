#include "gui/widgets/theme.h"

#include <QApplication>
#include <QLocale>
#include <QPalette>
#include <QStyleFactory>
#include <clocale>

namespace reachlab::gui::widgets {

QColor toQColor(const Colour& colour) { return QColor::fromRgbF(colour.red, colour.green, colour.blue); }

void applyTheme(QApplication& application) {
  std::setlocale(LC_NUMERIC, "C");  // Qt has taken the user's; ours and every library's numbers stay as the files have them
  QLocale numbers = QLocale::c();
  numbers.setNumberOptions(QLocale::OmitGroupSeparator | QLocale::RejectGroupSeparator);
  QLocale::setDefault(numbers);

  QApplication::setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  QPalette palette;
  using namespace colours;
  palette.setColor(QPalette::Window, toQColor(kWindow));
  palette.setColor(QPalette::WindowText, toQColor(kText));
  palette.setColor(QPalette::Base, toQColor(kBase));
  palette.setColor(QPalette::AlternateBase, toQColor(kWindow));
  palette.setColor(QPalette::Text, toQColor(kText));
  palette.setColor(QPalette::Button, toQColor(kButton));
  palette.setColor(QPalette::ButtonText, toQColor(kText));
  palette.setColor(QPalette::BrightText, toQColor(kTarget));
  palette.setColor(QPalette::Highlight, toQColor(kAccent));
  palette.setColor(QPalette::HighlightedText, Qt::white);
  palette.setColor(QPalette::ToolTipBase, toQColor(kButton));
  palette.setColor(QPalette::ToolTipText, toQColor(kText));
  palette.setColor(QPalette::PlaceholderText, toQColor(kNeutral));
  palette.setColor(QPalette::Link, toQColor(kAccent));
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    palette.setColor(QPalette::Disabled, role, toQColor(kNeutral));
  QApplication::setPalette(palette);
  application.setStyleSheet(QStringLiteral(
      "QDockWidget { titlebar-close-icon: none; font-weight: 600; }"
      "QDockWidget::title { background: #262c37; padding: 6px 9px; }"
      "QToolTip { border: 1px solid #46505f; padding: 4px; }"
      "QLineEdit, QAbstractSpinBox, QComboBox { padding: 2px 5px; min-height: 20px; }"
      "QLabel[role=\"fault\"] { color: #ff9d8c; }"
      "QLabel[role=\"quiet\"] { color: #a8b5c7; }"
      // Fusion draws an empty box darker than the dark it stands on.
      "QCheckBox::indicator:unchecked, QTableView::indicator:unchecked { width: 11px; height: 11px; border: 1px solid #6b7788;"
      " border-radius: 2px; background: #11151c; }"
      "QPushButton { padding: 5px 14px; }"
      "QPushButton[role=\"go\"] { background: #2463a8; font-weight: 600; }"
      "QPushButton[role=\"go\"]:disabled { background: #2d333f; }"
      "QStatusBar { background: #181c23; } QStatusBar QLabel { color: #b5c0cf; padding: 0 6px; }"
      "QSplitter::handle { background: #262c37; }"));
}

}  // namespace reachlab::gui::widgets
