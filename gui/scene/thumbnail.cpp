#include "gui/scene/thumbnail.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "gui/scene/camera.h"
#include "gui/widgets/theme.h"

namespace reachlab::gui::scene {
namespace {

struct Projector {
  Camera camera;
  double width, height;
  QPointF operator()(const Vec3& p) const {
    const auto [x, y] = pixelOf(camera, p, width, height);
    return {x, y};
  }
};

void drawLine(QPainter& painter, const Projector& at, const std::vector<Vec3>& points) {
  QPolygonF line;
  for (const Vec3& p : points) line << at(p);
  painter.drawPolyline(line);
}

// Quads from far to near, shaded by how they face the viewer.
void drawSkin(QPainter& painter, const Projector& at, const SurfaceMesh& mesh) {
  const CameraAxes axes = axesOf(at.camera);
  struct Face {
    double depth;
    std::size_t index;
  };
  std::vector<Face> faces;
  for (std::size_t i = 0; i < mesh.quads.size(); ++i) {
    Vec3 middle;
    for (const auto corner : mesh.quads[i]) middle += mesh.points[corner];
    faces.push_back({dot(0.25 * middle - at.camera.position, axes.forward), i});
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.depth > b.depth; });
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setPen(Qt::NoPen);
  for (const Face& face : faces) {
    const auto& quad = mesh.quads[face.index];
    QPolygonF shape;
    for (const auto corner : quad) shape << at(mesh.points[corner]);
    const double facing = std::abs(dot(mesh.normals[quad[0]], axes.forward)), light = 0.45 + 0.55 * facing;
    QColor ink = QColor::fromRgbF(widgets::colours::kSurface.red * light, widgets::colours::kSurface.green * light,
                                  widgets::colours::kSurface.blue * light);
    ink.setAlpha(150);
    painter.setBrush(ink);
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
  const Projector at{lookAtPoints(plan.seen, 0.06 * plan.size, plan.viewFrom, width / height), width, height};
  if (!plan.surface.quads.empty()) {
    drawSkin(painter, at, plan.surface);
    QColor line = widgets::toQColor(widgets::colours::kSurfaceLine);
    line.setAlpha(70);
    painter.setPen(QPen(line, 0.6));
    for (const auto& piece : plan.surface.parameterLines) drawLine(painter, at, piece);
  }
  painter.setPen(QPen(widgets::toQColor(widgets::colours::kRail), 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  for (const auto& piece : plan.curve.pieces) drawLine(painter, at, piece);
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
