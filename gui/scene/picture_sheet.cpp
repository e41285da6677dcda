#include "gui/scene/picture_sheet.h"

#include <QCoreApplication>
#include <QDir>
#include <QImage>
#include <QPainter>

#include "base/error.h"
#include "constraints/constraint.h"
#include "gui/scene/scene_view.h"
#include "gui/scene_plan/definition_reach.h"
#include "gui/widgets/theme.h"
#include "sim/experiment/compiled_experiment.h"
#include "sim/experiment/resources.h"

namespace reachlab::gui::scene {
namespace {

constexpr int kWidth = 480, kHeight = 360, kAcross = 4, kDown = 3;

void save(const QImage& image, const QString& file) {
  if (!image.save(file)) throw ResourceError(file.toStdString() + " could not be written. Choose another folder, or free disk space");
}

}  // namespace

int drawPictures(const QString& folder) {
  for (const QString& part : {folder, folder + QStringLiteral("/experiments")})
    if (!QDir().mkpath(part)) throw ResourceError(part.toStdString() + ": the folder could not be made. Choose another folder");
  SceneView view;
  OverlayState overlay;
  overlay.semaphoreShown = false;
  view.resize(kWidth, kHeight);
  view.show();
  QCoreApplication::processEvents();
  const auto picture = [&](const std::string& name, const ScenePlan& plan) {
    overlay.counter = QString::fromStdString(name);
    view.overlay().setState(overlay);
    view.setPlan(plan);
    QCoreApplication::processEvents();
    return view.grabScene();
  };
  QImage sheet;
  int drawn = 0, sheets = 0;
  const auto closeSheet = [&] {
    if (!sheet.isNull()) save(sheet, QStringLiteral("%1/sheet-%2.png").arg(folder).arg(++sheets));
    sheet = {};
  };
  for (const constraints::Definition& definition : constraints::catalogue()) {
    const QImage image = picture(definition.name, planScene(reachOn(definition), constraints::makeConstraint(definition)));
    save(image, QStringLiteral("%1/%2.png").arg(folder, QString::fromStdString(definition.name)));
    if (sheet.isNull()) {
      sheet = QImage(kAcross * kWidth, kDown * kHeight, QImage::Format_RGB32);
      sheet.fill(widgets::toQColor(widgets::colours::kBase));
    }
    const int place = drawn % (kAcross * kDown);
    QPainter(&sheet).drawImage(QRect((place % kAcross) * kWidth, (place / kAcross) * kHeight, kWidth, kHeight), image);
    if (++drawn % (kAcross * kDown) == 0) closeSheet();
  }
  closeSheet();
  for (const auto& names : {experiment::shippedExperiments(), experiment::shippedForTwoHands()})
    for (const std::string& name : names) {
      const experiment::CompiledExperiment shipped(experiment::readExperiment(*experiment::shippedExperimentFile(name)));
      save(picture(name, planScene(shipped.experiment(), shipped.constraint())),
           QStringLiteral("%1/experiments/%2.png").arg(folder, QString::fromStdString(name)));
      ++drawn;
    }
  return drawn;
}

}  // namespace reachlab::gui::scene
