#pragma once
#include <QString>

class QWidget;

namespace reachlab::gui::app {

/// Questions before data would be lost. Each waits for the answer. Closing the box means "no".
bool askToEndRun(QWidget& window, const QString& doing, std::size_t trialsDone, std::size_t trialsPlanned, const QString& folder);

/// Asks whether a session is resumed with a device that it was not recorded with.
bool askAboutDevice(QWidget& window, const QString& before, const QString& now);

enum class Unsaved { Save, Discard, Cancel };
Unsaved askAboutUnsaved(QWidget& window, const QString& experiment);

}  // namespace reachlab::gui::app
