// Ctrl-C, a polite kill and a terminal that goes end the window within a second, at any stage, with what was recorded in order.
#include <signal.h>

#include <QThread>

#include "base/system/stop_signals.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/run_log.h"
#include "sim/session/session_folder.h"
#include "tests/gui/at_the_window.h"

namespace reachlab::gui::app {
namespace {

// The program as main() starts it. The test below starts it as a separate process, so ctest does not run it. REACHLAB_TEST_STAGE is Resting,
// Checking, InATrial, Between or Busy. Busy is in a trial, with a window whose thread hangs.
TEST(SignalledWindow, DISABLED_Lives) {
  const QByteArray stage = qgetenv("REACHLAB_TEST_STAGE");
  endOnSignals();
  session::SessionRequest request;
  experiment::Experiment lenient = experiment::readExperiment("chain-slow");
  lenient.timing = experiment::kNoTimingLimits;  // a busy machine would end the trial before the signal comes
  request.what = qgetenv("REACHLAB_TEST_DATA").toStdString() + "/slow.json";
  std::ofstream(request.what) << experiment::toJson(lenient);
  request.device = "simulated";
  request.trials = 3;
  request.seed = 1;
  request.place.data = qgetenv("REACHLAB_TEST_DATA").toStdString();
  request.timingCheckSeconds = stage == "Checking" ? 3600 : 0;
  MainWindow window(request);
  window.show();
  const auto reached = [&] {
    session::RecordedRun* run = window.session().run();
    if (stage == "Resting") return true;
    if (run == nullptr) return false;
    if (stage == "Checking") return run->underWay();
    return run->latest().phase == (stage == "Between" ? trial::Phase::Done : trial::Phase::Moving);
  };
  if (stage != "Resting") window.nextTrial();
  if (!QTest::qWaitFor(reached, 60000)) std::_Exit(99);
  std::puts("reached");
  std::fflush(stdout);
  while (stage == "Busy") QThread::sleep(1);
  std::_Exit(QApplication::exec());
}

class WindowSignals : public ::testing::TestWithParam<std::tuple<std::string, int>> {};

TEST_P(WindowSignals, EndItWithTheTrialMarkedAndTheLogClosed) {
  const auto& [stage, signal] = GetParam();
  const QTemporaryDir folder;
  QProcess program;
  startAgain(program, "SignalledWindow.*", {{"REACHLAB_TEST_DATA", folder.path()}, {"REACHLAB_TEST_STAGE", QString::fromStdString(stage)}});
  QByteArray out;
  while (!out.contains("reached")) {
    ASSERT_TRUE(program.waitForReadyRead(120000)) << out.toStdString() << program.readAllStandardError().toStdString();
    out += program.readAllStandardOutput();
  }
  ::kill(static_cast<pid_t>(program.processId()), signal);
  ASSERT_TRUE(program.waitForFinished(20000)) << "stuck";  // a busy machine may take longer than the second; being stuck is the fault
  EXPECT_EQ(program.exitStatus(), QProcess::NormalExit);
  EXPECT_EQ(program.exitCode(), 128 + signal);
  const std::vector<session::RunOnDisk> runs = session::recordedRuns({folder.path().toStdString()});
  if (stage == "Resting") {
    EXPECT_TRUE(runs.empty());
    return;
  }
  ASSERT_EQ(runs.size(), 1u);
  const record::RunLog log = record::RunLog::open(runs[0].path);
  EXPECT_TRUE(log.closed());
  EXPECT_TRUE(log.healthy());
  ASSERT_EQ(log.trials().size(), stage == "Checking" ? 0u : 1u);
  for (const record::RecordedTrial& trial : log.trials()) EXPECT_TRUE(trial.complete);
  if (stage == "InATrial" || stage == "Busy") {
    EXPECT_EQ(log.trials()[0].result.outcome, trial::Outcome::Interrupted);
  }
}

INSTANTIATE_TEST_SUITE_P(AtAnyStage, WindowSignals,
                         ::testing::Values(std::tuple{"Resting", SIGINT}, std::tuple{"Checking", SIGTERM}, std::tuple{"InATrial", SIGINT},
                                           std::tuple{"InATrial", SIGHUP}, std::tuple{"Between", SIGTERM}, std::tuple{"Busy", SIGINT},
                                           std::tuple{"Busy", SIGTERM}, std::tuple{"Busy", SIGHUP}));

}  // namespace
}  // namespace reachlab::gui::app
