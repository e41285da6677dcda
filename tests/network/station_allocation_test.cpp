#include <gtest/gtest.h>

#include "cli/bench/allocation_count.h"
#include "constraints/constraint.h"
#include "network/link/station_replay.h"
#include "network/link/station_sink.h"
#include "sim/experiment/experiment.h"
#include "sim/experiment/resources.h"
#include "sim/haptics/haptic_loop.h"
#include "sim/record/log/recorder.h"
#include "tests/haptics/scripted_device.h"
#include "tests/record/made_run.h"

namespace reachlab::network {
namespace {

/// To the link, then to the log: as a recorded run has it.
class BothSinks final : public haptics::RunSink {
 public:
  BothSinks(haptics::RunSink& link, haptics::RunSink& log) : link_(link), log_(log) {}
  bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missed) noexcept override {
    link_.onTick(state, command, missed);
    return log_.onTick(state, command, missed);
  }

 private:
  haptics::RunSink &link_, &log_;
};

/// What a station's haptic thread asks for in a trial of which the other's samples come, fail to come for 90 ms, and come twice.
struct Asked {
  std::uint64_t allocations = 0, taken = 0, steps = 0;
  std::int32_t trial = 0;
};
Asked askedByAStation(const std::string& name) {
  experiment::Experiment e = experiment::readExperiment(name);
  e.task->rest = experiment::kNoStartRest;
  const experiment::CompiledExperiment experiment{e};
  const auto memory = std::make_unique<LinkMemory>();
  CoupledCopy* copy = nullptr;
  auto engine = makeStationEngine(experiment, 0, {{{.maxForce = 12, .virtualHand = true}}}, copy);
  StationSink link(*memory, *copy, 0);
  const Vec3 start = engine->protocol().start;
  const auto device = std::make_shared<haptics::test::ScriptedDevice>(start.x, start.x + 0.05, 1000);
  device->beside = start;

  const TemporaryFolder folder;
  record::RunConfiguration c = record::madeConfiguration();
  c.experimentText = e.text;
  c.sampleEveryTicks = 1;
  experiment::Experiment recorded = e;
  recorded.hands.clear();
  c.table = record::makeChannelTable(recorded, experiment.constraint().parameterCount());
  for (const record::Channel& channel : linkChannels(1, 2)) c.table.channels.push_back(channel);
  record::Recorder log(folder / "log.reach", c, {.further = &link});
  BothSinks sink(link, log);

  haptics::HapticLoop loop(std::move(engine), device, &sink, {.virtualClock = true, .clock = {}});
  Asked asked;
  OwnState sent;
  HeardState heard;
  for (int i = 0; i < 3000; ++i) {
    if (i == 1) loop.tryCommand(trial::Command::NextTrial);
    if (i == 2) link.synchroniseBy(2);
    const std::uint64_t before = cli::countAllocations();
    loop.advance();
    asked.allocations += cli::countAllocations() - before;
    loop.takeLatest();
    while (memory->out.tryPop(sent)) {
      heard.trial = sent.trial, heard.phase = sent.phase, heard.roundTrip = 0.02, heard.sample = sent.sample;
      heard.sample.time = 1e-9 * static_cast<double>(sent.timeNs);
    }
    if (i > 1500 && i < 1590) continue;
    (void)memory->in[1].tryPush(heard);
    if (i % 3 == 0) (void)memory->in[1].tryPush(heard);
  }
  asked.taken = copy->link(0).taken;
  asked.steps = loop.engine().state().faults.steps[0];
  asked.trial = loop.engine().state().trial;
  EXPECT_EQ(copy->link(0).frequency, copy->link(0).lost ? 0 : 2) << "the rate that was asked for holds";
  return asked;
}

TEST(StationTick, AllocatesNothing) {
  for (const std::string& name : experiment::shippedForTwoHands()) {
    const Asked asked = askedByAStation(name);
    EXPECT_EQ(asked.allocations, 0u) << name;
    EXPECT_EQ(asked.trial, 1) << name;
    EXPECT_GT(asked.steps, 1000u) << name << ": steps were taken";
    EXPECT_GT(asked.taken, 1000u) << name << ": samples were taken";
  }
}

}  // namespace
}  // namespace reachlab::network
