#include "gui/plot/velocity_plot.h"

#include <gtest/gtest.h>

#include <QApplication>
#include <QCheckBox>
#include <QMouseEvent>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "tests/gui/plot/exported.h"

namespace reachlab::gui::plot {
namespace {

struct ShownPlot {
  VelocityPlot plot;
  QWidget* canvas = nullptr;
  ShownPlot() {
    plot.resize(700, 320);
    plot.setTask(1, 0.3);
    plot.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&plot));
    for (QWidget* child : plot.findChildren<QWidget*>())
      if (child->inherits("QwtPlotCanvas")) canvas = child;
  }
  void add(int from, int to) {
    for (int i = from; i < to; ++i) plot.add(0.01 * i, 0.1 * i, 0.05 * i);
    plot.refresh();
  }
  QCheckBox& freeze() { return *plot.findChild<QCheckBox*>(QStringLiteral("velocityFreeze")); }
};

TEST(VelocityPlot, TheLeftAxisFitsIntoTheSmallestPlot) {
  QWidget window;  // which lets it be smaller than its layout wants, as a dock does
  VelocityPlot plot(&window);
  plot.resize(plot.minimumSizeHint());
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  for (int i = 0; i < 30; ++i) plot.add(0.01 * i, 0.01 * i, 0);
  plot.refresh();
  const QImage axis = plot.findChild<QWidget*>(QStringLiteral("QwtPlotAxisYLeft"))->grab().toImage();
  const auto rowsWithInk = [&](int from, int to) {
    std::vector<int> rows;
    for (int y = 0; y < axis.height(); ++y)
      for (int x = from; x < to; ++x)
        if (axis.pixel(x, y) != axis.pixel(0, 0) && (rows.empty() || rows.back() != y)) rows.push_back(y);
    return rows;
  };
  const int besideTitle = QFontMetrics(QApplication::font()).height();
  const std::vector<int> title = rowsWithInk(0, besideTitle), numbers = rowsWithInk(besideTitle + 4, axis.width() - 15),
                         line = rowsWithInk(axis.width() - 5, axis.width());
  ASSERT_FALSE(title.empty() || numbers.empty() || line.empty());
  EXPECT_GT(title.front(), line.front() + 1) << "it is not cut";
  EXPECT_LT(title.back(), line.back() - 1) << "it is not cut";
  EXPECT_LT(static_cast<int>(numbers.size()), axis.height() * 3 / 4) << "they are apart";
}

// Columns of the small canvas of a screen of 1366 pixels in which the line has no pixel, from its first to its last.
TEST(VelocityPlot, APredictionIsDashedHoweverSmallThePlotIs) {
  ShownPlot shown;
  ASSERT_NE(shown.canvas, nullptr);
  shown.plot.resize(560, 220);
  PredictedLine line{QStringLiteral("prediction"), {QColor(255, 0, 0), {5, 3}, 0}};
  for (int i = 0; i <= 200; ++i) {
    line.x.push_back(i / 200.0);
    line.y.push_back(0.3 * std::sin(M_PI * i / 200));
  }
  shown.plot.setPredictions({line});
  shown.plot.refresh();
  const QImage image = shown.canvas->grab().toImage();
  std::vector<bool> seen;
  for (int x = 0; x < image.width(); ++x) {
    bool red = false;
    for (int y = 0; y < image.height(); ++y) {
      const QRgb pixel = image.pixel(x, y);
      red = red || (qRed(pixel) > 150 && qGreen(pixel) < 80);
    }
    seen.push_back(red);
  }
  const auto first = std::find(seen.begin(), seen.end(), true), last = std::find(seen.rbegin(), seen.rend(), true).base();
  ASSERT_GT(last - first, 100);
  EXPECT_GT(std::count(first, last, false), (last - first) / 6);
}

TEST(VelocityPlot, ADragZoomsInAndNewPointsDoNotZoomOut) {
  ShownPlot shown;
  ASSERT_NE(shown.canvas, nullptr);
  shown.add(0, 50);
  const auto whole = shown.plot.shownTimes();
  const QPoint from(shown.canvas->width() / 4, 20), to(shown.canvas->width() / 2, shown.canvas->height() - 20);
  QTest::mousePress(shown.canvas, Qt::LeftButton, {}, from);
  QMouseEvent drag(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton, {});  // QTest's own move may arrive after the release
  QApplication::sendEvent(shown.canvas, &drag);
  QTest::mouseRelease(shown.canvas, Qt::LeftButton, {}, to);
  const auto part = shown.plot.shownTimes();
  EXPECT_NEAR(part.first, 0.25 * whole.second, 0.02);
  EXPECT_NEAR(part.second, 0.5 * whole.second, 0.02);
  shown.add(50, 60);
  EXPECT_EQ(shown.plot.shownTimes(), part);
  QTest::mouseClick(shown.canvas, Qt::RightButton);
  EXPECT_EQ(shown.plot.shownTimes(), whole);
  QTest::mousePress(shown.canvas, Qt::LeftButton, {}, from);
  QTest::mouseRelease(shown.canvas, Qt::LeftButton, {}, to);
  shown.plot.setTask(3, 0.3);
  EXPECT_NEAR(shown.plot.shownTimes().second, 3.55, 1e-9) << "another task is looked at whole";
}

TEST(VelocityPlot, FreezeHoldsThePictureAndLosesNothing) {
  ShownPlot shown;
  shown.plot.beginTrial();
  shown.add(0, 10);
  shown.freeze().setChecked(true);
  shown.add(10, 20);
  shown.plot.beginTrial();
  shown.add(0, 5);
  EXPECT_EQ(exportedLines(shown.plot).size(), 1 + 2 * 10) << "what is looked at";
  shown.freeze().setChecked(false);
  EXPECT_EQ(exportedLines(shown.plot).size(), 1 + 2 * 5 + 2 * 20) << "the trial under way, and the whole one before";
}

TEST(VelocityPlot, IsExportedAsItIsDrawn) {
  ShownPlot shown;
  shown.add(0, 30);
  shown.plot.setPredictions({{QStringLiteral("jerk"), {Qt::red, {5, 3}, 0}, false, {0, 1}, {0, 0.5}}});
  const QList<QByteArray> lines = exportedLines(shown.plot);
  EXPECT_EQ(lines[0], "line,time_s,velocity_m_per_s");
  EXPECT_EQ(lines[30], "\"hand\",0.28999999999999998,2.9000000000000004");
  EXPECT_EQ(lines.back(), "\"jerk\",1,0.5");
  expectDrawings(shown.plot);
}

}  // namespace
}  // namespace reachlab::gui::plot
