// A day at the window: hours of trials of a simulated hand, on the virtual clock, and what the program's memory does.
//   tests/gui/under_xvfb build/dev/tests/gui/day_memory [HOURS [TRIALS]]
// TRIALS are those of each run. Exits 1 when more than 20 MB come to the first hour's, or when a long run's anonymous memory grows by more
// than 10 kB a trial.
#include <QApplication>
#include <QTemporaryDir>
#include <QTest>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>

#include "base/ticks.h"
#include "gui/app/main_window.h"
#include "gui/scene/scene_view.h"
#include "gui/widgets/theme.h"

namespace {

using namespace reachlab;

constexpr double kMostMegabytes = 20, kMostKilobytes = 10;
constexpr int kLongRun = 500;  // trials: what is taken once, by the first picture or the first fit, counts little

// What this program has of a kind of memory.
double kilobytesOf(const std::string& kind) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(kind)) return 1.024 * std::stod(line.substr(kind.size()));
  std::abort();
}

// The fits after a trial go on beside the window, and give back what they took when they are done.
void awaitRest() {
  const auto processorSeconds = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
  for (double before = processorSeconds(), used = 1; used > 0.25; before += used) {
    QTest::qWait(1000);
    used = processorSeconds() - before;
  }
}

// What no file backs.
double anonymousKilobytes() {
  awaitRest();
  return kilobytesOf("RssAnon:");
}

}  // namespace

int main(int argc, char** argv) {
  const double hours = argc > 1 ? std::atof(argv[1]) : 8;
  const int perRun = argc > 2 ? std::atoi(argv[2]) : 200;
  const QTemporaryDir folder;
  qputenv("XDG_CONFIG_HOME", folder.path().toUtf8());
  gui::scene::applySurfaceFormat();
  QApplication application(argc, argv);
  gui::widgets::applyTheme(application);
  session::SessionRequest request;
  request.what = "chain-moderate";
  request.device = "simulated";
  request.fast = true;
  request.seed = 1;
  request.trials = perRun;
  request.place.data = folder.filePath("data").toStdString();
  gui::app::MainWindow window(request);
  window.show();
  if (!QTest::qWaitForWindowExposed(&window)) return 1;
  double seconds = 0, firstHour = 0, largest = 0;
  double atFirst = 0, perTrial = 0;  // [kB] of the run
  int trials = 0, told = 0, runs = 0;
  while (seconds < 3600 * hours) {
    window.nextTrial();
    if (window.session().run() == nullptr) return std::fprintf(stderr, "day_memory: %s\n", window.message().toUtf8().constData()), 1;
    if (!QTest::qWaitFor([&] { return !window.session().underWay(); }, 600'000))
      return std::fprintf(stderr, "day_memory: a trial does not end\n"), 1;
    if (trials++ % perRun == 0) atFirst = anonymousKilobytes();
    if (window.session().run()->trialsLeft() > 0) continue;
    const double growth = (anonymousKilobytes() - atFirst) / std::max(perRun - 1, 1);
    std::printf("run %d: %d trials, %.1f kB of anonymous memory a trial, from %.1f to %.1f MB\n", ++runs, perRun, growth, 1e-3 * atFirst,
                1e-3 * (atFirst + growth * (perRun - 1)));
    std::fflush(stdout);
    if (perRun >= kLongRun) perTrial = std::max(perTrial, growth);
    seconds += secondsOf(window.session().run()->latest().tick);
    window.endRun();
    const double now = 1e-3 * kilobytesOf("VmRSS:");
    if (seconds >= 3600 && firstHour == 0) firstHour = now;
    largest = std::max(largest, now);
    if (seconds < 3600 * (told + 1)) continue;
    told = static_cast<int>(seconds / 3600);
    std::printf("%d h: %d trials, %.1f MB\n", told, trials, now);
    std::fflush(stdout);
  }
  std::printf("%.1f MB more than after the first hour\n", largest - firstHour);
  return largest - firstHour > kMostMegabytes || perTrial > kMostKilobytes ? 1 : 0;
}
