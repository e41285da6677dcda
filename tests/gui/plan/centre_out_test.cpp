// Reaches to a ring of targets, without a force, in a field and in a channel: from the plan's dialog to the list of recorded trials.
#include <gtest/gtest.h>

#include <QComboBox>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <cmath>
#include <map>
#include <numbers>

#include "gui/inspector/inspector.h"
#include "gui/plan/plan_composer.h"
#include "gui/scene/scene_view.h"
#include "gui/session/session_overlay.h"
#include "sim/record/configuration/run_configuration.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::plan {
namespace {

class CentreOut : public AtTheWindow {
 protected:
  CentreOut() {
    request_.what = "centre-out";
    request_.device = "simulated:kind=ofc";
    request_.fast = true;
  }
  QString compose() {
    window_->composePlan();
    auto* dialog = window_->findChild<PlanComposer*>();
    find<QSpinBox>("planTrials")->setValue(24);
    auto* kinds = find<QTableWidget>("planKinds");
    const char* const rows[][2] = {
        {"null", R"("environment": [])"},
        {"field", R"("environment": [{ "kind": "viscous", "matrix_n_s_per_m": [[0, 0, 13], [0, 0, 0], [-13, 0, 0]] }])"},
        {"channel", R"("environment": [{ "kind": "channel" }])"}};
    for (int row = 0; row < 3; ++row) {
      find<QPushButton>("planAddKind")->click();
      kinds->item(row, 0)->setText(QLatin1String(rows[row][0]));
      kinds->item(row, 4)->setText(QLatin1String(rows[row][1]));
    }
    find<QComboBox>("planTargets")->setCurrentIndex(1);
    find<QComboBox>("planOrder")->setCurrentIndex(1);
    EXPECT_TRUE(dialog->faults().isEmpty()) << dialog->faults().join(QLatin1Char('\n')).toStdString();
    const QString file = folder_.filePath(QStringLiteral("centre.json"));
    dialog->saveTo(file);
    dialog->close();
    return file;
  }
};

TEST_F(CentreOut, IsComposedRecordedAndListedWithKindsAndTargets) {
  app::MainWindow& window = open();
  const QString file = compose();
  Q_EMIT window.findChild<PlanComposer*>()->used(file);
  ASSERT_TRUE(window.session().isPlan()) << window.message().toStdString();
  std::map<std::string, int> kinds, targets, conditions;
  scene::Camera first;
  for (int trial = 1; trial <= 24; ++trial) {
    window.nextTrial();
    ASSERT_EQ(window.message().toStdString(), "");
    const scene::ScenePlan& seen = window.view().plan();
    const record::RunConfiguration& run = window.session().run()->configuration();
    window.session().poll();
    const record::RunScene* scene = record::sceneOf(run, window.session().lastTrial()->planned);
    ASSERT_NE(scene, nullptr);
    ++kinds[scene->kind];
    ++targets[scene->target];
    ++conditions[scene->condition];
    const double angle = 0.25 * std::numbers::pi * (std::stoi(scene->target) - 1);  // from the right, counterclockwise as seen from above
    EXPECT_NEAR(norm(seen.target - Vec3{0.1 * std::cos(angle), 0, -0.1 * std::sin(angle)}), 0, 1e-9) << scene->condition;
    EXPECT_EQ(app::overlayOf(window.session(), false, false).counter.toStdString(),
              "Block 1 of 1, trial " + std::to_string(trial) + " of 24: " + scene->kind + ", target " + scene->target);
    EXPECT_EQ(seen.otherPlaces.size(), 7u);
    EXPECT_EQ(seen.forces.field.empty(), scene->kind != "field");
    EXPECT_EQ(seen.forces.channel.quads.empty(), scene->kind != "channel");
    if (trial == 1) first = window.view().camera();
    EXPECT_LT(norm(window.view().camera().position - first.position), 1e-12) << "every trial is seen from the same side";
  }
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"null", 8}, {"field", 8}, {"channel", 8}}));
  EXPECT_EQ(targets.size(), 8u);
  for (const auto& [target, count] : targets) EXPECT_EQ(count, 3) << target;
  find<QPushButton>("endInspect")->click();
  ASSERT_TRUE(window.inspecting());
  inspector::InspectorPage& page = window.inspector();
  ASSERT_TRUE(QTest::qWaitFor([&] { return page.table().rowCount() == 24; }, 20000));
  std::map<std::string, int> listed;
  for (int row = 0; row < 24; ++row) ++listed[page.table().index(row, inspector::TrialTable::kCondition).data().toString().toStdString()];
  EXPECT_EQ(listed, conditions);
  EXPECT_TRUE(listed.contains("field 3")) << listed.begin()->first;
}

}  // namespace
}  // namespace reachlab::gui::plan
