#include "analysis/study/columns.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "analysis/study/run_study.h"
#include "analysis/study/trial_row.h"
#include "sim/record/log/trial_measures.h"

namespace reachlab::study {
namespace {

std::vector<std::string> namesOf(const Design& design) {
  std::vector<std::string> names;
  for (const Column& column : columnsOf(design)) names.push_back(column.name);
  return names;
}
Design asking(std::vector<std::string> measures) {
  Design design;
  design.measures = std::move(measures);
  return design;
}

TEST(StudyColumns, OfFamiliesAreOneForEachCriterion) {
  Design design = asking({"epsilon", "score"});
  design.criteria = {"min-hand-jerk", "min-crackle"};
  EXPECT_EQ(namesOf(design),
            (std::vector<std::string>{"point", "subject", "trial", "seed", "outcome", "reason", "epsilon_hand_min_hand_jerk_m_per_s",
                                      "epsilon_hand_min_crackle_m_per_s", "epsilon_object_min_hand_jerk_m_per_s",
                                      "epsilon_object_min_crackle_m_per_s", "score_min_hand_jerk", "score_min_crackle", "score_reference",
                                      "fit_effective_samples", "fit_own_score"}));
  design.criteria.clear();
  EXPECT_EQ(criteriaOf(design).size(), 7u) << "all, where none is named";
  EXPECT_EQ(columnsOf(design).size(), 6u + 14 + 7 + 3);
}

TEST(StudyColumns, AskForNoMoreThanTheirMeasuresNeed) {
  const auto needs = [](const Design& design) {
    const Needs n = needsOf(design);
    return std::vector<bool>{n.samples, n.errors, n.fits};
  };
  using Bits = std::vector<bool>;
  EXPECT_EQ(needs(asking({})), (Bits{false, false, false}));
  EXPECT_EQ(needs(asking({"by", "peak_hand_speed_m_per_s"})), (Bits{false, false, false}));
  EXPECT_EQ(needs(asking({"by", "sparc"})), (Bits{true, false, false}));
  EXPECT_EQ(needs(asking({"epsilon"})), (Bits{true, true, false}));
  EXPECT_EQ(needs(asking({"score"})), (Bits{true, false, true}));
  Design profiled = asking({"by"});
  profiled.profiles = true;
  EXPECT_EQ(needs(profiled), (Bits{true, false, false}));
}

// Both tables hold three quantities that are the same by either way. Every other name is of one table alone.
TEST(StudyColumns, OfOneNameAreOneQuantity) {
  std::vector<std::string_view> shared;
  for (const analysis::Measure& measure : analysis::measures())
    for (const record::TickMeasure& tick : record::tickMeasures())
      if (measure.name == tick.name) shared.push_back(tick.name);
  EXPECT_EQ(shared, (std::vector<std::string_view>{"movement_time_s", "peak_force_n", "mean_force_n"}));
}

TEST(StudyColumns, RefuseMeasuresThatThereAreNoneOfOrTwice) {
  EXPECT_TRUE(measureProblems(asking({"by", "score", "epsilon"})).empty());
  for (const std::string& usual : usualMeasures()) EXPECT_TRUE(measureProblems(asking({usual})).empty()) << usual;
  const std::vector<Fault> twice = measureProblems(asking({"by", "mass", "by"}));
  ASSERT_EQ(twice.size(), 1u);
  EXPECT_EQ(twice[0].key, "measures[2]");
  EXPECT_EQ(twice[0].what, "\"by\" stands here twice");
  Design named = asking({"epsilon"});
  named.criteria = {"min-hand-jerk", "min-hand-jerk"};
  EXPECT_EQ(measureProblems(named).size(), 1u) << "two columns of one name";
  Design unknown = asking({"by", "bye"});
  unknown.criteria = {"min-hand-jerk", "min-jerk"};
  const std::vector<Fault> faults = measureProblems(unknown);
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].key, "measures[1]");
  EXPECT_EQ(faults[1].key, "criteria[1]");
}

TEST(StudyColumns, AreAllExplained) {
  Design design;
  design.measures = measureNames();
  design.axes = {{"handmass_kg", {"1"}, {}}, {"trials", {"3"}, {}}};
  const auto dictionary = nlohmann::json::parse(dictionaryOf(design));
  for (const std::string& name : namesOf(design)) EXPECT_NE(dictionary.at(name).at("Description"), "") << name;
  EXPECT_EQ(dictionary.at("handmass_kg").at("Description"), "Varied by the study");
  EXPECT_FALSE(dictionary.at("by").contains("Units")) << "its unit hangs on the reason";
  EXPECT_FALSE(dictionary.at("subject").contains("Format"));
  EXPECT_FALSE(dictionary.at("score_min_crackle").contains("Units"));
  EXPECT_EQ(dictionary.at("onset_s").at("Units"), "s");
}

TEST(StudyProgress, TellsTheRateOfNowAndTheTimeThatIsLeft) {
  StudyProgress p;
  EXPECT_TRUE(p.rate() == 0 && p.secondsLeft() == 0 && p.trials == 0 && p.trialsDone == 0 && p.trialsNow == 0);
  p.trials = 1000, p.trialsDone = 400, p.trialsNow = 100, p.seconds = 5;
  EXPECT_DOUBLE_EQ(p.rate(), 20);
  EXPECT_DOUBLE_EQ(p.secondsLeft(), 30);
}

}  // namespace
}  // namespace reachlab::study
