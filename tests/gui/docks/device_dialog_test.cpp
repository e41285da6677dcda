#include "gui/choosers/device_dialog.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTest>

#include "gui/widgets/theme.h"
#include "tests/devices/fakes/fake_haply.h"

namespace reachlab::gui::docks {
namespace {

experiment::CompiledExperiment chain() { return experiment::openExperiment("chain-slow"); }

const auto nobody = [](const QString&) {};

TEST(DeviceDialog, TheMouseIsSeenInTheWindowItself) {
  DeviceDialog dialog(chain(), QStringLiteral("mouse"), nobody, nullptr);
  EXPECT_FALSE(dialog.findChild<QPushButton*>(QStringLiteral("deviceOpen"))->isEnabled());
}

TEST(DeviceDialog, ShowsADeviceLiveAndLetsItGo) {
  QString taken;
  DeviceDialog dialog(
      chain(), QStringLiteral("virtual:premium15"), [&](const QString& name) { taken = name; }, nullptr);
  dialog.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&dialog));
  const auto* words = dialog.findChild<QLabel*>(QStringLiteral("deviceNumbers"));
  auto* button = dialog.findChild<QPushButton*>(QStringLiteral("deviceOpen"));
  QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(QTest::qWaitFor(
      [&] { return words->text().contains(QStringLiteral("reports/s")) && !words->text().contains(QStringLiteral(" 0.0 reports/s")); },
      20000));
  EXPECT_FALSE(dialog.findChild<QLineEdit*>(QStringLiteral("deviceName"))->isEnabled());
  QTest::mouseClick(button, Qt::LeftButton);
  EXPECT_TRUE(words->text().isEmpty());
  QTest::mouseClick(dialog.findChild<QPushButton*>(QStringLiteral("deviceTake")), Qt::LeftButton);
  EXPECT_EQ(taken, QStringLiteral("virtual:premium15"));
}

TEST(DeviceDialog, ADeviceThatIsBackIsNotCalledLost) {
  test::FakeHaply service;
  DeviceDialog dialog(chain(), QStringLiteral("haply:port=%1").arg(service.port()), nobody, nullptr);
  dialog.openOrLetGo();
  const auto* hint = dialog.findChild<QLabel*>(QStringLiteral("deviceState"));
  const QString usual = hint->text();
  service.setPlugged(false);
  ASSERT_TRUE(QTest::qWaitFor([&] { return hint->text().contains(QStringLiteral("is lost")); }, 20000)) << hint->text().toStdString();
  service.setPlugged(true);
  EXPECT_TRUE(QTest::qWaitFor([&] { return hint->text() == usual; }, 20000)) << hint->text().toStdString();
}

TEST(DeviceView, ShowsAHandBeyondItsRangeAtTheEdge) {
  DeviceView picture;
  picture.resize(picture.sizeHint());
  devices::LiveDevice::View view{};
  view.valid = true;
  view.position = {1, 0, 0};
  picture.display(view, 0.15, 1);
  const QImage image = picture.grab().toImage();
  int seen = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) seen += image.pixel(x, y) == widgets::toQColor(widgets::colours::kHand).rgb() ? 1 : 0;
  EXPECT_GT(seen, 50) << "in both pictures";
}

TEST(DeviceDialog, ADeviceThatCannotBeHadIsSaidInItsWords) {
  DeviceDialog dialog(chain(), QStringLiteral("hid:NOWHERE"), nobody, nullptr);
  dialog.openOrLetGo();
  bool said = false;
  for (const QLabel* label : dialog.findChildren<QLabel*>())
    said = said || label->text().contains(QStringLiteral("no WoodenHaptics or Polhem arm"));
  EXPECT_TRUE(said);
}

}  // namespace
}  // namespace reachlab::gui::docks
