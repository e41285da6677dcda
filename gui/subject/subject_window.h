#pragma once
#include <QWidget>

class QScreen;

#include "gui/scene/scene_view.h"

namespace reachlab::gui::subject {

/// The subject's screen: the scene and a few words in full screen. The experimenter's keys also work here, because the main window passes
/// its actions on.
class SubjectWindow : public QWidget {
  Q_OBJECT
 public:
  explicit SubjectWindow(QWidget* parent = nullptr);
  /// Fills the screen of that name. Otherwise it fills the screen that was used last, or else the second screen. The choice is remembered
  /// (QSettings).
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

/// "HDMI-1, 1920 × 1080": the menu's name of a screen. The first word is the screen's name.
QString titleOf(const QScreen& screen);
/// The screen that showFull takes without a name.
QString rememberedScreen();

}  // namespace reachlab::gui::subject
