// Processor time of a picture of every shipped scene while a trial moves, 1200 x 900: what one core could draw.
//   tests/gui/under_xvfb build/dev/tests/gui/frame_bench [EXPERIMENT…]   prints a table for docs/window.md
#include <QApplication>
#include <QTest>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "gui/scene/scene_view.h"
#include "gui/widgets/theme.h"
#include "sim/experiment/compiled_experiment.h"

namespace {

using namespace reachlab;

double processorSeconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);  // of every thread: the drawing library has its own
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Median over pictures of a reach, hand ahead of the masses. [s]
double measure(gui::scene::SceneView& view) {
  std::vector<double> seconds;
  gui::scene::SceneFrame frame = view.frame();
  const Vec3 start = view.plan().start, way = view.plan().target - start;
  constexpr int kPictures = 24;
  for (int i = 1; i <= kPictures; ++i) {
    const double share = static_cast<double>(i) / kPictures;
    frame.hand = start + share * way;
    for (std::size_t k = 0; k < frame.masses.size(); ++k) frame.masses[k] = start + (share / (1.5 + static_cast<double>(k))) * way;
    const double before = processorSeconds();
    view.showFrame(frame);
    QCoreApplication::processEvents();  // and put on the screen
    seconds.push_back(processorSeconds() - before);
  }
  std::nth_element(seconds.begin(), seconds.begin() + kPictures / 2, seconds.end());
  return seconds[kPictures / 2];
}

}  // namespace

int main(int argc, char** argv) {
  gui::scene::applySurfaceFormat();
  QApplication application(argc, argv);
  gui::widgets::applyTheme(application);
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = experiment::shippedExperiments();
  gui::scene::SceneView view;
  view.resize(1200, 900);
  view.show();
  if (!QTest::qWaitForWindowExposed(&view)) return 1;
  std::printf("| scene | processor time a picture [ms] | pictures/s of one core |\n|---|---|---|\n");
  for (const std::string& name : names) {
    const experiment::CompiledExperiment compiled = experiment::openExperiment(name);
    view.setPlan(gui::scene::planScene(compiled.experiment(), compiled.constraint()));
    view.renderNow();
    const double seconds = measure(view);
    std::printf("| %s | %.0f | %.0f |\n", name.c_str(), 1e3 * seconds, 1 / seconds);
    std::fflush(stdout);
  }
  std::printf("\nDrawn by %s\n", view.rendererName().toUtf8().constData());
  return 0;
}
