#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "analysis/study/design.h"
#include "sim/experiment/patch.h"
#include "sim/session/plan.h"

namespace reachlab::study {

/// One combination of values of the varied keys.
struct Point {
  std::int64_t index = 0;
  std::vector<experiment::Patch> ofAxes;  // parallel to Design::axes
};

/// One experiment of a point, patched, as a recorded run would receive it.
struct PointExperiment {
  std::string name, text;
  std::string definition;  // of its constraint; empty: a shipped one, or none
};

/// The task that all subjects of a point perform.
struct PointTask {
  std::string device;                        // "simulated:…"
  session::Plan plan;                        // of an experiment: one block, in every session
  std::vector<PointExperiment> experiments;  // one for each of plan.blocks
  std::vector<int> days;                     // sessions in order; of a plan without days, and of an experiment: 0
};

std::int64_t pointCount(const Design& design);
std::int64_t pairCount(const Design& design);  // points times subjects
Point pointAt(const Design& design, std::int64_t index);
/// Throws FaultError under "point N: KEY".
PointTask taskOf(const Design& design, const Point& point);
/// Throws the error that is being handled again, with the point's number and values if it is a fault or a refusal.
[[noreturn]] void rethrowAt(const Point& point);
/// A text in JSON without its quotes. Any other value as it is.
std::string unquoted(const std::string& json);
/// "coupling.stiffness_n_per_m=300, subject.noise=1". Empty if nothing is varied.
std::string describe(const Point& point);
/// The most that any point asks of a subject. Of a plan with varied keys, that of the first thousand points.
std::int64_t mostTrialsOfSubject(const Design& design);
/// The trials of pairs of point and subject (point * subjects + subject - 1), from the first to before the last. `most`
/// is that of mostTrialsOfSubject.
std::int64_t trialsOfPairs(const Design& design, std::int64_t most, std::int64_t first, std::int64_t end);

/// Seed of a subject's session: Philox of the study's name and seed by point, subject and day. It has 53 bits, so that every reader of a
/// table keeps it exact.
std::uint64_t seedOf(const Design& design, std::int64_t point, std::int64_t subject, int day);
/// Label of a subject: its number from 1, two digits or more, as a plan's order takes it.
std::string labelOfSubject(std::int64_t subject);

}  // namespace reachlab::study
