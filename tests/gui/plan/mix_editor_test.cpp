#include "gui/plan/mix_editor.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>

#include "tests/gui/child.h"

namespace reachlab::gui::plan {
namespace {

TEST(MixEditor, MakesKindsTargetsAndOrderFromItsFields) {
  MixEditor editor;
  int changes = 0;
  QObject::connect(&editor, &MixEditor::changed, [&] { ++changes; });
  for (int i = 0; i < 2; ++i) child<QPushButton>(editor, "planAddKind")->click();
  auto* kinds = child<QTableWidget>(editor, "planKinds");
  ASSERT_EQ(kinds->rowCount(), 2);
  kinds->item(0, 0)->setText("plain");
  kinds->item(1, 0)->setText("heavy");
  kinds->item(0, 1)->setText("7");
  kinds->item(1, 2)->setCheckState(Qt::Checked);
  kinds->item(1, 3)->setCheckState(Qt::Checked);
  kinds->item(1, 4)->setText("\"object.masses_kg[0]\": 2, \"task.duration_s\": 1.5");
  child<QComboBox>(editor, "planTargets")->setCurrentIndex(1);
  child<QSpinBox>(editor, "planRingCount")->setValue(4);
  child<QComboBox>(editor, "planOrder")->setCurrentIndex(1);
  child<QCheckBox>(editor, "planWayBack")->setChecked(true);
  EXPECT_GT(changes, 8);
  EXPECT_TRUE(editor.faults().isEmpty()) << editor.faults().join("; ").toStdString();
  const session::TrialMix& mix = editor.mix();
  ASSERT_EQ(mix.kinds.size(), 2u);
  EXPECT_EQ(mix.kinds[1].name, "heavy");
  ASSERT_EQ(mix.kinds[1].changes.size(), 2u);
  EXPECT_EQ(mix.kinds[1].changes[1].path, "task.duration_s");
  EXPECT_EQ(session::cycleOf(mix)[0].count, 7);
  EXPECT_EQ(mix.notFirst, std::vector<std::string>{"heavy"});
  EXPECT_EQ(mix.notTwice, std::vector<std::string>{"heavy"});
  ASSERT_TRUE(mix.ring);
  EXPECT_EQ(mix.ring->count, 4);
  EXPECT_EQ(mix.order, session::TrialOrder::ShuffledCycles);
  EXPECT_TRUE(mix.wayBack);
  EXPECT_TRUE(session::problems(mix, 16, "").empty());
}

TEST(MixEditor, ShowsAMixAndKeepsWhatIsNotEdited) {
  session::TrialMix mix;
  mix.kinds = {{"a", {{"object.masses_kg[0]", "2"}}}, {"b", {}}};
  mix.cycle = {{"a", 2}, {"b", 1}, {"a", 1}};  // a stands twice, which the table cannot show
  mix.targets = {{0.1, 0, 0}, {0, 0, -0.1}};
  MixEditor editor;
  editor.show(mix);
  auto* kinds = child<QTableWidget>(editor, "planKinds");
  EXPECT_EQ(kinds->item(0, 1)->text(), "3");
  EXPECT_EQ(kinds->item(0, 4)->text(), "\"object.masses_kg[0]\": 2");
  EXPECT_EQ(child<QLineEdit>(editor, "planTargetList")->text(), "[0.1, 0, 0], [0, 0, -0.1]");
  child<QComboBox>(editor, "planOrder")->setCurrentIndex(2);
  ASSERT_EQ(editor.mix().cycle.size(), 3u);
  EXPECT_EQ(editor.mix().cycle[2].kind, "a");
  EXPECT_EQ(editor.mix().targets, mix.targets);
  kinds->item(0, 0)->setText("c");
  EXPECT_EQ(editor.mix().cycle[2].kind, "c") << "a kind takes its place in the mix along with its new name";
}

TEST(MixEditor, NamesATextThatCannotBeRead) {
  MixEditor editor;
  child<QPushButton>(editor, "planAddKind")->click();
  auto* kinds = child<QTableWidget>(editor, "planKinds");
  kinds->item(0, 4)->setText("object.masses_kg: 2");
  EXPECT_FALSE(editor.faults().isEmpty());
  kinds->item(0, 4)->setText("\"object.masses_kg\": [2]");
  EXPECT_TRUE(editor.faults().isEmpty()) << editor.faults().join("; ").toStdString();
  kinds->item(0, 1)->setText("many");
  EXPECT_EQ(editor.faults().size(), 1);
  kinds->item(0, 1)->setText("1");
  child<QComboBox>(editor, "planTargets")->setCurrentIndex(2);
  EXPECT_EQ(editor.faults().size(), 1) << "no place yet";
}

}  // namespace
}  // namespace reachlab::gui::plan
