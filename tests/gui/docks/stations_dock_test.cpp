#include "gui/docks/stations_dock.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QTableWidget>

#include "tests/gui/words.h"

namespace reachlab::gui::docks {
namespace {

network::StationSetup conductor() {
  network::StationSetup here;
  here.link.station = 1;
  here.link.stations = 2;
  here.link.conductor = true;
  here.link.name = "left";
  return here;
}

network::StationStatus other() {
  network::StationStatus s;
  s.station = 2;
  s.name = "right", s.device = "phantom", s.software = "reachlab 1";
  s.light = network::StationStatus::Light::Good;
  s.heard = true;
  s.roundTrip = 0.0314, s.jitter = 0.002, s.loss = 0.015, s.overtaken = 0.25, s.offset = -0.0025, s.age = 0.004;
  return s;
}

QString cell(const StationsDock& dock, int row, int column) {
  return dock.findChild<QTableWidget*>(QStringLiteral("stations"))->item(row, column)->text();
}

QString sentence(const StationsDock& dock) { return dock.findChild<QLabel*>(QStringLiteral("stationsSentence"))->text(); }

TEST(StationsDock, TellsEachStationsLinkInNumbersAndItsLightWithoutColour) {
  StationsDock dock;
  dock.showStations(conductor(), StationsDock::Stage::BetweenTrials, {other()});
  EXPECT_EQ(cell(dock, 0, 2), QStringLiteral("left (here, conductor)"));
  EXPECT_EQ(cell(dock, 1, 0), QStringLiteral("● good"));
  const QStringList numbers{cell(dock, 1, 3), cell(dock, 1, 4), cell(dock, 1, 5), cell(dock, 1, 6), cell(dock, 1, 7), cell(dock, 1, 8)};
  EXPECT_EQ(numbers, (QStringList{"31.4", "2.0", "1.5", "25.0", "-2.500", "4"})) << "ms, ms, % lost, % overtaken, ms, ms";
  EXPECT_TRUE(holds(sentence(dock), "Space arms"));
}

TEST(StationsDock, SaysWhyNothingIsArmedAndShowsNoNumberThatIsNotKnown) {
  StationsDock dock;
  network::StationStatus slow = other();
  slow.light = network::StationStatus::Light::Stop;
  slow.obstacles = {"a round trip takes 200 ms; allowed: up to 120"};
  dock.showStations(conductor(), StationsDock::Stage::Arming, {slow});
  EXPECT_EQ(cell(dock, 1, 0), QStringLiteral("■ stop"));
  EXPECT_TRUE(holds(sentence(dock), "Not armed: station 2: a round trip takes 200 ms; allowed: up to 120"));
  network::StationStatus absent;
  absent.station = 2;
  absent.obstacles = {"is not there"};
  dock.showStations(conductor(), StationsDock::Stage::BetweenTrials, {absent});
  EXPECT_EQ(cell(dock, 1, 0), QStringLiteral("○ absent"));
  EXPECT_EQ(cell(dock, 1, 3), QString());
  EXPECT_TRUE(holds(sentence(dock), "station 2: is not there"));
}

}  // namespace
}  // namespace reachlab::gui::docks
