#include "gui/inspector/dataset_analysis.h"

#include <gtest/gtest.h>

#include <QDir>
#include <QFileInfo>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include "test_paths.h"
#include "tests/analysis/recorded.h"
#include "tests/gui/words.h"
#include "tests/temporary_folder.h"

namespace reachlab::gui::inspector {
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
  analysis.begin(QDir::current().relativeFilePath(data));
  ASSERT_TRUE(reported.wait(kPatienceMs)) << lastOf(said).toStdString();
  EXPECT_TRUE(QFileInfo::exists(lastOf(reported)));
  EXPECT_TRUE(QFileInfo(lastOf(reported)).isAbsolute()) << "for a browser";
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
  EXPECT_TRUE(holds(lastOf(said), "failed: "));
  EXPECT_EQ(reported.count(), 0);

  DatasetAnalysis none("/no/such/reach");
  QSignalSpy noneSaid(&none, &DatasetAnalysis::said);
  none.begin(empty.path());
  if (noneSaid.isEmpty()) noneSaid.wait(kPatienceMs);
  EXPECT_TRUE(holds(lastOf(noneSaid), "/no/such/reach"));
}

TEST(DatasetAnalysis, SaysHowFarItIsAndCanBeCancelled) {
  const TemporaryFolder folder;
  DatasetAnalysis analysis(QString::fromStdString(
      folder.writeProgram("slow", "echo 'reading run 2 of 2' >&2\necho 'fitting trial 3 of 9' >&2\nexec sleep 600")));
  QSignalSpy progressed(&analysis, &DatasetAnalysis::progressed), idle(&analysis, &DatasetAnalysis::idle),
      told(&analysis, &DatasetAnalysis::told), said(&analysis, &DatasetAnalysis::said);
  analysis.begin(QString::fromStdString(folder.path()));
  const QVariantList third{"fitting trial", 3, 9};
  ASSERT_TRUE(QTest::qWaitFor([&] { return !progressed.isEmpty() && progressed.last() == third; }, kPatienceMs));
  analysis.cancel();
  ASSERT_TRUE(idle.wait(kPatienceMs));
  EXPECT_TRUE(holds(lastOf(told), "cancelled"));
  EXPECT_EQ(said.count(), 0) << "it was wanted";
  EXPECT_FALSE(analysis.busy());
}

}  // namespace
}  // namespace reachlab::gui::inspector
