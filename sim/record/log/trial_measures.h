#pragma once
#include <span>
#include <string_view>

#include "sim/record/log/run_log.h"

namespace reachlab::record {

/// A trial's moments in seconds since the run's first sample, as every export counts. NaN: never came.
struct TrialTimes {
  double start = 0, armed = 0, go = 0, onset = 0, end = 0;
};
TrialTimes timesOf(const RecordedTrial& trial, std::uint64_t firstSampleTick);

/// A measure that the haptic ticks of a trial give. Exports, their dictionaries, `reach show`, studies and the inspector follow this table.
/// Measures of the analysis from filtered samples are in analysis/measures/measures.h, under other names.
struct TickMeasure {
  std::string_view name;      // with its unit, as in every table
  std::string_view sentence;  // of every dictionary
  double (*of)(const RecordedTrial& trial);
  bool count = false;       // a whole number
  bool ofComputer = false;  // of the computer that recorded and not of the movement
};
std::span<const TickMeasure> tickMeasures();
/// The measure of that name. A name that is in no table is a mistake in the program and throws FaultError.
const TickMeasure& tickMeasure(std::string_view name);

}  // namespace reachlab::record
