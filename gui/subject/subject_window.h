#pragma once
#include <QWidget>

class QScreen;

#include "gui/scene/scene_view.h"

namespace reachlab::gui::subject {

/// What the subject sees: the scene and a few words, over a whole screen. The experimenter's keys work here too: the main window gives its
/// actions.
class SubjectWindow : public QWidget {
  Q_OBJECT
 public:
  explicit SubjectWindow(QWidget* parent = nullptr);
  /// Over the screen of that name; where there is none, over the one that was used last, else over the second if there is one. What is
  /// chosen is remembered (QSettings).
  void showFull(const QString& screen = {});
  scene::SceneView& view() { return *view_; }
  /// The square for a light sensor in the lower left corner: not there, black, or white.
  enum class Patch { None, Black, White };
  void setPatch(Patch patch);
  Patch patch() const { return patch_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  scene::SceneView* view_;
  QWidget* square_;
  Patch patch_ = Patch::None;
};

/// "HDMI-1, 1920 × 1080": as a menu names a screen; the first word is the screen's name.
QString titleOf(const QScreen& screen);
/// The screen that showFull would take without being told one.
QString rememberedScreen();

}  // namespace reachlab::gui::subject
