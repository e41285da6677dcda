#include "gui/session/trial_marking.h"

#include <QInputDialog>
#include <functional>

#include "base/system/error_report.h"
#include "gui/docks/trials_dock.h"
#include "gui/session/session_controller.h"
#include "gui/widgets/messages.h"

namespace reachlab::gui::app {
namespace {

void change(docks::TrialsDock& dock, SessionController& session, widgets::Messages& message, int number,
            const std::function<void(record::TrialMark&)>& how) {
  if (session.run() == nullptr)
    return message.say(widgets::Grade::Attention, QObject::tr("The run is closed. Mark its trials on the page Inspect."));
  try {
    const std::string& log = session.run()->logPath();
    record::RunMarks marks = record::readMarks(log);
    record::TrialMark mark;
    mark.trial = number;
    if (const record::TrialMark* known = marks.find(number)) mark = *known;
    how(mark);
    marks.set(mark);
    record::writeMarks(log, marks);
    dock.setMark(number, mark);
  } catch (const std::exception& e) {
    message.say(widgets::Grade::Error, QString::fromStdString(errorReportOf(e).sentence));
  }
}

}  // namespace

void wireMarking(docks::TrialsDock& dock, SessionController& session, widgets::Messages& message) {
  QObject::connect(&dock, &docks::TrialsDock::flagRequested, &dock, [&dock, &session, &message](int number) {
    change(dock, session, message, number, [](record::TrialMark& mark) { mark.flagged = !mark.flagged; });
  });
  QObject::connect(&dock, &docks::TrialsDock::excludeRequested, &dock, [&dock, &session, &message](int number, const QString& known) {
    bool fine = false;
    const QString reason =
        QInputDialog::getText(&dock, QObject::tr("Exclude trial %1").arg(number),
                              QObject::tr("Reason for the exclusion (empty: the trial counts):"), QLineEdit::Normal, known, &fine);
    if (!fine) return;
    change(dock, session, message, number, [&](record::TrialMark& mark) { mark.excluded = reason.trimmed().toStdString(); });
  });
  QObject::connect(&dock, &docks::TrialsDock::takeBackRequested, &dock, [&session, &message] {
    if (!session.takeBackRepeat()) message.say(widgets::Grade::Attention, QObject::tr("No repeat is planned."));
  });
}

}  // namespace reachlab::gui::app
