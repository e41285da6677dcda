#include <gtest/gtest.h>

#include <QApplication>
#include <QTemporaryDir>

#include "gui/scene/scene_view.h"
#include "gui/widgets/theme.h"

#ifdef __SANITIZE_ADDRESS__
// Libraries stay loaded to the end, so that what a graphics driver never frees is reported under the driver's name.
extern "C" int dlclose(void*) noexcept { return 0; }
#endif

// The program's own start: a German user's, so that every test of the window is one of the locale as well.
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  qputenv("LC_ALL", "de_DE.UTF-8");
  qputenv("LANG", "de_DE.UTF-8");
  const QTemporaryDir own;
  qputenv("REACHLAB_CONSTRAINTS", own.path().toUtf8());  // nothing of the user's, and nothing left behind
  // A test that dies leaves its settings to the test that waits for its death.
  qputenv("XDG_CONFIG_HOME", qEnvironmentVariable("REACHLAB_TEST_CONFIG", own.path()).toUtf8());
  reachlab::gui::scene::applySurfaceFormat();
  QApplication application(argc, argv);
  QApplication::setOrganizationName("reachlab");
  QApplication::setApplicationName("test");
  reachlab::gui::widgets::applyTheme(application);
  return RUN_ALL_TESTS();
}
