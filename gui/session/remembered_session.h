#pragma once
#include <QString>
#include <optional>

#include "sim/record/configuration/run_configuration.h"
#include "sim/session/session.h"

/// The session that the window remembers in QSettings. Each value is written when it changes, so that a kill loses nothing.
namespace reachlab::gui::app {

/// Remembers subject, session, folder, device and, except for a plan, the number of trials. The folder stays the same wherever the program
/// is started.
void rememberRequest(const session::SessionRequest& request);
/// The values of the last start. `request` gives the values that were never remembered.
session::SessionRequest rememberedRequest(session::SessionRequest request);
std::optional<int> rememberedTrials();

/// Remembers the open run, until `forgetOpenRun`. `request.what` is the plan or the experiment that was opened.
void rememberOpenRun(const record::RunConfiguration& run, const session::SessionRequest& request);
void forgetOpenRun();

/// A run that was open when the program was killed, with everything that resumes it.
struct InterruptedRun {
  session::Programme programme;
  session::SessionRequest request;  // resumes the session with the same person, device and number of trials
  QString seed;
  int run = 0;
  int trial = 0, trials = 0;  // the next trial of the block, and the trials of the block
};
/// Reads the interrupted run from the settings and its logs. nullopt if there is no such run, if nothing is left of it, or if another
/// program is still recording it. Throws children of Error if the run cannot be resumed.
std::optional<InterruptedRun> findInterruptedRun();

}  // namespace reachlab::gui::app
