#pragma once
#include <QWidget>

#include "gui/scene/scene_view.h"

namespace reachlab::gui::subject {

/// What the subject sees: the scene and a few words, over a whole screen. The experimenter's keys work here too: the main window gives its
/// actions.
class SubjectWindow : public QWidget {
  Q_OBJECT
 public:
  explicit SubjectWindow(QWidget* parent = nullptr);
  /// On the second screen if there is one, else on this.
  void showFull();
  scene::SceneView& view() { return *view_; }

 Q_SIGNALS:
  void closed();

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  scene::SceneView* view_;
};

}  // namespace reachlab::gui::subject
