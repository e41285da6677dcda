#pragma once
#include <QString>
#include <QStringList>

#include "sim/experiment/compiled_experiment.h"

/// Files of experiments as the window handles them: written whole or not at all, remembered, and begun from templates.
namespace reachlab::gui::app {

/// Throws ResourceError. A file that was there before is then unchanged.
void writeExperiment(const experiment::Experiment& experiment, const QString& file);

/// Whether the path is a log or a folder, which is inspected and not run.
bool isRecorded(const QString& file);

/// At most eight files, the newest first. Files that no longer exist are left out.
QStringList recentFiles();
void rememberFile(const QString& file);

/// A sound beginning of each kind of experiment.
struct Template {
  const char* title;  // "Chain on a line"
  const char* shipped;
};
inline constexpr Template kTemplates[] = {{"Chain of masses on a line", "chain-moderate"},
                                          {"Chain of masses on a curve", "chain-on-ellipse"},
                                          {"Masses side by side", "parallel"},
                                          {"One mass on a curve", "ellipse"},
                                          {"One mass on a surface", "torus"},
                                          {"One mass in free space", "free-point"},
                                          {"A body in free space", "free-body"}};
/// A new experiment from that template, with a new name. Throws FaultError.
experiment::CompiledExperiment newExperiment(const Template& from);

/// The first page of the manual: the installed site, the built site, or its source. Empty if there is no manual.
QString manualPage();

}  // namespace reachlab::gui::app
