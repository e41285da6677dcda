#include "gui/scene/picture_sheet.h"

#include <QCoreApplication>
#include <QDir>
#include <QImage>
#include <QPainter>

#include "base/error.h"
#include "constraints/catalogue/definition.h"
#include "constraints/constraint.h"
#include "gui/scene/scene_view.h"
#include "gui/widgets/theme.h"
#include "sim/experiment/experiment.h"

namespace reachlab::gui::scene {
namespace {

constexpr int kWidth = 480, kHeight = 360, kAcross = 4, kDown = 3;

ScenePlan planOf(const constraints::Definition& definition) {
  experiment::Experiment e;
  e.object.kind = experiment::ObjectKind::Point;
  e.object.masses = {1};
  e.coupling = experiment::Coupling{600, 0};
  e.task = experiment::Task{};
  e.task->start = definition.start;
  e.task->target = definition.target;
  return planScene(e, constraints::makeConstraint(definition));
}

void save(const QImage& image, const QString& file) {
  if (!image.save(file)) throw ResourceError(file.toStdString() + " could not be written. Choose another folder, or free disk space");
}

}  // namespace

int drawPictures(const QString& folder) {
  if (!QDir().mkpath(folder)) throw ResourceError(folder.toStdString() + ": the folder could not be made. Choose another folder");
  SceneView view;
  OverlayState overlay;
  overlay.semaphoreShown = false;
  view.resize(kWidth, kHeight);
  view.show();
  QCoreApplication::processEvents();
  QImage sheet;
  int drawn = 0, sheets = 0;
  const auto closeSheet = [&] {
    if (!sheet.isNull()) save(sheet, QStringLiteral("%1/sheet-%2.png").arg(folder).arg(++sheets));
    sheet = {};
  };
  for (const constraints::Definition& definition : constraints::catalogue()) {
    const QString name = QString::fromStdString(definition.name);
    overlay.counter = name;
    view.setOverlay(overlay);
    view.setPlan(planOf(definition));
    QCoreApplication::processEvents();
    const QImage picture = view.grabScene();
    save(picture, QStringLiteral("%1/%2.png").arg(folder, name));
    if (sheet.isNull()) {
      sheet = QImage(kAcross * kWidth, kDown * kHeight, QImage::Format_RGB32);
      sheet.fill(widgets::toQColor(widgets::colours::kBase));
    }
    const int place = drawn % (kAcross * kDown);
    QPainter(&sheet).drawImage(QRect((place % kAcross) * kWidth, (place / kAcross) * kHeight, kWidth, kHeight), picture);
    if (++drawn % (kAcross * kDown) == 0) closeSheet();
  }
  closeSheet();
  return drawn;
}

}  // namespace reachlab::gui::scene
