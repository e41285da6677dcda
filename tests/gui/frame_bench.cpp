// Processor time of a picture of every shipped scene while a trial moves, the scene 1200 x 900 and both plots open below it: what one core could
// draw. Then what an idle window costs, and how soon the first picture is there.
//   tests/gui/under_xvfb build/dev/tests/gui/frame_bench [EXPERIMENT…]   prints a table for docs/benchmarks/drawing-speed.md
#include <QApplication>
#include <QElapsedTimer>
#include <QHBoxLayout>
#include <QTest>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <vector>

#include "gui/plot/signal_plot.h"
#include "gui/plot/velocity_plot.h"
#include "gui/scene/software_canvas.h"
#include "gui/scene/scene_view.h"
#include "gui/widgets/theme.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"

namespace {

using namespace reachlab;

double processorSeconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);  // of every thread: the drawing library has its own
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Bench {
  QWidget page;
  gui::scene::SceneView* view = new gui::scene::SceneView;
  gui::plot::VelocityPlot* velocity = new gui::plot::VelocityPlot;
  gui::plot::SignalPlot* signal = new gui::plot::SignalPlot;

  Bench() {
    auto* all = new QVBoxLayout(&page);
    auto* plots = new QHBoxLayout;
    view->setFixedSize(1200, 900);
    all->setContentsMargins(0, 0, 0, 0);
    all->addWidget(view);
    plots->addWidget(velocity);
    plots->addWidget(signal);
    all->addLayout(plots);
    page.resize(1200, 1160);
  }

  // Median over pictures of a reach, hand ahead of the masses. [s]
  double measure(double duration) {
    std::vector<double> seconds;
    gui::scene::SceneFrame frame = view->frame();
    const Vec3 start = view->plan().start, way = view->plan().target - start;
    velocity->setTask(duration, 0.5);
    velocity->beginTrial();
    signal->clear();
    constexpr int kPictures = 48, kFirst = 16;  // the first ones are for the program to learn how fast it draws
    for (int i = 1; i <= kPictures; ++i) {
      const double share = static_cast<double>(i) / kPictures, time = share * duration;
      ownHand(frame) = start + share * way;
      for (std::size_t k = 0; k < frame.masses.size(); ++k) frame.masses[k] = start + (share / (1.5 + static_cast<double>(k))) * way;
      const double before = processorSeconds();
      view->showFrame(frame);
      for (int point = 0; point < 6; ++point) {  // 200 a second, 30 pictures
        const double at = time + 0.005 * point, speed = std::sin(std::numbers::pi * at / duration);
        velocity->add(at, speed, 0.9 * speed);
        signal->add({at, {at, 0, 0}, {speed, 0, 0}, speed, 1, 0});
      }
      velocity->refresh();
      signal->refresh();
      QCoreApplication::processEvents();  // and put on the screen
      if (i > kFirst) seconds.push_back(processorSeconds() - before);
    }
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2), seconds.end());
    return seconds[seconds.size() / 2];
  }

  double idle() {
    QTest::qWait(1500);
    const double before = processorSeconds();
    QElapsedTimer clock;
    clock.start();
    QTest::qWait(4000);
    return (processorSeconds() - before) / (1e-3 * static_cast<double>(clock.elapsed()));
  }
};

}  // namespace

int main(int argc, char** argv) {
  QElapsedTimer sinceStart;
  sinceStart.start();
  gui::scene::applySurfaceFormat();
  QApplication application(argc, argv);
  gui::widgets::applyTheme(application);
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = experiment::shippedExperiments();
  Bench bench;
  double first = 0;
  bench.page.show();
  if (!QTest::qWaitForWindowExposed(&bench.page)) return 1;
  std::printf("| scene | processor time a picture [ms] | pictures/s of one core |\n|---|---|---|\n");
  for (const std::string& name : names) {
    const experiment::CompiledExperiment compiled = experiment::openExperiment(name);
    bench.view->setPlan(gui::scene::planScene(compiled.experiment(), compiled.constraint()));
    bench.view->draw();
    QCoreApplication::processEvents();
    if (first == 0) first = 1e-3 * static_cast<double>(sinceStart.elapsed());
    const double seconds = bench.measure(compiled.experiment().task ? compiled.experiment().task->duration : 1);
    std::printf("| %s | %.0f | %.0f |\n", name.c_str(), 1e3 * seconds, 1 / seconds);
    std::fflush(stdout);
  }
  std::printf("\nIdle: %.1f %% of a core. First picture after %.2f s. Drawn by %s\n", 100 * bench.idle(), first,
              gui::scene::rendererName().toUtf8().constData());
  return 0;
}
