#include "gui/plot/signal_plot.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <cmath>

#include "tests/gui/plot/exported.h"

namespace reachlab::gui::plot {
namespace {

SignalPlot::Point pointAt(double t) {
  return {.time = t, .position = {std::sin(t), 0, 0}, .velocity = {std::cos(t), 0, 0}, .force = 2 * t};
}

TEST(SignalPlot, KeepsTheLastPointsInConstantMemory) {
  SignalPlot plot;
  for (int i = 0; i < 3 * SignalPlot::kCapacity; ++i) plot.add(pointAt(0.005 * i));
  EXPECT_EQ(plot.pointCount(), SignalPlot::kCapacity);
  const QList<QByteArray> lines = exportedLines(plot);
  ASSERT_EQ(lines.size(), SignalPlot::kCapacity + 1);
  const QList<QByteArray> last = lines.back().split(',');
  EXPECT_DOUBLE_EQ(last[0].toDouble(), 0.005 * (3 * SignalPlot::kCapacity - 1));
  EXPECT_DOUBLE_EQ(last[1].toDouble(), std::sin(last[0].toDouble()));
  EXPECT_DOUBLE_EQ(last[7].toDouble(), 2 * last[0].toDouble());
  EXPECT_DOUBLE_EQ(lines[1].split(',')[0].toDouble(), 0.005 * 2 * SignalPlot::kCapacity) << "the oldest that is kept";
}

TEST(SignalPlot, FreezeHoldsWhatIsShown) {
  SignalPlot plot;
  plot.add(pointAt(1));
  plot.findChild<QCheckBox*>(QStringLiteral("signalFreeze"))->setChecked(true);
  plot.add(pointAt(2));
  EXPECT_EQ(plot.pointCount(), 1);
}

TEST(SignalPlot, AnotherBodyIsAnotherSignal) {
  SignalPlot plot;
  plot.setMasses(5);
  int told = -2;
  QObject::connect(&plot, &SignalPlot::watchedChanged, [&](int mass) { told = mass; });
  plot.add(pointAt(1));
  plot.findChild<QComboBox*>(QStringLiteral("signalWatched"))->setCurrentIndex(3);
  EXPECT_EQ(told, 2);
  EXPECT_EQ(plot.watched(), 2);
  EXPECT_EQ(plot.pointCount(), 0);
}

TEST(SignalPlot, TellsWhatIsWatchedWhenTheObjectHasFewerMasses) {
  SignalPlot plot;
  plot.setMasses(3);
  plot.findChild<QComboBox*>(QStringLiteral("signalWatched"))->setCurrentIndex(3);
  int told = -2;
  QObject::connect(&plot, &SignalPlot::watchedChanged, [&](int mass) { told = mass; });
  plot.setMasses(1);
  EXPECT_EQ(plot.watched(), 0);
  EXPECT_EQ(told, 0);
}

TEST(SignalPlot, IsExportedAsItIsDrawn) {
  SignalPlot plot;
  plot.resize(600, 300);
  for (int i = 0; i < 400; ++i) plot.add(pointAt(0.005 * i));
  plot.findChild<QComboBox*>(QStringLiteral("signalQuantity"))->setCurrentIndex(static_cast<int>(SignalPlot::Quantity::PhasePlane));
  expectDrawings(plot);
}

}  // namespace
}  // namespace reachlab::gui::plot
