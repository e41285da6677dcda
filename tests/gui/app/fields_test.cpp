// Every field explains itself, and the Tab key goes through them as they are read.
#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QTabBar>
#include <algorithm>

#include "tests/gui/at_the_window.h"

namespace reachlab::gui {
namespace {

class Fields : public AtTheWindow {
 protected:
  void openAll() {
    open().resize(1900, 1050);
    QTest::qWait(50);
    for (QDockWidget* dock : window_->findChildren<QDockWidget*>()) {
      dock->show();
      dock->setFloating(true);  // alone, so that all of it is laid out
      dock->resize(dock->sizeHint().expandedTo({420, 700}));
    }
    QTest::qWait(100);
  }
  static bool isPartOfAnother(const QWidget* widget) {
    for (const QWidget* above = widget->parentWidget(); above != nullptr; above = above->parentWidget())
      if (qobject_cast<const QAbstractSpinBox*>(above) != nullptr || qobject_cast<const QComboBox*>(above) != nullptr ||
          qobject_cast<const QTabBar*>(above) != nullptr || above->inherits("QAbstractItemView"))
        return true;
    return false;
  }
  static std::string nameOf(const QWidget* widget) {
    QString path = QString::fromLatin1(widget->metaObject()->className());
    for (const QWidget* w = widget; w != nullptr; w = w->parentWidget())
      if (!w->objectName().isEmpty()) path = w->objectName() + QLatin1Char('/') + path;
    return path.toStdString();
  }
};

TEST_F(Fields, HaveToolTips) {
  openAll();
  int seen = 0;
  for (QWidget* widget : window_->findChildren<QWidget*>()) {
    const bool field = qobject_cast<QLineEdit*>(widget) != nullptr || qobject_cast<QAbstractSpinBox*>(widget) != nullptr ||
                       qobject_cast<QComboBox*>(widget) != nullptr || qobject_cast<QAbstractButton*>(widget) != nullptr;
    if (!field || !widget->isVisible() || isPartOfAnother(widget) || widget->objectName().startsWith(QLatin1String("qt_"))) continue;
    ++seen;
    EXPECT_FALSE(widget->toolTip().isEmpty()) << nameOf(widget);
  }
  EXPECT_GT(seen, 40);
  for (const char* word : {"late", "missed", "clamped"})
    EXPECT_TRUE(find<QLabel>("ticks")->toolTip().contains(QLatin1String(word) + ": ")) << word;
}

TEST_F(Fields, AToolTipComesBackWhenItsFaultIsGone) {
  openAll();
  auto* subject = find<QLineEdit>("subject");
  const QString usual = subject->toolTip();
  subject->setText("0 1");
  EXPECT_NE(subject->toolTip(), usual) << "the fault";
  subject->setText("03");
  EXPECT_EQ(subject->toolTip(), usual);
}

// A fault of an entry is not forgotten when another experiment is shown.
TEST_F(Fields, AFaultStaysWhileItsEntryStays) {
  openAll();
  auto* subject = find<QLineEdit>("subject");
  subject->setText("0 1");
  const QString fault = find<QLabel>("sessionFaults")->text();
  EXPECT_FALSE(fault.isEmpty());
  window_->openExperiment("ellipse");
  EXPECT_EQ(find<QLabel>("sessionFaults")->text(), fault);
  EXPECT_TRUE(find<QLabel>("sessionFaults")->isVisible());
  subject->setText("03");
  EXPECT_EQ(find<QLabel>("sessionFaults")->text(), QString());
}

TEST_F(Fields, AWrongShapeOrPauseIsToldAndTheValueBeforeIsKept) {
  openAll();
  window_->openExperiment("ellipse");
  const auto told = [&](QAbstractSpinBox* number, const QLabel* faults) {
    const QString before = number->text();
    type(number, "0,3");
    EXPECT_EQ(number->text(), before);
    EXPECT_TRUE(faults->isVisible());
    EXPECT_TRUE(holds(faults->text(), "\"0,3\" is no number"));
    EXPECT_TRUE(faults->text().endsWith(before + " is kept")) << faults->text().toStdString();
    type(number, "0.25");
    EXPECT_EQ(faults->text(), QString());
  };
  const auto shapes = find<QDockWidget>("constraintDock")->findChildren<QDoubleSpinBox*>();
  ASSERT_FALSE(shapes.isEmpty());
  told(shapes.front(), find<QLabel>("constraintFaults"));
  told(find<QAbstractSpinBox>("pause"), find<QLabel>("pauseFault"));
}

TEST_F(Fields, TabGoesThroughADockAsItIsRead) {
  openAll();
  for (QDockWidget* dock : window_->findChildren<QDockWidget*>()) {
    const QWidget* before = nullptr;
    int rows = 0;
    QWidget* widget = dock;
    do {
      widget = widget->nextInFocusChain();
      if (!dock->isAncestorOf(widget) || !widget->isVisible() || !widget->isEnabled() || !(widget->focusPolicy() & Qt::TabFocus) ||
          isPartOfAnother(widget) || widget->objectName().startsWith(QLatin1String("qt_")))
        continue;
      if (before != nullptr) {
        const QPoint a = before->mapTo(dock, QPoint(0, before->height() / 2)), b = widget->mapTo(dock, QPoint(0, widget->height() / 2));
        const bool sameRow = std::abs(a.y() - b.y()) < 8;
        EXPECT_TRUE(sameRow ? b.x() > a.x() : b.y() > a.y() || b.x() > a.x() + before->width())
            << nameOf(before) << " at " << a.x() << ' ' << a.y() << ", then " << nameOf(widget) << " at " << b.x() << ' ' << b.y();
      }
      before = widget;
      ++rows;
    } while (widget != dock);
    if (dock->objectName() == QLatin1String("taskDock")) {
      EXPECT_EQ(rows, 7) << "start, target, via, T and three tolerances";
    }
  }
}

TEST_F(Fields, TabGoesRoundTheWindowAndARingShowsWhere) {
  open().resize(1900, 1050);
  QTest::qWait(100);
  const auto pressTab = [] { QTest::keyClick(QApplication::focusWidget(), Qt::Key_Tab); };
  pressTab();
  QWidget* const first = QApplication::focusWidget();
  std::vector<QWidget*> seen;
  do {
    QWidget* const now = QApplication::focusWidget();
    ASSERT_EQ(std::find(seen.begin(), seen.end(), now), seen.end()) << "Tab does not leave " << nameOf(now);
    seen.push_back(now);
    const QImage focused = now->grab().toImage();
    pressTab();
    EXPECT_NE(now->grab().toImage(), focused) << nameOf(now) << " shows no focus";
  } while (QApplication::focusWidget() != first);
  EXPECT_NE(std::find(seen.begin(), seen.end(), find<QWidget>("criteria")), seen.end());
  EXPECT_GT(seen.size(), 30u);
}

}  // namespace
}  // namespace reachlab::gui
