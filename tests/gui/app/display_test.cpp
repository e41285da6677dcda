// A window that cannot be shown is said in a sentence, with the exit code of a resource that cannot be had.
#include <gtest/gtest.h>

#include <QProcess>

#include "test_paths.h"

namespace reachlab::gui::app {
namespace {

TEST(Display, ThatDoesNotAnswerIsNamedWithTheRemedy) {
  QProcess program;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.remove(QStringLiteral("QT_QPA_PLATFORM"));
  environment.insert(QStringLiteral("DISPLAY"), QStringLiteral(":4242"));
  program.setProcessEnvironment(environment);
  program.start(QStringLiteral(REACHLAB_BINARY_DIR "/gui/reachlab"), QStringList());
  ASSERT_TRUE(program.waitForFinished(60000));
  EXPECT_EQ(program.exitStatus(), QProcess::NormalExit);
  EXPECT_EQ(program.exitCode(), 3);
  EXPECT_EQ(
      program.readAllStandardError().toStdString(),
      "error: the display :4242 does not answer\nhelp: set DISPLAY to the display of your session, or use `reach run`, which needs no window\n");
}

}  // namespace
}  // namespace reachlab::gui::app
