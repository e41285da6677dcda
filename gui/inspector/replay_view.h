#pragma once
#include <QElapsedTimer>
#include <QWidget>
#include <vector>

#include "gui/inspector/trial_replay.h"
#include "gui/model/model_reader.h"
#include "gui/widgets/qt_names.h"
#include "sim/experiment/compiled_experiment.h"

namespace reachlab::gui::scene {
class SceneView;
}

namespace reachlab::gui::inspector {

/// A recorded trial in three dimensions with controls of its time: slider, play at 0.1 to 4 times, step by a row, and loop. Other trials at
/// the same time are shown as ghosts.
class ReplayView : public QWidget {
  Q_OBJECT
 public:
  explicit ReplayView(QWidget* parent = nullptr);

  /// `zero`: the replay's time at which the plot's time is 0, which is the onset. [s]
  struct Track {
    TrialReplay replay;
    double zero = 0;
  };
  /// `folder`: folder of a scene file that the experiment names without a folder.
  void show(const experiment::CompiledExperiment& experiment, const QString& folder, Track trial, std::vector<Track> ghosts);
  void clear();
  /// On the plot's time. [s]
  double time() const { return time_; }
  void goTo(double time);
  void setPlaying(bool playing);
  bool playing() const;
  void togglePlaying() { setPlaying(!playing()); }
  /// So many rows on, or back.
  void step(int rows);
  scene::SceneView& view() { return *view_; }
  double speed() const;

 Q_SIGNALS:
  void timeChanged(double time);
  /// Faults of the experiment's scene file.
  void said(const QString& sentence);

 private:
  using QWidget::show;
  double begin() const { return trial_.replay.begin() - trial_.zero; }
  double end() const { return trial_.replay.end() - trial_.zero; }
  void draw();
  void drawModel();
  void tick();

  Track trial_;
  std::vector<Track> ghosts_;
  std::string shownExperiment_;
  model::ModelReader model_;
  double time_ = 0;
  QElapsedTimer clock_;
  QTimer* timer_;
  scene::SceneView* view_;
  QSlider* slider_;
  QToolButton *play_, *back_, *on_;
  QComboBox* speed_;
  QCheckBox *loop_, *ghostsShown_;
  QLabel* told_;
};

}  // namespace reachlab::gui::inspector
