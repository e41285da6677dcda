#include <gtest/gtest.h>

#include <QApplication>
#include <QTemporaryDir>

#include "gui/scene_view.h"
#include "gui/theme.h"

// The program's own start: a German user's, so that every test of the window is one of the locale as well.
int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  qputenv("LC_ALL", "de_DE.UTF-8");
  qputenv("LANG", "de_DE.UTF-8");
  const QTemporaryDir own;
  qputenv("REACHLAB_CONSTRAINTS", own.path().toUtf8());  // nothing of the user's, and nothing left behind
  reachlab::applySurfaceFormat();
  QApplication application(argc, argv);
  reachlab::applyTheme(application);
  return RUN_ALL_TESTS();
}
