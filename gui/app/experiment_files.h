#pragma once
#include <QString>
#include <QStringList>

#include "sim/experiment/compiled_experiment.h"

/// Files of experiments as the window handles them: written whole or not at all, remembered, and begun from templates.
namespace reachlab::gui::app {

/// Throws ResourceError; what was there before is then as it was.
void writeExperiment(const experiment::Experiment& experiment, const QString& file);

/// A log, or a folder: what is looked at, not reached with.
bool isRecorded(const QString& file);

/// The newest first, at most eight; those that are gone are left out.
QStringList recentFiles();
void rememberFile(const QString& file);

/// A sound beginning of each kind of experiment.
struct Template {
  const char* title;  // "Chain on a line"
  const char* shipped;
};
const std::vector<Template>& templates();
/// Of that template, under a name of its own. Throws FaultError.
experiment::CompiledExperiment newExperiment(const Template& from);

/// Where the manual begins: the installed site, the one that was built, or its source. Empty: none is there.
QString manualPage();

}  // namespace reachlab::gui::app
