#include <QLabel>
#include <QTableWidget>
#include <filesystem>

#include "tests/gui/at_the_window.h"
#include "tests/temporary_folder.h"

// The window of one of several stations, beside an endpoint that brings nothing.
namespace reachlab::gui::app {
namespace {

class StationWindow : public AtTheWindow {
 protected:
  MainWindow& openStation(int number, bool conductor) {
    request_.what = "chain-two-hands";
    request_.device = "simulated";
    network::StationSetup setup;
    setup.link.station = number;
    setup.link.conductor = conductor;
    setup.link.name = "here";
    setup.link.software = "reachlab";
    setup.link.endpoint = programs_.writeProgram("endpoint", "exec sleep 60");
    setup.wait = 1;
    setup.insecure = true;
    window_ = std::make_unique<MainWindow>(request_, setup);
    show();
    window_->joinStations();
    return *window_;
  }
  const TemporaryFolder programs_;
};

TEST_F(StationWindow, TheConductorsArmsNothingWhileAStationIsMissingAndSaysSo) {
  MainWindow& window = openStation(1, true);
  ASSERT_NE(window.session().run(), nullptr) << "the others hear of it from the start";
  const auto* sentence = find<QLabel>("stationsSentence");
  EXPECT_TRUE(holds(sentence->text(), "station 2: is not there"));
  EXPECT_EQ(find<QTableWidget>("stations")->rowCount(), 2);
  EXPECT_EQ(window.view().plan().hands.size(), 2u);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.overlay().instruction.startsWith("Station 2 is missing"); }, 5000))
      << "it is the headline";
  QTest::keyClick(&window, Qt::Key_Space);
  EXPECT_TRUE(window.session().isArming());
  EXPECT_TRUE(QTest::qWaitFor([&] { return window.message().startsWith("no trial was armed: station 2"); }, 5000))
      << window.message().toStdString();
  EXPECT_FALSE(window.session().isArming());
  QTest::keyClick(&window, Qt::Key_Space);
  EXPECT_TRUE(window.session().isArming());
  QTest::keyClick(&window, Qt::Key_Escape);
  EXPECT_FALSE(window.session().isArming()) << "Esc takes it back";
  EXPECT_EQ(window.session().run()->latest().trial, 0);
}

TEST_F(StationWindow, AFollowersWaitsForTheConductor) {
  MainWindow& window = openStation(2, false);
  ASSERT_NE(window.session().run(), nullptr);
  EXPECT_EQ(window.view().plan().ownHand, 1);
  const QString waits = "Station 1 is missing. The window waits for it.";
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.overlay().instruction == waits; }, 5000));
  QTest::keyClick(&window, Qt::Key_Space);
  QTest::qWait(100);
  EXPECT_FALSE(window.session().underWay());
  EXPECT_EQ(window.overlay().instruction, waits) << "Space arms nothing here";
}

TEST_F(StationWindow, AnObserverHasNoHandAndRecordsNothing) {
  MainWindow& window = openStation(0, false);
  EXPECT_EQ(window.session().run(), nullptr);
  EXPECT_EQ(window.session().seen(), nullptr) << "nothing has come";
  QTest::keyClick(&window, Qt::Key_Space);
  QTest::qWait(100);
  EXPECT_EQ(window.session().run(), nullptr);
  EXPECT_TRUE(window.windowTitle().contains("observing"));
  const auto* sentence = find<QLabel>("stationsSentence");
  EXPECT_TRUE(starts(sentence->text(), "This window only observes"));
  EXPECT_EQ(find<QTableWidget>("stations")->rowCount(), 2) << "both stations, and no row of its own";
  EXPECT_FALSE(std::filesystem::exists(request_.place.data));
}

TEST_F(StationWindow, APlanIsRefused) {
  request_.what = "paper";
  EXPECT_THROW(MainWindow(request_, network::StationSetup{}), FaultError);
}

}  // namespace
}  // namespace reachlab::gui::app
