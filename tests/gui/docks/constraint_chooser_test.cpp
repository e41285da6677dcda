#include "gui/choosers/constraint_chooser.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QDoubleSpinBox>
#include <QSlider>
#include <QTest>
#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/error.h"
#include "gui/choosers/formula_editor.h"
#include "gui/docks/constraint_dock.h"
#include "gui/scene/scene_view.h"
#include "sim/dynamics/scene.h"
#include "tests/gui/child.h"
#include "tests/gui/words.h"

namespace reachlab::gui::docks {
namespace {

class Chooser : public ::testing::Test {
 protected:
  Chooser() {
    chooser_.QDialog::show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&chooser_));
    QObject::connect(&chooser_, &ConstraintChooser::used, &chooser_, [this](const ConstraintChoice& choice) { used_ = choice; });
  }
  template <typename T>
  T* find(const char* name) {
    return child<T>(chooser_, name);
  }
  void type(const char* field, const char* text) {
    auto* line = find<QLineEdit>(field);
    line->setFocus();
    line->selectAll();
    QTest::keyClicks(line, QLatin1String(text));
    if (*text == 0) line->clear();
  }
  void typeFormulas(const char* x, const char* y, const char* z) {
    type("formula_x", x);
    type("formula_y", y);
    type("formula_z", z);
  }

  ConstraintChooser chooser_;
  std::optional<ConstraintChoice> used_;
};

TEST_F(Chooser, ListsTheCatalogueWithThumbnailsAndFindsByName) {
  auto* list = find<QListWidget>("definitions");
  ASSERT_GE(list->count(), static_cast<int>(constraints::catalogue().size()));
  for (int i = 0; i < list->count(); ++i) EXPECT_FALSE(list->item(i)->icon().isNull()) << list->item(i)->text().toStdString();
  const auto shown = [&] {
    int count = 0;
    for (int i = 0; i < list->count(); ++i) count += list->item(i)->isHidden() ? 0 : 1;
    return count;
  };
  type("search", "line");
  EXPECT_GE(shown(), 1);
  EXPECT_LT(shown(), std::max(2, list->count()));
  type("search", "no such thing");
  EXPECT_EQ(shown(), 0);
}

TEST_F(Chooser, AFormulasFaultIsToldAtItsCharacter) {
  type("formula_y", "0.1*cos(phj)+");
  auto* fault = find<QLabel>("fault_y");
  EXPECT_TRUE(fault->isVisible());
  EXPECT_TRUE(starts(fault->text(), "character "));
  EXPECT_FALSE(find<QPushButton>("use")->isEnabled());
  EXPECT_FALSE(chooser_.choice().has_value());
  type("formula_y", "0.1*cos(phi)");
  EXPECT_FALSE(fault->isVisible());
}

TEST_F(Chooser, ATypedFormulaIsDrawnGetsSlidersAndIsUsed) {
  typeFormulas("0", "a*cos(phi)", "b*sin(phi)");
  ASSERT_TRUE(chooser_.choice().has_value());
  const auto* preview = chooser_.findChild<scene::SceneView*>();
  ASSERT_NE(preview, nullptr);
  EXPECT_GT(preview->plan().curve.pointCount(), 32u);
  // The line's places, 0 and 2 pi, are one place here: others are given.
  EXPECT_GT(norm(preview->plan().target - preview->plan().start), 0.01);
  const double before = preview->plan().size;
  find<QSlider>("slider_a")->setValue(500);  // from 0.1 to 1
  EXPECT_GT(preview->plan().size, 2 * before);
  QTest::mouseClick(find<QPushButton>("use"), Qt::LeftButton);
  ASSERT_TRUE(used_.has_value());
  EXPECT_EQ(used_->spec.curve, (std::vector<std::string>{"0", "a*cos(phi)", "b*sin(phi)"}));
  EXPECT_EQ(used_->spec.shape.at("a"), 1.0);
}

TEST_F(Chooser, AFormulaThatDegeneratesEverywhereIsRefusedWithAReason) {
  typeFormulas("0.1", "0.2", "0.3");
  EXPECT_FALSE(chooser_.choice().has_value());
  EXPECT_TRUE(find<QLabel>("fault")->isVisible());
}

TEST_F(Chooser, AFormulaWithoutAnyValueIsToldWhileItIsTyped) {
  const auto fault = [&] { return find<QLabel>("fault")->isVisible() ? find<QLabel>("fault")->text() : QString(); };
  type("formula_x", "0.1*sqrt(-1-phi^2)");
  EXPECT_TRUE(starts(fault(), "x has no value at any phi from -0.3927 to 6.283: sqrt is given"));
  EXPECT_TRUE(holds(fault(), "0 or more for sqrt"));
  EXPECT_FALSE(find<QPushButton>("use")->isEnabled());
  type("formula_x", "0.1*sqrt(1+phi^2)");
  EXPECT_EQ(fault(), QString()) << "gone with its cause";
  EXPECT_TRUE(find<QPushButton>("use")->isEnabled());
  type("formula_x", "0.1*log(phi-20)");
  EXPECT_TRUE(holds(fault(), "log is given -"));
  type("formula_x", "0.1*log(phi-1)");
  EXPECT_FALSE(holds(fault(), "no value at any")) << "it has one beyond 1";
}

TEST_F(Chooser, ASavedDefinitionIsInTheListReadsBackAndHasItsSlidersInTheDock) {
  typeFormulas("0", "0.1*cos(phi)", "depth*sin(2*phi)");
  type("definitionName", "my-eight");
  QTest::mouseClick(find<QPushButton>("save"), Qt::LeftButton);
  std::vector<Fault> faults;
  const auto own = constraints::readDefinitionFolder(constraints::userDefinitionFolder(), faults);
  ASSERT_EQ(own.size(), 1u) << find<QLabel>("saved")->text().toStdString();
  EXPECT_EQ(own[0].name, "my-eight");
  EXPECT_EQ(own[0].coordinates[2], "depth*sin(2*phi)");
  EXPECT_EQ(find<QListWidget>("definitions")->count(), static_cast<int>(constraints::catalogue().size()) + 1);
  experiment::Experiment onIt;
  onIt.constraint.name = "my-eight";
  onIt.object.masses = {1};
  onIt.coupling = experiment::Coupling{600, 0};
  ConstraintDock dock;
  dock.showExperiment(experiment::CompiledExperiment(onIt), true);
  child<QSlider>(dock, "slider_depth");
  std::filesystem::remove(constraints::userDefinitionFolder() + "/my-eight.json");
}

TEST_F(Chooser, ASliderGoesWithItsName) {
  type("formula_x", "R*cos(phi)");
  type("formula_y", "R*sin(phi)");
  find<QSlider>("slider_R")->setValue(400);
  const int value = find<QSlider>("slider_R")->value();
  auto* line = find<QLineEdit>("formula_z");
  line->clear();
  for (const char letter : std::string("0.1*sin(phi)")) {
    QTest::keyClick(line, letter);
    const auto names = parameterNames(constraints::ConstraintKind::Curve, {line->text().toStdString(), "R", ""});
    for (const auto* slider : chooser_.findChildren<QSlider*>()) {
      const std::string name = slider->objectName().mid(7).toStdString();
      EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name << " in " << line->text().toStdString();
    }
  }
  EXPECT_EQ(find<QSlider>("slider_R")->value(), value);  // the others stand where they stood
}

TEST_F(Chooser, ANameBesideAVariableIsASliderButAskedAbout) {
  type("formula_y", "0.1*cos(phj)");
  type("formula_z", "0.1*phi");
  auto* fault = find<QLabel>("fault_y");
  EXPECT_EQ(fault->text().toStdString(), "phj becomes a slider; did you mean phi?");
  EXPECT_TRUE(chooser_.choice().has_value());
  type("formula_y", "0.1*cos(phi)");
  EXPECT_FALSE(fault->isVisible());
}

TEST_F(Chooser, ATypedNamesRangeIsTyped) {
  type("formula_x", "0.05*sin(k*phi)");
  type("formula_y", "0.1*cos(phi)");
  auto* value = find<QDoubleSpinBox>("value_k");
  value->selectAll();
  QTest::keyClicks(value, QStringLiteral("5"));
  QTest::keyClick(value, Qt::Key_Return);
  ASSERT_TRUE(chooser_.choice().has_value());
  EXPECT_EQ(chooser_.choice()->spec.shape.at("k"), 5) << "beyond the slider's end, which follows";
  EXPECT_EQ(find<QDoubleSpinBox>("high_k")->value(), 5);
  auto* high = find<QDoubleSpinBox>("high_k");
  high->selectAll();
  QTest::keyClicks(high, QStringLiteral("20"));
  QTest::keyClick(high, Qt::Key_Return);
  EXPECT_EQ(chooser_.choice()->spec.shape.at("k"), 5);
  find<QSlider>("slider_k")->setValue(500);
  EXPECT_EQ(chooser_.choice()->spec.shape.at("k"), 20);
}

// The default chain cannot move on a surface: the dialog says so, stays, and offers what can.
TEST(ConstraintDock, AChainOnASurfaceIsOfferedAsOneMass) {
  const experiment::CompiledExperiment chain = experiment::openExperiment("chain-moderate");
  ConstraintDock dock;
  dock.showExperiment(chain, true);
  experiment::Experiment told;
  QObject::connect(&dock, &Dock::edited, &dock, [&](const experiment::Experiment& e, const QString&) {
    told = e;
    try {
      (void)dynamics::compileScene(experiment::CompiledExperiment(e));
      dock.showFaults({});
    } catch (const Error& fault) {
      dock.showFaults({QString::fromUtf8(fault.what())});
    }
  });
  dock.choose();
  ConstraintChooser& chooser = dock.chooser();
  ASSERT_TRUE(QTest::qWaitForWindowExposed(&chooser));
  auto* list = child<QListWidget>(chooser, "definitions");
  const auto surfaces = list->findItems(QStringLiteral("torus\nsurface"), Qt::MatchExactly);
  ASSERT_FALSE(surfaces.isEmpty());
  list->setCurrentItem(surfaces.front());
  child<QPushButton>(chooser, "use")->click();
  EXPECT_TRUE(chooser.isVisible());
  EXPECT_TRUE(child<QLabel>(chooser, "refusal")->isVisible());
  auto* onePoint = child<QPushButton>(chooser, "usePoint");
  ASSERT_TRUE(onePoint->isVisible());
  onePoint->click();
  EXPECT_FALSE(chooser.isVisible());
  EXPECT_EQ(told.object.kind, experiment::ObjectKind::Point);
  EXPECT_EQ(told.object.masses, (std::vector<double>{3}));
}

TEST(ConstraintChooser, FitsOnAFullHdScreenAtAScaleOf2) {
  const ConstraintChooser chooser;
  EXPECT_LE(chooser.minimumSizeHint().width(), 960 - 8) << "with the frame";
  EXPECT_LE(chooser.minimumSizeHint().height(), 540 - 60) << "with title bar and panel";
}

TEST(FormulaNames, BesideAVariableAreOneLetterOrTheCaseApart) {
  for (const char* name : {"phj", "Phi", "ph", "phii", "pih"})
    EXPECT_EQ(variableMeant(constraints::ConstraintKind::Curve, name), "phi") << name;
  for (const char* name : {"r", "p", "theta", "u"}) EXPECT_EQ(variableMeant(constraints::ConstraintKind::Curve, name), "") << name;
  EXPECT_EQ(variableMeant(constraints::ConstraintKind::Surface, "U"), "u");
  EXPECT_EQ(variableMeant(constraints::ConstraintKind::Surface, "vv"), "v");
  for (const char* name : {"a", "uv", "u0", "phj"}) EXPECT_EQ(variableMeant(constraints::ConstraintKind::Surface, name), "") << name;
}

TEST(FormulaNames, AreWhatIsNeitherVariableConstantNorFunction) {
  EXPECT_EQ(parameterNames(constraints::ConstraintKind::Curve, {"r*cos(phi)+pi", "2e-3*k_1", "exp(-u)"}),
            (std::vector<std::string>{"r", "k_1", "u"}));
  EXPECT_EQ(parameterNames(constraints::ConstraintKind::Surface, {"u", "v", "phi"}), (std::vector<std::string>{"phi"}));
}

}  // namespace
}  // namespace reachlab::gui::docks
