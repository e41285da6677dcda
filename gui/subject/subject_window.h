#pragma once
#include <QWidget>

class QScreen;

#include "gui/scene/scene_view.h"

namespace reachlab::gui::subject {

inline constexpr int kPatchSide = 90;  // pixels of the square that a light sensor covers

/// The subject's screen: the scene and a few words in full screen. The experimenter's keys also work here, because the main window passes
/// its actions on. It leaves full screen while its monitor is unplugged.
class SubjectWindow : public QWidget {
  Q_OBJECT
 public:
  /// `experimenters`: the experimenter's window or a part of it, which outlives this window. Its screen is not covered without a choice.
  explicit SubjectWindow(const QWidget& experimenters);
  /// Fills the screen of that name, or without a name the `rememberedScreen`. The choice is remembered (QSettings).
  void showFull(const QString& screen = {});
  scene::SceneView& view() { return *view_; }
  /// The square for a light sensor in the lower left corner: not there, black, or white.
  enum class Patch { None, Black, White };
  void setPatch(Patch patch);
  Patch patch() const { return patch_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void fill(const QString& screen);
  void followScreens();

  const QWidget& experimenters_;
  QString shownOn_;  // the filled screen; empty: no screen
  scene::SceneView* view_;
  QWidget* square_;
  Patch patch_ = Patch::None;
};

/// "HDMI-1, 1920 × 1080": the menu's name of a screen. The first word is the screen's name.
QString titleOf(const QScreen& screen);
/// The screen for the subject: the `known` screen if it is present, else a screen without the experimenter's window if possible.
QString screenFor(const QString& known, const QStringList& present, const QString& experimenters);
/// The same for the screens of this computer and the remembered choice. `experimenters`: the experimenter's window.
QString rememberedScreen(const QWidget& experimenters);

}  // namespace reachlab::gui::subject
