#include "gui/docks/stations_dock.h"

#include <gtest/gtest.h>

#include <QTableWidget>

namespace reachlab::gui::docks {
namespace {

network::StationSetup conductor() {
  network::StationSetup here;
  here.line.station = 1;
  here.line.stations = 2;
  here.line.conductor = true;
  here.line.name = "left";
  return here;
}

network::StationStanding other() {
  network::StationStanding s;
  s.station = 2;
  s.name = "right", s.device = "phantom", s.software = "reachlab 1";
  s.light = network::StationStanding::Light::Good;
  s.heard = true;
  s.roundTrip = 0.0314, s.jitter = 0.002, s.loss = 0.015, s.offset = -0.0025, s.age = 0.004;
  return s;
}

QString cell(const StationsDock& dock, int row, int column) {
  return dock.findChild<QTableWidget*>(QStringLiteral("stations"))->item(row, column)->text();
}

TEST(StationsDock, TellsEachStationsLineInNumbersAndItsLightWithoutColour) {
  StationsDock dock;
  dock.showStations(conductor(), StationsDock::Stage::BetweenTrials, {other()});
  EXPECT_EQ(cell(dock, 0, 2), QStringLiteral("left (here, conductor)"));
  EXPECT_EQ(cell(dock, 1, 0), QStringLiteral("● good"));
  const QStringList numbers{cell(dock, 1, 3), cell(dock, 1, 4), cell(dock, 1, 5), cell(dock, 1, 6), cell(dock, 1, 7)};
  EXPECT_EQ(numbers, (QStringList{"31.4", "2.0", "1.5", "-2.500", "4"})) << "ms, ms, %, ms, ms";
  EXPECT_TRUE(dock.sentence().contains(QStringLiteral("Space arms"))) << dock.sentence().toStdString();
}

TEST(StationsDock, SaysWhyNothingIsArmedAndShowsNoNumberThatIsNotKnown) {
  StationsDock dock;
  network::StationStanding slow = other();
  slow.light = network::StationStanding::Light::Stop;
  slow.obstacles = {"a round trip takes 200 ms; allowed: up to 120"};
  dock.showStations(conductor(), StationsDock::Stage::Arming, {slow});
  EXPECT_EQ(cell(dock, 1, 0), QStringLiteral("■ stop"));
  EXPECT_TRUE(dock.sentence().contains(QStringLiteral("Not armed: station 2: a round trip takes 200 ms; allowed: up to 120")))
      << dock.sentence().toStdString();
  network::StationStanding absent;
  absent.station = 2;
  absent.obstacles = {"is not there"};
  dock.showStations(conductor(), StationsDock::Stage::BetweenTrials, {absent});
  EXPECT_EQ(cell(dock, 1, 0), QStringLiteral("○ absent"));
  EXPECT_EQ(cell(dock, 1, 3), QString());
  EXPECT_TRUE(dock.sentence().contains(QStringLiteral("station 2: is not there"))) << dock.sentence().toStdString();
}

}  // namespace
}  // namespace reachlab::gui::docks
