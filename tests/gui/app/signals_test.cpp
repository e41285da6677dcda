// Ctrl-C, a polite kill and a terminal that goes end the window within a second, at any stage, with what was recorded in order.
#include <gtest/gtest.h>
#include <signal.h>

#include <QApplication>
#include <QProcess>
#include <QTemporaryDir>
#include <QTest>
#include <QThread>
#include <fstream>

#include "base/system/stop_signals.h"
#include "gui/app/main_window.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/run_log.h"
#include "sim/session/session_folder.h"
#include "test_paths.h"

namespace reachlab::gui::app {
namespace {

// Busy: in a trial, and the window's thread comes back from nothing any more
enum class Stage { Resting, Checking, InATrial, Between, Busy };

// The program as main() starts it, in a process of its own: not tests by themselves, run by the one below.
class SignalledWindow : public ::testing::Test {
 protected:
  [[noreturn]] static void live(Stage stage) {
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
    request.timingCheckSeconds = stage == Stage::Checking ? 3600 : 0;
    MainWindow window(request);
    window.show();
    const auto reached = [&] {
      session::RecordedRun* run = window.session().run();
      if (stage == Stage::Resting) return true;
      if (run == nullptr) return false;
      if (stage == Stage::Checking) return run->underWay();
      return run->latest().phase == (stage == Stage::Between ? trial::Phase::Done : trial::Phase::Moving);
    };
    if (stage != Stage::Resting) window.nextTrial();
    if (!QTest::qWaitFor(reached, 60000)) std::_Exit(99);
    std::puts("reached");
    std::fflush(stdout);
    while (stage == Stage::Busy) QThread::sleep(1);
    std::_Exit(QApplication::exec());
  }
};

TEST_F(SignalledWindow, DISABLED_Resting) { live(Stage::Resting); }
TEST_F(SignalledWindow, DISABLED_Checking) { live(Stage::Checking); }
TEST_F(SignalledWindow, DISABLED_InATrial) { live(Stage::InATrial); }
TEST_F(SignalledWindow, DISABLED_Between) { live(Stage::Between); }
TEST_F(SignalledWindow, DISABLED_Busy) { live(Stage::Busy); }

class WindowSignals : public ::testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(WindowSignals, EndItWithTheTrialMarkedAndTheLogClosed) {
  const auto& [stage, signal] = GetParam();
  const QTemporaryDir folder;
  QProcess program;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert(QStringLiteral("REACHLAB_TEST_DATA"), folder.path());
  program.setProcessEnvironment(environment);
  program.start(QCoreApplication::applicationFilePath(),
                {QStringLiteral("--gtest_filter=SignalledWindow.DISABLED_%1").arg(QLatin1String(stage)),
                 QStringLiteral("--gtest_also_run_disabled_tests")});
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
  if (std::string(stage) == "Resting") {
    EXPECT_TRUE(runs.empty());
    return;
  }
  ASSERT_EQ(runs.size(), 1u);
  const record::RunLog log = record::RunLog::open(runs[0].path);
  EXPECT_TRUE(log.closed());
  EXPECT_TRUE(log.healthy());
  ASSERT_EQ(log.trials().size(), std::string(stage) == "Checking" ? 0u : 1u);
  for (const record::RecordedTrial& trial : log.trials()) EXPECT_TRUE(trial.complete);
  if (std::string(stage) == "InATrial" || std::string(stage) == "Busy") {
    EXPECT_EQ(log.trials()[0].result.outcome, trial::Outcome::Interrupted);
  }
}

INSTANTIATE_TEST_SUITE_P(AtAnyStage, WindowSignals,
                         ::testing::Values(std::tuple{"Resting", SIGINT}, std::tuple{"Checking", SIGTERM}, std::tuple{"InATrial", SIGINT},
                                           std::tuple{"InATrial", SIGHUP}, std::tuple{"Between", SIGTERM}, std::tuple{"Busy", SIGINT},
                                           std::tuple{"Busy", SIGTERM}, std::tuple{"Busy", SIGHUP}));

TEST(WindowProgram, RefusesASeedThatWouldBecomeAnother) {
  for (const char* seed : {"-1", "18446744073709551616", "1e3"}) {
    QProcess program;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.remove(QStringLiteral("DISPLAY"));  // with one, and no terminal, the sentence waits in a box
    program.setProcessEnvironment(environment);
    program.start(QStringLiteral(REACHLAB_BINARY_DIR "/gui/reachlab"), {QStringLiteral("--seed"), QString::fromLatin1(seed)});
    ASSERT_TRUE(program.waitForFinished(20000));
    EXPECT_EQ(program.exitCode(), 2) << seed;
    EXPECT_TRUE(program.readAllStandardError().contains("allowed: 0 to 18446744073709551615")) << seed;
  }
}

}  // namespace
}  // namespace reachlab::gui::app
