// How often the window compiles the formula that was typed, counted where it is compiled (tests/constraints/count_compilations.h).
#include <QLineEdit>
#include <QPushButton>
#include <algorithm>

#include "gui/choosers/constraint_chooser.h"
#include "tests/constraints/count_compilations.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::app {
namespace {

const std::string kTyped = "0 | 0.1*cos(phi) | 0.06*sin(phi)";

class Compilations : public AtTheWindow {};

TEST_F(Compilations, OfATypedFormulaThatIsAcceptedAreOne) {
  request_.what = "ellipse";
  request_.device = "simulated:noise=0";
  request_.trials = 1;
  request_.fast = true;
  MainWindow& window = open();
  window.chooseConstraint();
  docks::ConstraintChooser& chooser = window.chooser();
  const auto typeInto = [&](const char* field, const char* text) {
    type(chooser.findChild<QLineEdit*>(QLatin1String(field)), text, false);
  };
  typeInto("formula_x", "0");
  typeInto("formula_y", "0.1*cos(phi)");

  // The preview is a picture of what stands there now: each text that is a formula is another one, and is compiled for its picture. The last
  // of them is the one that will be accepted.
  (void)test::takeCompilations();
  const std::string last = "0.06*sin(phi)";
  typeInto("formula_z", last.c_str());
  const std::vector<std::string> preview = test::takeCompilations();
  EXPECT_LE(preview.size(), last.size()) << "one a key at most";
  EXPECT_EQ(std::count(preview.begin(), preview.end(), kTyped), 1);

  // Accepted: checked as a value, and compiled with that; the scene that must not be refused later, the picture, the path and the seven
  // predictions take it from there.
  QTest::mouseClick(chooser.findChild<QPushButton*>("use"), Qt::LeftButton);
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

}  // namespace
}  // namespace reachlab::gui::app
