#include "gui/docks/device_dock.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QTreeWidget>

#include "tests/gui/child.h"
#include "tests/gui/words.h"

namespace reachlab::gui::docks {
namespace {

// What the computer has, as the test plugs it.
int asked = 0;
std::uint64_t nodes = 1;
std::vector<devices::FoundDevice> plugged;

devices::FoundDevice arm(const std::string& whyNot = {}) {
  devices::FoundDevice row;
  row.name = "hid:SN0001";
  row.kind = "hid";
  row.description = "Lab Arm";
  row.present = whyNot.empty();
  row.whyNot = whyNot;
  return row;
}

// The row of that name, or null.
QTreeWidgetItem* rowOf(const DeviceDock& dock, const char* name) {
  return child<QTreeWidget>(dock, "deviceRows")->findItems(QLatin1String(name), Qt::MatchExactly | Qt::MatchRecursive, 0).value(0);
}

// The heading that it is under. Empty if there is no such row.
QString headingOf(const DeviceDock& dock, const char* name) {
  const QTreeWidgetItem* row = rowOf(dock, name);
  return row == nullptr ? QString() : row->parent()->text(0);
}

class DeviceDockOnPlugs : public ::testing::Test {
 protected:
  DeviceDockOnPlugs() {
    asked = 0;
    nodes = 1;
    plugged = {arm()};
    dock.showExperiment(experiment::openExperiment("chain-slow"), true);
  }
  void show() {
    dock.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&dock));
  }
  QPushButton* button(const char* name) const { return child<QPushButton>(dock, name); }

  DeviceDock dock{{[] { return nodes; },
                   [] {
                     ++asked;
                     return plugged;
                   }},
                  nullptr};
  QTreeWidget* rows = child<QTreeWidget>(dock, "deviceRows");
};

TEST_F(DeviceDockOnPlugs, NobodyIsAskedBeforeItIsSeen) {
  EXPECT_EQ(asked, 0);
  show();
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(headingOf(dock, "hid:SN0001"), QStringLiteral("Connected"));
}

TEST_F(DeviceDockOnPlugs, WhatIsPluggedInAndOutShowsByItself) {
  show();
  plugged = {arm("/dev/hidraw0: Permission denied")};
  nodes = 2;
  ASSERT_TRUE(QTest::qWaitFor([&] { return headingOf(dock, "hid:SN0001") == QStringLiteral("Missing devices, and why"); }, 5000));
  EXPECT_EQ(rowOf(dock, "hid:SN0001")->text(1), QStringLiteral("/dev/hidraw0: Permission denied"));
  plugged.clear();
  nodes = 3;
  ASSERT_TRUE(QTest::qWaitFor([&] { return rowOf(dock, "hid:SN0001") == nullptr; }, 5000));
  const int before = asked;
  QTest::qWait(2500);
  EXPECT_EQ(asked, before) << "as long as nothing changes nobody is asked";
}

TEST_F(DeviceDockOnPlugs, WhileARunHasTheDevicesNobodyAsks) {
  show();
  dock.setBusy(true);
  nodes = 2;
  QTest::qWait(2500);
  dock.list();
  EXPECT_EQ(asked, 1);
  EXPECT_FALSE(button("deviceAgain")->isEnabled());
  dock.setBusy(false);
  EXPECT_TRUE(QTest::qWaitFor([&] { return asked == 2; }, 5000)) << "what was plugged meanwhile shows then";
}

TEST_F(DeviceDockOnPlugs, TheChosenOneIsTakenWithTheOptionsThatItHad) {
  show();
  QSignalSpy taken(&dock, &DeviceDock::taken);
  EXPECT_FALSE(button("deviceUse")->isEnabled()) << "no row is chosen";
  rows->setCurrentItem(rowOf(dock, "hid:SN0001"));
  QTest::mouseClick(button("deviceUse"), Qt::LeftButton);
  dock.setHand(QStringLiteral("hid:SN0001,model=polhem_v1"));
  QTest::mouseClick(button("deviceUse"), Qt::LeftButton);
  ASSERT_EQ(taken.size(), 2);
  EXPECT_EQ(taken[0][0].toString(), QStringLiteral("hid:SN0001"));
  EXPECT_EQ(taken[1][0].toString(), QStringLiteral("hid:SN0001,model=polhem_v1"));
}

TEST_F(DeviceDockOnPlugs, WhatIsNotThereCannotBeTaken) {
  plugged = {arm("its firmware is too old")};
  show();
  rows->setCurrentItem(rowOf(dock, "hid:SN0001"));
  EXPECT_FALSE(button("deviceUse")->isEnabled());
  EXPECT_FALSE(button("deviceLook")->isEnabled());
  EXPECT_EQ(child<QLabel>(dock, "deviceHint")->text(), QStringLiteral("its firmware is too old")) << "in full";
}

TEST_F(DeviceDockOnPlugs, WhatNeedsMoreThanItsNameIsToldAndNotTaken) {
  devices::FoundDevice replay = arm();
  replay.name = replay.kind = "replay";
  plugged = {replay};
  show();
  rows->setCurrentItem(rowOf(dock, "replay"));
  EXPECT_FALSE(button("deviceUse")->isEnabled());
  EXPECT_FALSE(button("deviceLook")->isEnabled());
  const QString hint = child<QLabel>(dock, "deviceHint")->text();
  EXPECT_TRUE(holds(hint, "replay:FILE"));
}

TEST(DeviceDock, SaysWhatIsThereWhatIsNotAndWhy) {
  DeviceDock dock;
  dock.resize(378, 420);
  dock.showExperiment(experiment::openExperiment("chain-slow"), true);
  dock.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&dock));
  QTreeWidgetItem* phantom = rowOf(dock, "phantom");
  ASSERT_NE(phantom, nullptr);
  EXPECT_TRUE(holds(phantom->text(1), "libHD.so"));
  EXPECT_EQ(headingOf(dock, "phantom"), QStringLiteral("Missing devices, and why"));
  EXPECT_EQ(headingOf(dock, "simulated"), QStringLiteral("Hands without a device"));
}

}  // namespace
}  // namespace reachlab::gui::docks
