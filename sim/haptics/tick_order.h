#pragma once
#include "sim/haptics/tick_engine.h"

namespace reachlab::haptics {

/// Stages of a tick for an engine whose samples and commands are in the input already, and whose forces nobody gets.
struct NoStages {
  bool read(TickInput&) noexcept { return true; }
  void watch(TickInput&) noexcept {}
  void command(TickInput&) noexcept {}
  bool write(const TickInput&) noexcept { return true; }
  void publish(const TickInput&) noexcept {}
};

/// The order of one tick. The loop of a run, a study's block, the check before a block and a replay go through it.
///   read      the devices' samples into the input; false ends the tick here
///   watch     makes invalid what cannot be believed
///   command   takes the order of the controlling thread
///   step      estimates the hands, steps the object, judges the trial
///   limit     turns the coupling's force into what each device may get
///   write     gives the devices their forces and the hands their cue; false ends the tick here
///   publish   tells recorder and window
/// `stages` has the members of NoStages. Returns false when the tick ended early. Throws only exceptions of a stage.
template <class Stages = NoStages>
bool runTick(TickEngine& engine, TickInput& input, Stages&& stages = {}) {
  if (!stages.read(input)) return false;
  stages.watch(input);
  stages.command(input);
  engine.step(input);
  engine.limit(input);
  if (!stages.write(input)) return false;
  stages.publish(input);
  return true;
}

}  // namespace reachlab::haptics
