// The words of the window, measured on its picture in both themes.
#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>

#include "gui/widgets/number_list_edit.h"
#include "gui/widgets/theme.h"
#include "tests/gui/at_the_window.h"
#include "tests/gui/eyes.h"

namespace reachlab::gui {
namespace {

using widgets::Theme;

class Contrast : public AtTheWindow, public ::testing::WithParamInterface<Theme> {
 protected:
  Contrast() {
    widgets::setTheme(GetParam());
    widgets::applyTheme(*qApp);
  }
  ~Contrast() override {
    window_.reset();
    widgets::setTheme(Theme::Dark);
    widgets::applyTheme(*qApp);
  }
  // Of the ink that stands out most from the ground, which is the commonest colour.
  static double measure(const QImage& picture) {
    std::map<QRgb, int> count;
    for (int y = 0; y < picture.height(); ++y)
      for (int x = 0; x < picture.width(); ++x) ++count[picture.pixel(x, y)];
    QRgb ground = 0;
    int most = 0;
    for (const auto& [colour, many] : count)
      if (many > most) ground = colour, most = many;
    double best = 1;
    for (const auto& [colour, many] : count) best = std::max(best, contrast(lightOf(QColor(colour)), lightOf(QColor(ground))));
    return best;
  }
  static QString wordsOf(const QWidget* widget) {
    if (const auto* label = qobject_cast<const QLabel*>(widget)) return label->text();
    if (const auto* button = qobject_cast<const QAbstractButton*>(widget)) return button->text();
    if (const auto* box = qobject_cast<const QComboBox*>(widget)) return box->currentText();
    if (const auto* edit = qobject_cast<const QLineEdit*>(widget))
      return edit->text() + (edit->text().isEmpty() ? edit->placeholderText() : QString());
    return {};
  }
};

TEST_P(Contrast, OfEveryWordIsEnough) {
  open();
  type(find<widgets::NumberListEdit>("masses"), "abc", false);
  find<QWidget>("note")->setFocus();
  for (const QSize& size : {QSize(1900, 1050), QSize(1366, 740)}) {
    window_->resize(size);
    QTest::qWait(100);
    const QImage picture = window_->grab().toImage();
    int seen = 0;
    for (const QWidget* widget : window_->findChildren<QWidget*>()) {
      const QString words = wordsOf(widget);
      if (words.trimmed().isEmpty() || !widget->isEnabled() || widget->visibleRegion().boundingRect() != widget->rect()) continue;
      const QRect inside = widget->rect().adjusted(3, 3, -3, -3);  // without its frame
      const QPoint at = widget->mapTo(window_.get(), inside.topLeft()) * picture.devicePixelRatio();
      EXPECT_GE(measure(picture.copy({at, inside.size() * picture.devicePixelRatio()})), 4.5)
          << words.toStdString() << " (" << widget->objectName().toStdString() << ')';
      ++seen;
    }
    EXPECT_GT(seen, 20);
  }
}

TEST_P(Contrast, OfTheButtonsOfADockIsEnough) {
  open().resize(1900, 1050);
  QTest::qWait(100);
  int seen = 0;
  for (const char* name : {"qt_dockwidget_closebutton", "qt_dockwidget_floatbutton"})
    for (QAbstractButton* button : window_->findChildren<QAbstractButton*>(QLatin1String(name))) {
      if (!button->isVisible() || button->visibleRegion().isEmpty()) continue;
      const QImage picture = window_->grab(QRect(button->mapTo(window_.get(), QPoint()), button->size())).toImage();
      EXPECT_GE(measure(picture), 3) << name;
      ++seen;
    }
  EXPECT_GT(seen, 4);
}

INSTANTIATE_TEST_SUITE_P(Themes, Contrast, ::testing::Values(Theme::Dark, Theme::Light));

}  // namespace
}  // namespace reachlab::gui
