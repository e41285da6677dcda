// A day at the window: hours of trials of a simulated hand, on the virtual clock, and what the program's memory does.
//   tests/gui/under_xvfb build/dev/tests/gui/day_memory [HOURS [MOST_MB]]   exits 1 when more than MOST_MB come to the first hour's
#include <QApplication>
#include <QTemporaryDir>
#include <QTest>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

#include "base/ticks.h"
#include "gui/app/main_window.h"
#include "gui/scene/scene_view.h"
#include "gui/widgets/theme.h"

namespace {

using namespace reachlab;

double residentMegabytes() {
  long pages = 0, resident = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr || std::fscanf(file, "%ld %ld", &pages, &resident) != 2) std::abort();
  std::fclose(file);
  return 1e-6 * static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

}  // namespace

int main(int argc, char** argv) {
  const double hours = argc > 1 ? std::atof(argv[1]) : 8, most = argc > 2 ? std::atof(argv[2]) : 20;
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
  request.trials = 200;
  request.place.data = folder.filePath(QStringLiteral("data")).toStdString();
  gui::app::MainWindow window(request);
  window.show();
  if (!QTest::qWaitForWindowExposed(&window)) return 1;
  double seconds = 0, firstHour = 0, largest = 0;
  int trials = 0, told = 0;
  while (seconds < 3600 * hours) {
    window.nextTrial();
    if (window.session().run() == nullptr) return std::fprintf(stderr, "day_memory: %s\n", window.message().toUtf8().constData()), 1;
    if (!QTest::qWaitFor([&] { return !window.session().underWay(); }, 600'000))
      return std::fprintf(stderr, "day_memory: a trial does not end\n"), 1;
    ++trials;
    if (window.session().run()->trialsLeft() > 0) continue;
    seconds += secondsOf(window.session().run()->latest().tick);
    window.endRun();
    const double now = residentMegabytes();
    if (seconds >= 3600 && firstHour == 0) firstHour = now;
    largest = std::max(largest, now);
    if (seconds < 3600 * (told + 1)) continue;
    told = static_cast<int>(seconds / 3600);
    std::printf("%d h: %d trials, %.1f MB\n", told, trials, now);
    std::fflush(stdout);
  }
  std::printf("%.1f MB more than after the first hour\n", largest - firstHour);
  return largest - firstHour > most ? 1 : 0;
}
