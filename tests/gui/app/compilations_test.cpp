// How often the window compiles the formula that was typed, counted where it is compiled (tests/constraints/count_compilations.h).
#include <gtest/gtest.h>

#include <QLineEdit>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <algorithm>

#include "gui/app/main_window.h"
#include "gui/choosers/constraint_chooser.h"
#include "gui/session/session_controller.h"
#include "tests/constraints/count_compilations.h"

namespace reachlab::gui::app {
namespace {

const std::string kTyped = "0 | 0.1*cos(phi) | 0.06*sin(phi)";

void type(QWidget& chooser, const char* field, const char* text) {
  auto* line = chooser.findChild<QLineEdit*>(QLatin1String(field));
  ASSERT_NE(line, nullptr) << field;
  line->setFocus();
  line->selectAll();
  QTest::keyClicks(line, QLatin1String(text));
}

}  // namespace

TEST(Compilations, OfATypedFormulaThatIsAcceptedAreOne) {
  const QTemporaryDir folder;
  session::SessionRequest request;
  request.what = "ellipse";
  request.place.data = (folder.path() + QStringLiteral("/data")).toStdString();
  request.device = "simulated:noise=0";
  request.trials = 1;
  request.seed = 1;
  request.fast = true;
  MainWindow window(request);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
  window.chooseConstraint();
  docks::ConstraintChooser& chooser = window.chooser();
  type(chooser, "formula_x", "0");
  type(chooser, "formula_y", "0.1*cos(phi)");

  // The preview is a picture of what stands there now: each text that is a formula is another one, and is compiled for its picture. The last
  // of them is the one that will be accepted.
  (void)test::takeCompilations();
  const std::string last = "0.06*sin(phi)";
  type(chooser, "formula_z", last.c_str());
  const std::vector<std::string> preview = test::takeCompilations();
  EXPECT_LE(preview.size(), last.size()) << "one a key at most";
  EXPECT_EQ(std::count(preview.begin(), preview.end(), kTyped), 1);

  // Accepted: checked as a value, and compiled with that; the scene that must not be refused later, the picture, the path and the seven
  // predictions take it from there.
  QTest::mouseClick(chooser.findChild<QPushButton*>(QStringLiteral("use")), Qt::LeftButton);
  ASSERT_EQ(window.session().experiment().constraint.curve.at(2), last);
  ASSERT_TRUE(QTest::qWaitFor([&] { return window.predictionsReady(); }, 60000));
  EXPECT_EQ(test::takeCompilations(), std::vector<std::string>{kTyped});

  // A run of it: protocol, engine, device, recording, dataset and the errors of the trial.
  window.nextTrial();
  ASSERT_EQ(window.message().toStdString(), "");
  window.session().poll();
  window.session().endRun();
  EXPECT_EQ(test::takeCompilations(), std::vector<std::string>{});
}

}  // namespace reachlab::gui::app
