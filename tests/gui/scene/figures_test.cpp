// The scenes of the paper's Figs. 2, 3 and 7 as they were when a person last looked at them and found them right.
//   REACHLAB_KEEP_PICTURES=tests/gui/scene/figures tests/gui/under_xvfb build/dev/tests/gui/test_gui --gtest_filter='Figures*'
// writes them anew: look at them before they are kept.
#include <gtest/gtest.h>

#include <QDir>

#include "sim/experiment/compiled_experiment.h"
#include "test_paths.h"
#include "tests/gui/eyes.h"
#include "tests/gui/scene/shown_scene.h"

namespace reachlab::gui::scene {
namespace {

// [0, 255]; means over cells of 8 x 8 pixels, so that edges smoothed by another driver are the same picture.
constexpr double kMean = 1.5, kWorstCell = 40;

struct Difference {
  double mean = 0, worst = 0;
  bool beyond() const { return mean > kMean || worst > kWorstCell; }
};

Difference differenceOf(const QImage& a, const QImage& b) {
  const QSize cells(a.width() / 8, a.height() / 8);
  const auto small = [&](const QImage& i) {
    return i.scaled(cells, Qt::IgnoreAspectRatio, Qt::SmoothTransformation).convertToFormat(QImage::Format_RGB32);
  };
  const QImage p = small(a), q = small(b);
  Difference d;
  for (int y = 0; y < cells.height(); ++y)
    for (int x = 0; x < cells.width(); ++x) {
      const QRgb u = p.pixel(x, y), v = q.pixel(x, y);
      const double here = (std::abs(qRed(u) - qRed(v)) + std::abs(qGreen(u) - qGreen(v)) + std::abs(qBlue(u) - qBlue(v))) / 3.0;
      d.mean += here / (cells.width() * cells.height());
      d.worst = std::max(d.worst, here);
    }
  return d;
}

class Figures : public ShownScene {
 protected:
  Figures() : ShownScene(480, 360) {}
  // In the middle of a reach: each mass a little behind the one before it.
  void show(const std::string& shipped, double share) {
    const experiment::CompiledExperiment compiled = experiment::openExperiment(shipped);
    show(planScene(compiled.experiment(), compiled.constraint()), share);
  }
  void show(const ScenePlan& plan, double share) {
    view_.setPlan(plan);
    SceneFrame frame = view_.frame();
    const Vec3 way = plan.target - plan.start;
    ownHand(frame) = plan.start + share * way;
    const double step = frame.masses.size() > 1 ? 0.35 / static_cast<double>(frame.masses.size() - 1) : 0;
    for (std::size_t i = 0; i < frame.masses.size(); ++i)
      frame.masses[i] = plan.start + std::max(0.0, share - 0.04 - step * static_cast<double>(i)) * way;
    view_.showFrame(frame);
  }
  QImage kept(const std::string& name) {
    const QString folder = QStringLiteral(REACHLAB_SOURCE_DIR "/tests/gui/scene/figures/");
    QImage image(folder + QString::fromStdString(name) + QStringLiteral(".png"));
    EXPECT_FALSE(image.isNull()) << folder.toStdString() << name;
    return image.convertToFormat(QImage::Format_RGB32);
  }
  void compare(const std::string& name) {
    if (const QByteArray anew = qgetenv("REACHLAB_KEEP_PICTURES"); !anew.isEmpty()) {
      QDir().mkpath(QString::fromLocal8Bit(anew));
      EXPECT_TRUE(picture().save(QString::fromLocal8Bit(anew) + QLatin1Char('/') + QString::fromStdString(name) + QStringLiteral(".png")));
    }
    const Difference d = differenceOf(picture(), kept(name));
    EXPECT_FALSE(d.beyond()) << name << ": mean " << d.mean << ", worst cell " << d.worst;
    if (d.beyond()) picture().save(QDir::tempPath() + QStringLiteral("/reachlab-") + QString::fromStdString(name) + QStringLiteral(".png"));
  }
};

TEST_F(Figures, Fig2Constraints) {
  for (const char* name : {"epitrochoid", "monkey-saddle", "plane", "torus"}) {
    show(name, 0);
    compare(std::string("fig2-") + name);
  }
}

TEST_F(Figures, Fig3FlexibleObject) {
  show("chain-moderate", 0.6);
  compare("fig3-chain");
}

TEST_F(Figures, Fig7ParallelObject) {
  show("parallel", 0.6);
  compare("fig7-parallel");
}

TEST_F(Figures, WhatIsMissingOrAsideIsSeen) {
  const experiment::CompiledExperiment compiled = experiment::openExperiment("chain-moderate");
  const ScenePlan plan = planScene(compiled.experiment(), compiled.constraint());
  const QImage good = kept("fig3-chain");
  ScenePlan changed = plan;
  changed.targetShown = false;
  show(changed, 0.6);
  EXPECT_TRUE(differenceOf(picture(), good).beyond()) << "no target";
  changed = plan;
  changed.springs.clear();
  show(changed, 0.6);
  EXPECT_TRUE(differenceOf(picture(), good).beyond()) << "no springs";
  show(plan, 0.5);
  EXPECT_TRUE(differenceOf(picture(), good).beyond()) << "a tenth of the reach aside";
}

// On the picture itself, lit and shaded as it is.
TEST_F(Figures, MassesAreToldFromTheGroundAndFromOneAnotherByEveryEye) {
  show("chain-moderate", 0.6);
  const QImage image = picture();
  const auto light = [&](const Vec3& at) {
    const QPointF p = view_.pixelOf(at);
    return lightOf(QColor(image.pixel(static_cast<int>(p.x()), static_cast<int>(p.y()))));
  };
  const SceneFrame frame = view_.frame();
  const Light first = light(frame.masses.front() - 0.4 * view_.plan().massRadius.front() * Vec3{1, 0, 0}),
              last = light(frame.masses.back());
  const Light ground = lightOf(QColor(image.pixel(240, 20)));
  for (const auto eye : kEyes) {
    EXPECT_GE(contrast(eye(first), eye(ground)), 3);
    EXPECT_GE(contrast(eye(last), eye(ground)), 3);
    EXPECT_GE(apart(eye(first), eye(last)), 40) << "blue and orange";
  }
}

}  // namespace
}  // namespace reachlab::gui::scene
