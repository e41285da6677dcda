#pragma once
#include <QString>

class QWidget;

namespace reachlab::gui::app {

/// Questions before data would be lost. Each waits for the answer. Closing the box means "no".
bool askToEndRun(QWidget& window, const QString& doing, std::size_t trialsDone, std::size_t trialsPlanned);

enum class Unsaved { Save, Discard, Cancel };
Unsaved askAboutUnsaved(QWidget& window, const QString& experiment);

}  // namespace reachlab::gui::app
