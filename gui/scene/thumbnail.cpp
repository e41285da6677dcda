#include "gui/scene/thumbnail.h"

#include <QPainter>
#include <algorithm>
#include <functional>
#include <utility>

#include "gui/scene/camera.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::scene {
namespace {

using Projector = std::function<QPointF(const Vec3&)>;

void drawLines(QPainter& painter, const Projector& at, const std::vector<std::vector<Vec3>>& pieces) {
  for (const auto& piece : pieces) {
    QPolygonF line;
    for (const Vec3& p : piece) line << at(p);
    painter.drawPolyline(line);
  }
}

// Quads from far to near, shaded by how they face the viewer.
void drawSkin(QPainter& painter, const Projector& at, const Vec3& forward, const SurfaceMesh& mesh) {
  std::vector<std::pair<double, std::size_t>> faces;  // by their depth
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    Vec3 middle;
    for (const auto corner : mesh.quads[i]) middle += mesh.points[corner];
    faces.emplace_back(dot(middle, forward), i);
  }
  std::sort(faces.rbegin(), faces.rend());
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(Qt::NoPen);
  for (const auto& [depth, index] : faces) {
    const auto& quad = mesh.quads[index];
    QPolygonF shape;
    for (const auto corner : quad) shape << at(mesh.points[corner]);
    const double facing = std::abs(dot(mesh.normals[quad[0]], forward)), light = 0.45 + 0.55 * facing;
    const QColor ink = QColor::fromRgbF(widgets::colours::kSurface.red * light, widgets::colours::kSurface.green * light,
                                        widgets::colours::kSurface.blue * light);
    painter.setBrush(widgets::withAlpha(ink, 150));
    painter.drawConvexPolygon(shape);
  }
  painter.setRenderHint(QPainter::Antialiasing);
}

}  // namespace

QImage drawThumbnail(const ScenePlan& plan, const QSize& size, double pixelRatio) {
  QImage image((QSizeF(size) * pixelRatio).toSize(), QImage::Format_ARGB32_Premultiplied);
  image.setDevicePixelRatio(pixelRatio);
  image.fill(widgets::toQColor(widgets::colours::kBase));
  QPainter painter(&image);
  painter.setRenderHint(QPainter::Antialiasing);
  const double width = size.width(), height = size.height();
  const Camera camera = lookAtPoints(plan.seen, 0.06 * plan.size, plan.viewFrom, width / height);
  const Projector at = [&](const Vec3& p) {
    const auto [x, y] = pixelOf(camera, p, width, height);
    return QPointF(x, y);
  };
  if (!plan.surface.quads.empty()) {
    drawSkin(painter, at, axesOf(camera).forward, plan.surface);
    painter.setPen(QPen(widgets::withAlpha(widgets::toQColor(widgets::colours::kSurfaceLine), 70), 0.6));
    drawLines(painter, at, plan.surface.parameterLines);
  }
  painter.setPen(QPen(widgets::toQColor(widgets::colours::kRail), 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  drawLines(painter, at, plan.curve.pieces);
  if (plan.hasTask) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(widgets::toQColor(widgets::colours::kStart).lighter(125));
    painter.drawEllipse(at(plan.start), 2.6, 2.6);
    painter.setBrush(widgets::toQColor(widgets::colours::kTarget));
    painter.drawEllipse(at(plan.target), 2.6, 2.6);
  }
  return image;
}

}  // namespace reachlab::gui::scene
