#pragma once
#include <QFont>
#include <QString>
#include <QWidget>
#include <array>
#include <optional>

#include "sim/trial/outcome.h"

namespace reachlab::gui::scene {

/// The rest between two blocks, shown large in the middle of the scene.
struct RestState {
  QString title, instructions;
  int secondsLeft = 0;  // 0: the next block may begin
  int blocksDone = 0, blocks = 0;
  bool operator==(const RestState&) const = default;
};

/// Texts and semaphore over the scene.
struct OverlayState {
  trial::Semaphore semaphore = trial::Semaphore::Neutral;
  bool semaphoreShown = true;
  bool rulersShown = true;  // axes, scale, how many masses stand at one place
  QString counter;          // "Trial 3 of 20"
  QString instruction;      // what the subject is to do
  QString detail;           // how the last trial ended
  QString task;             // what the trials ask for; over several lines, and only before the first
  int below = 6;            // pixels under `task` that stay free
  QString legend;           // of the drawn forces, a line each
  enum class Tone { Plain, Good, Bad } tone = Tone::Plain;
  std::optional<RestState> rest;
  bool operator==(const OverlayState&) const = default;
};

/// Semaphore, trial counter, instruction, scale and axes over the scene. The pointer acts on the scene below.
class SceneOverlay : public QWidget {
  Q_OBJECT
 public:
  explicit SceneOverlay(QWidget* parent);
  void setState(const OverlayState& state);
  const OverlayState& state() const { return state_; }
  /// Screen directions of x, y, z (length at most 1, y down) and metres a pixel in the plane through the scene's centre.
  void setView(const std::array<QPointF, 3>& axes, double metresPerPixel);
  void setTextScale(double scale);
  static constexpr double kFootHeight = 60;  // pixels at the bottom that three lines of the legend take
  /// Pixels at the top that the texts take: the scene is put below them.
  double headHeight() const { return state_.semaphoreShown ? 96 * textScale_ : 0; }
  /// "5 masses" beside masses that are drawn over one another. Empty if all masses are visible.
  void setLabel(const QString& text, const QPointF& at);
  const QString& label() const { return label_; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void paintScale(QPainter& painter) const;
  void paintAxes(QPainter& painter) const;
  void paintLabel(QPainter& painter) const;
  void paintRest(QPainter& painter, const RestState& rest) const;

  OverlayState state_;
  std::array<QPointF, 3> axes_{QPointF{1, 0}, QPointF{0, -1}, QPointF{0, 0}};
  double metresPerPixel_ = 0;
  double textScale_ = 1;
  QString label_;
  QPointF labelAt_;
};

/// The largest font size [pt], at most `most`, at which the text, in as many lines as it needs, is no larger than `room` [px].
double pointsToFit(const QString& text, QFont font, double most, const QSizeF& room);

/// A round length (1, 2 or 5 times a power of ten) not above `most`. [same unit]
double roundLength(double most);

}  // namespace reachlab::gui::scene
