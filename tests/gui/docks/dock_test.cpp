#include "gui/docks/dock.h"

#include <gtest/gtest.h>

#include <QComboBox>
#include <QGroupBox>
#include <QLabel>
#include <QListWidget>
#include <QMainWindow>
#include <QPushButton>
#include <memory>

#include "gui/docks/all_docks.h"
#include "gui/docks/experiment_docks.h"
#include "gui/widgets/fault_label.h"
#include "gui/widgets/fault_words.h"
#include "gui/widgets/key_field.h"
#include "gui/widgets/number_list_edit.h"
#include "gui/widgets/unit_spin_box.h"
#include "sim/experiment/checked_experiment.h"
#include "sim/experiment/experiment.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::docks {
namespace {

TEST(ObjectDock, AnEditLeavesWhatItDoesNotShow) {
  const experiment::CompiledExperiment chain = experiment::openExperiment("chain-moderate");
  const std::unique_ptr<Dock> dock(makeObjectDock());
  dock->showExperiment(chain, true);
  experiment::Experiment told;
  QObject::connect(dock.get(), &Dock::edited, dock.get(), [&](const experiment::Experiment& e, const QString&) { told = e; });
  auto* masses = dock->findChild<widgets::NumberListEdit*>(QStringLiteral("masses"));
  masses->setText(QStringLiteral("0.5 0.4"));
  Q_EMIT masses->editingFinished();
  EXPECT_EQ(told.object.masses, (std::vector<double>{0.5, 0.4}));
  EXPECT_EQ(told.object.stiffness.size(), 1u);
  told.object = chain.experiment().object;
  EXPECT_EQ(told, chain.experiment());
}

class EnvironmentDockTest : public ::testing::Test {
 protected:
  EnvironmentDockTest() {
    QObject::connect(dock_.get(), &Dock::edited, dock_.get(), [this](const experiment::Experiment& e, const QString& what) {
      told_ = e;
      what_ = what;
    });
    showExperiment(experiment::readExperiment("centre-out"));
  }
  void showExperiment(const experiment::Experiment& e) { dock_->showExperiment(experiment::CompiledExperiment(e), true); }
  // The user's change, taken over as the window takes it.
  void takeOver() {
    ASSERT_TRUE(experiment::check(told_).faults.empty());
    showExperiment(told_);
  }
  template <class Widget>
  Widget* child(const char* name) {
    return gui::child<Widget>(*dock_, name);
  }
  void choose(const char* combo, int index) {
    child<QComboBox>(combo)->setCurrentIndex(index);
    Q_EMIT child<QComboBox>(combo)->activated(index);
  }
  QList<widgets::UnitSpinBox*> numbersOf(const char* field) {
    return child<widgets::KeyField>(field)->findChildren<widgets::UnitSpinBox*>();
  }
  std::unique_ptr<Dock> dock_{makeEnvironmentDock()};
  experiment::Experiment told_;
  QString what_;
};

TEST_F(EnvironmentDockTest, AddsChangesAndRemovesForces) {
  child<QPushButton>("addForce")->click();
  EXPECT_EQ(what_, QStringLiteral("environment"));
  ASSERT_EQ(told_.environment.size(), 1u);
  EXPECT_EQ(told_.environment[0].law.index(), 0u) << "a viscous field";
  takeOver();
  numbersOf("viscous.matrix_n_s_per_m")[2]->setValue(-13);
  EXPECT_EQ(std::get<experiment::ViscousForce>(told_.environment.at(0).law).matrix[0][2], -13);
  takeOver();
  child<QPushButton>("addForce")->click();
  takeOver();
  child<QListWidget>("forces")->setCurrentRow(1);
  choose("forceKind", 3);
  ASSERT_EQ(told_.environment.size(), 2u);
  EXPECT_EQ(told_.environment[1], (experiment::HandForce{experiment::ChannelForce{}, experiment::ForceWhen::Trial}));
  takeOver();
  EXPECT_TRUE(numbersOf("channel.break_m")[0]->suffix().endsWith(QStringLiteral("m")));
  EXPECT_FALSE(child<widgets::KeyField>("channel.break_m")->toolTip().isEmpty());
  numbersOf("channel.break_m")[0]->setValue(0.05);
  EXPECT_EQ(std::get<experiment::ChannelForce>(told_.environment.at(1).law).breakDistance, 0.05);
  takeOver();
  child<QListWidget>("forces")->setCurrentRow(0);
  child<QPushButton>("removeForce")->click();
  ASSERT_EQ(told_.environment.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<experiment::ChannelForce>(told_.environment[0].law));
  told_.environment.clear();
  EXPECT_EQ(told_, experiment::readExperiment("centre-out")) << "and leaves the rest";
}

// The keys are those of the file, so that a file with each of them is an independent list.
TEST_F(EnvironmentDockTest, ShowsEveryKeyOfAFileAndTellsItUnchanged) {
  const std::string text = R"({ "schema_version": 1, "name": "all", "constraint": { "name": "free" }, "object": { "kind": "none" },
    "task": { "start": [0, 0, 0], "target": [0, 0, -0.1], "duration_s": 0.5,
              "tolerance": { "position_m": 0.01, "velocity_m_per_s": 0.05, "time_s": 0.2 } },
    "environment": [
      { "kind": "viscous", "matrix_n_s_per_m": [[1, 2, 3], [4, 5, 6], [7, 8, 9]], "when": "trial" },
      { "kind": "elastic", "matrix_n_per_m": [[10, 0, 0], [0, 20, 0], [0, 0, 30]], "centre_m": [0.01, 0.02, 0.03] },
      { "kind": "joint-viscous", "matrix_n_m_s_per_rad": [[1.5, 0.5], [0.5, -1.5]] },
      { "kind": "channel", "stiffness_n_per_m": 2000, "damping_n_s_per_m": 20, "half_width_m": 0.002, "ramp_s": 0.2, "break_m": 0.05 },
      { "kind": "pulse", "force_n": [0, 0, 5], "at": { "distance_m": 0.05 }, "duration_s": 0.2, "rise_s": 0.02 }],
    "cursor": { "clamp_deg": 20, "delay_s": 0.1, "show": "movement-end", "judge": "hand" } })";
  const experiment::Experiment all = experiment::parseExperiment(text, "all.json");
  showExperiment(all);
  for (std::size_t row = 0; row < all.environment.size(); ++row) {
    child<QListWidget>("forces")->setCurrentRow(static_cast<int>(row));
    const QString kind = child<QComboBox>("forceKind")->currentText();
    int fields = 0;
    for (auto* field : dock_->findChildren<widgets::KeyField*>())
      if (field->objectName().startsWith(kind + QLatin1Char('.'))) {
        ++fields;
        EXPECT_FALSE(field->toolTip().isEmpty()) << field->objectName().toStdString();
        told_ = {};
        Q_EMIT field->edited();
        EXPECT_EQ(told_, all) << field->objectName().toStdString();
      }
    EXPECT_EQ(fields, (std::vector<int>{2, 3, 2, 6, 4})[row]) << kind.toStdString();
  }
  Q_EMIT child<widgets::KeyField>("cursor.gain")->edited();
  EXPECT_EQ(told_, all);
}

TEST_F(EnvironmentDockTest, AnEntryThatIsRefusedAloneHoldsWithTheNext) {
  child<QPushButton>("addForce")->click();
  takeOver();
  choose("forceKind", 4);
  takeOver();
  numbersOf("pulse.rise_s")[0]->setValue(0.08);
  const QStringList faults = widgets::inWords(experiment::check(told_).faults);
  ASSERT_EQ(faults.size(), 1);
  EXPECT_TRUE(starts(faults[0], "force 1, duration: is 0.1, shorter than rise and fall"));
  dock_->showFaults(faults);
  EXPECT_EQ(child<QLabel>("environmentFaults")->text(), faults[0]);
  numbersOf("pulse.duration_s")[0]->setValue(0.2);
  const auto& pulse = std::get<experiment::PulseForce>(told_.environment.at(0).law);
  EXPECT_EQ(pulse.rise, 0.08);
  EXPECT_EQ(pulse.duration, 0.2);
}

TEST_F(EnvironmentDockTest, ACursorIsGivenAndTakenAwayOnlyWithoutAnObject) {
  auto* box = child<QGroupBox>("cursor");
  EXPECT_FALSE(box->isChecked());
  box->setChecked(true);
  EXPECT_EQ(told_.cursor, experiment::Cursor{});
  takeOver();
  numbersOf("cursor.rotation_deg")[0]->setValue(30);
  EXPECT_EQ(told_.cursor->rotation, 30);
  takeOver();
  box->setChecked(false);
  EXPECT_FALSE(told_.cursor.has_value());
  showExperiment(experiment::readExperiment("chain-moderate"));
  EXPECT_FALSE(box->isEnabled());
  EXPECT_FALSE(box->toolTip().isEmpty());
}

class EnvironmentAtTheWindow : public AtTheWindow {};

TEST_F(EnvironmentAtTheWindow, IsUndoneRedoneAndAPlansIsOnlyShown) {
  request_.what = "centre-out";
  app::MainWindow& window = make();
  find<QPushButton>("addForce")->click();
  EXPECT_EQ(window.session().experiment().environment.size(), 1u);
  EXPECT_EQ(find<QListWidget>("forces")->count(), 1);
  window.edits().undo();
  EXPECT_TRUE(window.session().experiment().environment.empty());
  EXPECT_EQ(find<QListWidget>("forces")->count(), 0);
  window.edits().redo();
  EXPECT_EQ(find<QListWidget>("forces")->count(), 1);
  // A task without a distance has no channel: the fault is beside the fields, and the force stays.
  experiment::Experiment still = window.session().experiment();
  still.task->target = still.task->start;
  still.text = toJson(still);
  window.session().setProgramme(session::programmeOf(experiment::CompiledExperiment(still)));
  auto* kind = find<QComboBox>("forceKind");
  kind->setCurrentIndex(3);
  Q_EMIT kind->activated(3);
  EXPECT_TRUE(find<QLabel>("environmentFaults")->text().startsWith(QStringLiteral("force 1, kind: is channel")));
  EXPECT_EQ(kind->currentIndex(), 0);
  window.edits().setClean();
  window.openExperiment(QStringLiteral("curl-adaptation"));
  EXPECT_FALSE(find<QPushButton>("addForce")->isEnabled());
}

TEST(AllDocks, EachHasANameOfItsOwnByWhichTheLayoutIsRemembered) {
  QMainWindow window;
  const Docks docks = makeDocks(window);
  QStringList names;
  for (const Dock* dock : docks.all) names << dock->objectName();
  EXPECT_EQ(names.removeDuplicates(), 0);
  EXPECT_FALSE(names.contains(QString()));
  EXPECT_EQ(docks.all.size(), static_cast<std::size_t>(window.findChildren<QDockWidget*>().size())) << "none is forgotten";
}

}  // namespace
}  // namespace reachlab::gui::docks
