#include "gui/docks/device_dock.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <QTreeWidget>

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
  // The row of that name, and the heading that it stands under.
  std::pair<QTreeWidgetItem*, QString> rowOf(const QString& name) const {
    const auto found = rows->findItems(name, Qt::MatchExactly | Qt::MatchRecursive, 0);
    return found.isEmpty() ? std::pair<QTreeWidgetItem*, QString>() : std::pair(found.front(), found.front()->parent()->text(0));
  }
  QPushButton* button(const char* name) const { return dock.findChild<QPushButton*>(QLatin1String(name)); }

  DeviceDock dock{{[] { return nodes; },
                   [] {
                     ++asked;
                     return plugged;
                   }},
                  nullptr};
  QTreeWidget* rows = dock.findChild<QTreeWidget*>(QStringLiteral("deviceRows"));
};

TEST_F(DeviceDockOnPlugs, NobodyIsAskedBeforeItIsSeen) {
  EXPECT_EQ(asked, 0);
  show();
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(rowOf(QStringLiteral("hid:SN0001")).second, QStringLiteral("Connected"));
}

TEST_F(DeviceDockOnPlugs, WhatIsPluggedInAndOutShowsByItself) {
  show();
  plugged = {arm("/dev/hidraw0: Permission denied")};
  nodes = 2;
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return rowOf(QStringLiteral("hid:SN0001")).second == QStringLiteral("Missing devices, and why"); }, 5000));
  EXPECT_EQ(rowOf(QStringLiteral("hid:SN0001")).first->text(1), QStringLiteral("/dev/hidraw0: Permission denied"));
  plugged.clear();
  nodes = 3;
  ASSERT_TRUE(QTest::qWaitFor([&] { return rowOf(QStringLiteral("hid:SN0001")).first == nullptr; }, 5000));
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
  rows->setCurrentItem(rowOf(QStringLiteral("hid:SN0001")).first);
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
  rows->setCurrentItem(rowOf(QStringLiteral("hid:SN0001")).first);
  EXPECT_FALSE(button("deviceUse")->isEnabled());
  EXPECT_FALSE(button("deviceLook")->isEnabled());
  EXPECT_EQ(dock.findChild<QLabel*>(QStringLiteral("deviceHint"))->text(), QStringLiteral("its firmware is too old")) << "in full";
}

TEST(DeviceDock, SaysWhatIsThereWhatIsNotAndWhy) {
  DeviceDock dock;
  dock.resize(378, 420);
  dock.showExperiment(experiment::openExperiment("chain-slow"), true);
  dock.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&dock));
  auto* rows = dock.findChild<QTreeWidget*>(QStringLiteral("deviceRows"));
  const auto rowOf = [&](const QString& name) { return rows->findItems(name, Qt::MatchExactly | Qt::MatchRecursive, 0).value(0); };
  QTreeWidgetItem* phantom = rowOf(QStringLiteral("phantom"));
  ASSERT_NE(phantom, nullptr);
  EXPECT_TRUE(phantom->text(1).contains(QStringLiteral("libHD.so"))) << phantom->text(1).toStdString();
  EXPECT_EQ(phantom->parent()->text(0), QStringLiteral("Missing devices, and why"));
  QTreeWidgetItem* subject = rowOf(QStringLiteral("simulated"));
  ASSERT_NE(subject, nullptr);
  EXPECT_EQ(subject->parent()->text(0), QStringLiteral("Hands without a device"));
  rows->setCurrentItem(phantom);
}

}  // namespace
}  // namespace reachlab::gui::docks
