#include "gui/docks/dock.h"

#include <gtest/gtest.h>

#include <QLabel>
#include <QMainWindow>
#include <QVBoxLayout>

#include "gui/docks/all_docks.h"
#include "gui/docks/object_dock.h"
#include "gui/widgets/fault_label.h"
#include "gui/widgets/number_list_edit.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::docks {
namespace {

// All that a dock needs: what to display, and what to tell.
class NameDock : public Dock {
 public:
  NameDock() : Dock(QStringLiteral("Name"), QStringLiteral("nameDock"), nullptr) {
    auto* page = new QWidget;
    auto* layout = new QVBoxLayout(page);
    layout->addWidget(label_);
    layout->addWidget(faults());
    setBody(page);
  }
  void rename(const std::string& name) {
    experiment::Experiment changed = shown();
    changed.name = name;
    Q_EMIT edited(changed, QStringLiteral("name"));
  }
  QString text() const { return label_->text(); }
  QString faultText() const { return faults()->text(); }

 protected:
  void display(const experiment::CompiledExperiment& experiment, bool editable) override {
    label_->setText(QString::fromStdString(experiment.experiment().name) + (editable ? QString() : QStringLiteral(" (fixed)")));
  }

 private:
  QLabel* label_ = new QLabel;
};

TEST(Dock, TakesAnExperimentAndGivesTheEditedOneWithTheRestAsItWas) {
  const experiment::CompiledExperiment chain = experiment::openExperiment("chain-moderate");
  NameDock dock;
  dock.showExperiment(chain, false);
  EXPECT_EQ(dock.text(), QStringLiteral("chain-moderate (fixed)"));
  experiment::Experiment told;
  QString what;
  QObject::connect(&dock, &Dock::edited, &dock, [&](const experiment::Experiment& e, const QString& change) { told = e, what = change; });
  dock.rename("other");
  EXPECT_EQ(what, QStringLiteral("name"));
  EXPECT_EQ(told.name, "other");
  told.name = chain.experiment().name;
  EXPECT_EQ(told, chain.experiment());
  dock.showFaults({QStringLiteral("no"), QStringLiteral("never")});
  EXPECT_EQ(dock.faultText(), QStringLiteral("no\nnever"));
}

TEST(ObjectDock, AnEditLeavesWhatItDoesNotShow) {
  const experiment::CompiledExperiment chain = experiment::openExperiment("chain-moderate");
  ObjectDock dock;
  dock.showExperiment(chain, true);
  experiment::Experiment told;
  QObject::connect(&dock, &Dock::edited, &dock, [&](const experiment::Experiment& e, const QString&) { told = e; });
  auto* masses = dock.findChild<widgets::NumberListEdit*>(QStringLiteral("masses"));
  masses->setText(QStringLiteral("0.5 0.4"));
  Q_EMIT masses->editingFinished();
  EXPECT_EQ(told.object.masses, (std::vector<double>{0.5, 0.4}));
  EXPECT_EQ(told.object.stiffness.size(), 1u);
  told.object = chain.experiment().object;
  EXPECT_EQ(told, chain.experiment());
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
