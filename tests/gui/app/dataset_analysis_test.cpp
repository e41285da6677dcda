#include "gui/app/dataset_analysis.h"

#include <gtest/gtest.h>

#include <QFileInfo>
#include <QSignalSpy>
#include <QTemporaryDir>

#include "test_paths.h"
#include "tests/analysis/recorded.h"

namespace reachlab::gui::app {
namespace {

const QString kReach = QStringLiteral(REACH_PROGRAM);
constexpr int kPatienceMs = 120'000;

QString lastOf(const QSignalSpy& spy) { return spy.isEmpty() ? QString() : spy.last().front().toString(); }

TEST(DatasetAnalysis, WritesTheReportAndSaysWhereItIs) {
  const QTemporaryDir folder;
  const QString data = folder.filePath("data");
  analysis::recordRun(data.toStdString(), {.experiment = "dingwell", .trials = 2});
  DatasetAnalysis analysis(kReach);
  QSignalSpy reported(&analysis, &DatasetAnalysis::reported), told(&analysis, &DatasetAnalysis::told),
      said(&analysis, &DatasetAnalysis::said);
  analysis.begin(data);
  ASSERT_TRUE(reported.wait(kPatienceMs)) << lastOf(said).toStdString();
  EXPECT_TRUE(QFileInfo::exists(lastOf(reported)));
  EXPECT_NE(lastOf(told).indexOf(lastOf(reported)), -1);
  EXPECT_EQ(said.count(), 0) << "a success is no alarm";
}

TEST(DatasetAnalysis, SaysWhyThereIsNone) {
  const QTemporaryDir empty;
  DatasetAnalysis analysis(kReach);
  QSignalSpy said(&analysis, &DatasetAnalysis::said), told(&analysis, &DatasetAnalysis::told),
      reported(&analysis, &DatasetAnalysis::reported);
  analysis.begin(empty.path());
  ASSERT_EQ(told.count(), 1) << "that it has begun";
  ASSERT_TRUE(said.wait(kPatienceMs));
  EXPECT_TRUE(lastOf(said).contains("failed: ")) << lastOf(said).toStdString();
  EXPECT_EQ(reported.count(), 0);

  DatasetAnalysis none("/no/such/reach");
  QSignalSpy noneSaid(&none, &DatasetAnalysis::said);
  none.begin(empty.path());
  if (noneSaid.isEmpty()) noneSaid.wait(kPatienceMs);
  EXPECT_TRUE(lastOf(noneSaid).contains("/no/such/reach")) << lastOf(noneSaid).toStdString();
}

}  // namespace
}  // namespace reachlab::gui::app
