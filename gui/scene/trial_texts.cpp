#include "gui/scene/trial_texts.h"

#include "sim/experiment/experiment.h"

namespace reachlab::gui::scene {
namespace {

QString number(double value, int digits) { return QString::number(value, 'f', digits); }

// "mass 5 is " before what it misses. A result names no mass where the hand or its cursor is judged.
QString massIs(int mass, const char* verb) {
  return mass > 0 ? QStringLiteral("mass %1 %2 ").arg(mass).arg(QLatin1String(verb)) : QString();
}

struct Words {
  QString brief, sentence;  // for the tally, and for the subject
};

Words wordsOf(const trial::TrialResult& result) {
  const QString thousandths = number(1000 * result.by, 1);
  switch (result.reason) {
    case trial::Reason::TimeShort: return {"too fast", QStringLiteral("Too fast by %1 s").arg(number(result.by, 2))};
    case trial::Reason::Position:
      return {"too far from the target",
              QStringLiteral("Time is up: %1%2 mm too far from the target").arg(massIs(result.mass, "is"), thousandths)};
    case trial::Reason::Velocity:
      return {"still moving", QStringLiteral("Time is up: %1%2 mm/s too fast").arg(massIs(result.mass, "still moves"), thousandths)};
    case trial::Reason::Via: return {"missed a via point", QStringLiteral("Time is up: a via point was missed by %1 mm").arg(thousandths)};
    case trial::Reason::ForceLimit: return {"over the force limit", "The force exceeded its limit"};
    case trial::Reason::DeviceLost: return {"device lost", "The device was lost"};
    case trial::Reason::NoOnset: return {"no movement", "No movement began"};
    case trial::Reason::Experimenter: return {"stopped by the experimenter", "Stopped by the experimenter"};
    case trial::Reason::EndOfConstraint: return {"off the end of the path", "The object ran off the end of its path"};
    case trial::Reason::Computation: return {"not computable", "The simulation could not continue"};
    case trial::Reason::Program: return {"interrupted", "Interrupted"};
    case trial::Reason::Early: return {"too early", "Too early: wait for the signal"};
    case trial::Reason::Timing: return {"computer too busy", "The computer was too busy: this trial does not count"};
    case trial::Reason::NoStart: return {"hand never at the start", "The hand was never at the start"};
    case trial::Reason::PeerLost: return {"other station silent", "Another station fell silent"};
    case trial::Reason::None: break;
  }
  const bool success = result.outcome == trial::Outcome::Success;
  return {"no reason", success ? QStringLiteral("Well done: %1 s").arg(number(result.movementTime, 2)) : QString()};
}

}  // namespace

QString outcomeText(const trial::TrialResult& result) { return wordsOf(result).sentence; }

QString reasonText(trial::Reason reason) {
  trial::TrialResult result;
  result.reason = reason;
  return wordsOf(result).brief;
}

OverlayState overlayOf(const haptics::TickState& state, const experiment::Task& task, int trialsPlanned, bool mouse, int trialsBefore) {
  OverlayState o;
  o.semaphore = state.semaphore;
  o.counter = state.trial > 0      ? QStringLiteral("Trial %1 of %2").arg(trialsBefore + state.trial).arg(trialsBefore + trialsPlanned)
              : trialsPlanned == 1 ? QStringLiteral("1 trial")
                                   : QStringLiteral("%1 trials").arg(trialsPlanned);
  const double latest = task.duration + task.tolerance.time;
  o.detail = task.duration > task.tolerance.time
                 ? QStringLiteral("reach in %1 ± %2 s").arg(number(task.duration, 2), number(task.tolerance.time, 2))
                 : QStringLiteral("reach in at most %1 s").arg(number(latest, 2));
  switch (state.phase) {
    case trial::Phase::Idle: o.instruction = QStringLiteral("Wait"); break;
    case trial::Phase::Waiting:
      o.instruction = mouse ? QStringLiteral("Drag the hand to the grey sphere and rest there")
                            : QStringLiteral("Move the hand to the grey sphere and rest there");
      break;
    case trial::Phase::Armed: o.instruction = QStringLiteral("Move to the small yellow sphere, and stop there"); break;
    case trial::Phase::Moving: o.instruction = QStringLiteral("%1 s").arg(number(state.trialTime, 2)); break;
    case trial::Phase::Done:
      o.instruction = outcomeText(state.result);
      o.detail = QStringLiteral("Space: next trial");
      break;
  }
  showWhetherItCounts(state, o);
  return o;
}

void showWhetherItCounts(const haptics::TickState& state, OverlayState& overlay) {
  if (state.phase != trial::Phase::Done) return;
  if (state.result.outcome == trial::Outcome::Success) overlay.tone = OverlayState::Tone::Good;
  else if (state.result.outcome == trial::Outcome::Failure) overlay.tone = OverlayState::Tone::Bad;
  else overlay.semaphore = trial::Semaphore::Neutral;
}

QString taskText(const experiment::Experiment& experiment, bool hiding) {
  if (!experiment.task) return {};
  const experiment::Task& task = *experiment.task;
  const auto digits = [](double value) { return QString::number(value, 'g', 4); };
  const std::size_t masses = experiment.object.masses.size();
  const bool bare = experiment.object.kind == experiment::ObjectKind::None,
             byCursor = experiment.cursor && experiment.cursor->judge == experiment::CursorJudge::Cursor;
  const QString what = bare && byCursor                                         ? QStringLiteral("the cursor")
                       : bare                                                   ? QStringLiteral("your hand")
                       : experiment.object.kind == experiment::ObjectKind::Body ? QStringLiteral("the body")
                       : masses == 1                                            ? QStringLiteral("the mass")
                       : masses == 2                                            ? QStringLiteral("both masses")
                                                                                : QStringLiteral("all %1 masses").arg(masses);
  const double earliest = task.duration - task.tolerance.time, latest = task.duration + task.tolerance.time;
  const QString when = earliest > 0 ? QStringLiteral("%1 to %2 s").arg(digits(earliest), digits(latest))
                                    : QStringLiteral("at most %1 s").arg(digits(latest));
  QString text = QStringLiteral(
                     "Bring %1 to the small yellow sphere (within %2 mm) and to rest there (below %3 mm/s), %4 after your hand "
                     "starts to move.")
                     .arg(what, digits(1000 * task.tolerance.position), digits(1000 * task.tolerance.velocity), when);
  if (task.via.size() == 1) text += QStringLiteral(" Pass the ball on the way.");
  if (task.via.size() > 1) text += QStringLiteral(" Pass the %1 balls on the way in their order, the clearest next.").arg(task.via.size());
  if (hiding) text += QStringLiteral("\nMasses can hide one another: F puts them side by side, right drag turns the view, Home fits it.");
  return text;
}

QString forcesText(const ForceMarks& forces) {
  const auto digits = [](double value) { return QString::number(value, 'g', 3); };
  QStringList lines;
  if (!forces.field.empty())
    lines << (forces.speed > 0 ? QStringLiteral("Arrows: force at %1 m/s to the target, up to %2 N")
                                     .arg(digits(forces.speed), digits(longestOf(forces.field)))
                               : QStringLiteral("Arrows: force, up to %1 N").arg(digits(longestOf(forces.field))));
  if (!forces.pulses.empty()) lines << QStringLiteral("Large arrow: pulse of %1 N").arg(digits(longestOf(forces.pulses)));
  if (!forces.channel.quads.empty())
    lines << QStringLiteral("Walls of %1 N/m, which let go at the dashes (%2 mm)")
                 .arg(QString::number(forces.stiffness), digits(1000 * forces.letGoDistance));
  return lines.join(QLatin1Char('\n'));
}

OverlayState restingOverlay(const QString& experiment, bool mouse) {
  OverlayState o;
  o.counter = experiment;
  o.instruction = QStringLiteral("Press Space to begin");
  o.detail = mouse ? QStringLiteral("then drag with the left button to reach") : QString();
  return o;
}

}  // namespace reachlab::gui::scene
