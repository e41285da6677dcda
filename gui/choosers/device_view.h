#pragma once
#include <QWidget>

#include "devices/live_device.h"

class QPainter;

namespace reachlab::gui::docks {

/// Live view of a device: its handle from the front and from above, its force, and the times between its reports.
class DeviceView : public QWidget {
 public:
  explicit DeviceView(QWidget* parent = nullptr);
  /// `reach`: shown range about the origin [m]. `force`: force of a full arrow [N].
  void display(const devices::LiveDevice::View& view, double reach, double force);
  void clear();
  QSize sizeHint() const override { return {660, 220}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void drawPlace(QPainter& painter, const QRectF& frame, const QString& title, double right, double up, double forceRight,
                 double forceUp) const;
  void drawIntervals(QPainter& painter, const QRectF& frame) const;

  devices::LiveDevice::View view_{};
  double reach_ = 0.1, force_ = 1;
  bool live_ = false;
};

}  // namespace reachlab::gui::docks
