#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <thread>
#include <vector>

#include "base/fault.h"
#include "base/math/minimum_jerk.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "network/link/station_replay.h"
#include "network/link/station_sink.h"
#include "network/merge/station_merge.h"
#include "sim/experiment/experiment.h"
#include "sim/haptics/tick_order.h"
#include "sim/record/log/recorder.h"
#include "tests/record/made_run.h"
#include "tests/refusal.h"

// Two whole stations, engine, sink, rings and log, on clocks of the test: the link between them is a function, so what is judged never
// depends on how busy the computer is.
namespace reachlab::network {
namespace {

constexpr double kDuration = 1.35;  // [s]
constexpr std::int64_t kDelayNs = 10'000'000;

/// One station: tick by tick, as the haptic loop has it.
class Station {
 public:
  Station(const experiment::CompiledExperiment& experiment, int own, bool conductor, std::int64_t clockNs, const std::string& path)
      : memory_(std::make_unique<LinkMemory>()), clockNs_(clockNs) {
    const haptics::EngineOptions options{{{.maxForce = 12, .virtualHand = true}}};
    engine_ = makeStationEngine(experiment, own, options, copy_);
    sink_ = std::make_unique<StationSink>(*memory_, *copy_, own);
    record::RunConfiguration c = record::madeConfiguration();
    c.experimentName = "chain-two-hands";
    c.experimentText = experiment.experiment().text;
    c.task = "chaintwohands";
    c.firstHand.maxForce = 12;
    c.firstHand.virtualHand = true;
    c.timing = experiment.experiment().timing;
    c.rest = experiment.experiment().task->rest;
    c.trials = {{1, 0, false}};
    c.sampleEveryTicks = 1;
    c.samplingHz = 1000;
    experiment::Experiment recorded = experiment.experiment();
    recorded.hands.clear();
    c.table = record::makeChannelTable(recorded, 1);
    for (const record::Channel& channel : linkChannels(own + 1, 2)) c.table.channels.push_back(channel);
    recorder_ = std::make_unique<record::Recorder>(path, c, record::RecorderOptions{.threaded = false, .further = sink_.get()});
    recorder_->note("station " + std::to_string(own + 1) + " of 2" + (conductor ? ", conductor" : "") + ", not encrypted");
    const auto& curve = experiment.constraint().curve;
    from_ = evaluate(curve, experiment.experiment().task->start[0]).r;
    to_ = evaluate(curve, experiment.experiment().task->target[0]).r;
  }
  ~Station() { close(); }

  /// One tick at `ns` of the world's time; false once the trial is over.
  bool tick(std::int64_t ns) {
    haptics::TickInput input;
    input.measuredNs = ns + clockNs_;
    if (number_++ == 5) {
      input.command = trial::Command::NextTrial;
      input.planned = {1, 0, false};
      recorder_->announce(1, input.planned);
    }
    if (engine_->state().gone) moved_ += kTickSeconds;
    const double along = heldMinimumJerk(moved_ / kDuration).value;
    input.devices[0].position = from_ + along * (to_ - from_);
    haptics::runTick(*engine_, input);
    const haptics::TickState& state = engine_->state();
    sink_->onTick(state, input.command, 0);
    recorder_->onTick(state, input.command, 0);
    if (const auto given = sink_->takeGiven(); !given.empty()) recorder_->append(record::RecordType::PeerTicks, given);
    return state.phase != trial::Phase::Done;
  }
  void close() {
    if (recorder_) recorder_->close();
    recorder_.reset();
  }
  const haptics::TickState& state() const { return engine_->state(); }
  LinkMemory& memory() { return *memory_; }
  StationSink& sink() { return *sink_; }
  std::int64_t clockNs() const { return clockNs_; }
  const CoupledCopy& copy() const { return *copy_; }

 private:
  std::unique_ptr<LinkMemory> memory_;
  std::int64_t clockNs_;
  CoupledCopy* copy_ = nullptr;
  std::unique_ptr<haptics::TickEngine> engine_;
  std::unique_ptr<StationSink> sink_;
  std::unique_ptr<record::Recorder> recorder_;
  Vec3 from_, to_;
  std::uint64_t number_ = 0;
  double moved_ = 0;  // [s] since the go signal
};

/// What the link does with a sample that is sent at a time: when it comes, once or several times; never where there is none.
using Link = std::function<std::vector<std::int64_t>(std::int64_t sentNs)>;
std::vector<std::int64_t> good(std::int64_t ns) { return {ns + kDelayNs}; }

class StationsOnClocks : public testing::Test {
 protected:
  std::string logOf(int station) const { return folder_ / ("station" + std::to_string(station + 1) + ".reach"); }
  void run(const Link& link, std::int64_t firstStops = -1, const std::function<void(std::int64_t ns)>& meanwhile = {}) {
    stations_.clear();
    for (int i = 0; i < 2; ++i) {
      std::filesystem::remove(logOf(i));
      stations_.push_back(std::make_unique<Station>(experiment_, i, conducts_[static_cast<std::size_t>(i)],
                                                    kClocks[static_cast<std::size_t>(i)], logOf(i)));
    }
    std::array<std::multimap<std::int64_t, OwnState>, 2> under;
    std::array<bool, 2> on{true, true};
    // The second station's ticks lie between the first's.
    for (std::int64_t ns = 1'000'000'000; (on[0] || on[1]) && ns < 9'000'000'000; ns += 500'000) {
      const std::size_t at = ns % 1'000'000 == 0 ? 0 : 1;
      if (meanwhile) meanwhile(ns);
      Station& own = *stations_[at];
      Station& other = *stations_[1 - at];
      if (firstStops >= 0 && at == 0 && ns > firstStops) continue;
      for (auto came = under[at].begin(); came != under[at].end() && came->first <= ns; came = under[at].erase(came)) {
        HeardState heard{came->second.trial, came->second.phase, 2e-9 * kDelayNs, came->second.sample};
        heard.sample.time = 1e-9 * static_cast<double>(came->second.timeNs - other.clockNs() + own.clockNs());
        ASSERT_TRUE(own.memory().in[1 - at].tryPush(heard));
      }
      on[at] = own.tick(ns) && on[at];
      OwnState sent;
      while (own.memory().out.tryPop(sent))
        for (const std::int64_t arrives : link(ns)) under[1 - at].emplace(arrives, sent);
      if (firstStops >= 0 && !on[1]) break;
    }
    for (const auto& station : stations_) station->close();
  }
  trial::TrialResult resultOf(int station) const { return stations_[static_cast<std::size_t>(station)]->state().result; }
  const TowardsOthers& towards(int station) { return stations_[static_cast<std::size_t>(station)]->sink().towardsOthers(); }
  void expectReplays() const {
    for (int i = 0; i < 2; ++i) {
      const record::Replay replay = replayStation(record::RunLog::open(logOf(i)));
      EXPECT_TRUE(replay.identical()) << replay.firstDifference;
      EXPECT_GT(replay.rows, 1000u);
    }
  }
  // Ticks from the last sample that was given before the trial's end.
  std::uint64_t ticksUnheard(int station) const {
    std::uint64_t last = 0;
    const std::uint64_t end = resultOf(station).endTick;
    for (const GivenSample& given : givenSamples(record::RunLog::open(logOf(station))))
      if (given.tick < end) last = given.tick;
    return end - last;
  }
  void expectNoForceAfterTheEnd(int station) const {
    const record::RunLog log = record::RunLog::open(logOf(station));
    const record::SampleRows rows = log.allRows();
    const std::size_t force = log.configuration().table.indexOf("device_force_x");
    double most = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      most = std::max(most, std::abs(rows.at(i, force)));
      if (rows.ticks[i] >= resultOf(station).endTick) {
        ASSERT_EQ(rows.at(i, force), 0) << rows.ticks[i];
      }
    }
    EXPECT_GT(most, 0.01);
    EXPECT_LE(most, 12);
  }

  // Clocks that have nothing to do with each other.
  static constexpr std::array<std::int64_t, 2> kClocks{0, 7'654'321'000'000};
  static constexpr std::int64_t kMoving = 2'200'000'000;  // about the middle of the reach
  static Link cutFor(std::int64_t ns) {
    return [ns](std::int64_t sent) { return sent >= kMoving && sent < kMoving + ns ? std::vector<std::int64_t>{} : good(sent); };
  }
  const TemporaryFolder folder_;
  const experiment::CompiledExperiment experiment_{experiment::readExperiment("chain-two-hands")};
  std::array<bool, 2> conducts_{true, false};
  std::vector<std::unique_ptr<Station>> stations_;
};

TEST_F(StationsOnClocks, TheyMoveTheObjectTogether) {
  run(good);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(resultOf(i).outcome, trial::Outcome::Success) << trial::nameOf(resultOf(i).reason);
    EXPECT_LT(towards(i).mostApart, 1e-3);
    EXPECT_EQ(towards(i).fadedTicks, 0u);
    EXPECT_EQ(towards(i).repeated, 0u);
  }
  expectReplays();
}

TEST_F(StationsOnClocks, ALineCutFor30MillisecondsGoesOn) {
  run(cutFor(30'000'000));
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(resultOf(i).outcome, trial::Outcome::Success) << trial::nameOf(resultOf(i).reason);
    EXPECT_EQ(towards(i).fadedTicks, 0u);
    EXPECT_NEAR(towards(i).oldest, 0.04, 2e-3);
  }
  expectReplays();
}

TEST_F(StationsOnClocks, ALineCutFor90MillisecondsFadesRecoversAndIsMarked) {
  run(cutFor(90'000'000));
  for (int i = 0; i < 2; ++i) {
    EXPECT_NE(resultOf(i).reason, trial::Reason::PeerLost);
    EXPECT_NEAR(static_cast<double>(towards(i).fadedTicks), 40, 2);
    EXPECT_NEAR(towards(i).oldest, 0.1, 2e-3);
    EXPECT_EQ(stations_[static_cast<std::size_t>(i)]->copy().link(0).fade, 1);
  }
  expectReplays();
}

TEST_F(StationsOnClocks, ALineCutFor500MillisecondsEndsTheTrialWithoutForce) {
  run(cutFor(500'000'000));
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(resultOf(i).outcome, trial::Outcome::Interrupted);
    EXPECT_EQ(resultOf(i).reason, trial::Reason::PeerLost);
    EXPECT_GE(ticksUnheard(i), 98u);
    EXPECT_LE(ticksUnheard(i), 102u);
    expectNoForceAfterTheEnd(i);
  }
  expectReplays();
}

TEST_F(StationsOnClocks, AStationThatIsGoneEndsTheOthersTrial) {
  run(good, kMoving);
  EXPECT_EQ(resultOf(1).reason, trial::Reason::PeerLost);
  EXPECT_LE(ticksUnheard(1), 150u);
  expectNoForceAfterTheEnd(1);
  expectReplays();
}

// A station that stood still for a moment has broken its trial off, though it goes on sending: the other hears of it and ends too.
TEST_F(StationsOnClocks, ATrialThatOneBreaksOffIsOverForTheOther) {
  run(good, -1, [&](std::int64_t ns) {
    if (ns == 1'000'000'000) stations_[1]->sink().breakOff(1, 2);  // of another trial
    if (ns == kMoving) stations_[1]->sink().breakOff(1, 1);
  });
  EXPECT_EQ(resultOf(1).outcome, trial::Outcome::Interrupted);
  EXPECT_EQ(resultOf(1).reason, trial::Reason::PeerLost);
  EXPECT_NEAR(static_cast<double>(resultOf(1).endTick), (kMoving - 1'000'000'000) / 1e6, 3);
  expectNoForceAfterTheEnd(1);
  expectReplays();
}

// The same samples as without them are taken, so the recordings are the same but for what was counted.
TEST_F(StationsOnClocks, DuplicatesAndReplaysChangeNothingAndAreCounted) {
  run(good);
  const record::SampleRows plain = record::RunLog::open(logOf(0)).allRows();
  run([](std::int64_t sent) {
    std::vector<std::int64_t> all{sent + kDelayNs, sent + kDelayNs};
    if (sent % 10'000'000 < 1'000'000) all.push_back(sent + kDelayNs + 300'000'000);
    return all;
  });
  EXPECT_GT(towards(0).repeated, 1000u);
  const record::SampleRows again = record::RunLog::open(logOf(0)).allRows();
  ASSERT_EQ(plain.size(), again.size());
  EXPECT_EQ(std::memcmp(plain.values.data(), again.values.data(), plain.values.size() * sizeof(double)), 0);  // NaN is what is not known
  expectReplays();
}

TEST_F(StationsOnClocks, ALogInWhichNobodyWasHeardReplaysToo) {
  run([](std::int64_t) { return std::vector<std::int64_t>{}; });
  EXPECT_EQ(resultOf(0).reason, trial::Reason::PeerLost);
  const record::RunLog log = record::RunLog::open(logOf(0));
  EXPECT_EQ(stationOf(log), 1);
  EXPECT_TRUE(replayStation(log).identical());
}

TEST_F(StationsOnClocks, TheirLogsBecomeOne) {
  run(good);
  record::RunConfiguration asked = record::madeConfiguration();
  asked.run = 3;
  std::filesystem::create_directories(folder_ / "merged");
  const std::string path = folder_ / "merged/sub-01_ses-01_task-chaintwohands_run-03_log.reach";
  const MergeReport report = mergeStations({logOf(1), logOf(0)}, asked, path);
  ASSERT_EQ(report.stations.size(), 2u);
  EXPECT_TRUE(report.stations[0].conductor);
  EXPECT_NEAR(report.stations[1].offset, 7654.321, 1e-6);
  EXPECT_LT(report.stations[1].offsetSpread, 1e-6);
  EXPECT_EQ(report.stations[1].otherOutcomes, 0);

  const record::RunLog merged = record::RunLog::open(path), left = record::RunLog::open(logOf(0)), right = record::RunLog::open(logOf(1));
  EXPECT_TRUE(merged.healthy());
  EXPECT_TRUE(isMerged(merged));
  EXPECT_EQ(merged.configuration().table.hands, 2);
  EXPECT_EQ(merged.configuration().run, 3);
  ASSERT_EQ(merged.trials().size(), 1u);
  EXPECT_EQ(merged.trials()[0].result.outcome, trial::Outcome::Success);
  EXPECT_EQ(merged.trials()[0].result.endTick, left.trials()[0].result.endTick);
  const record::SampleRows all = merged.allRows(), own = left.allRows(), others = right.allRows();
  ASSERT_EQ(all.size(), own.size());
  const auto of = [](const record::RunLog& log, const char* name) { return log.configuration().table.indexOf(name); };
  for (const std::size_t row : {all.size() / 2, all.size() - 200}) {
    EXPECT_EQ(all.at(row, of(merged, "hand_pos_x")), own.at(row, of(left, "hand_pos_x")));
    EXPECT_EQ(all.at(row, of(merged, "mass5_pos_x")), own.at(row, of(left, "mass5_pos_x")));
    // The other's tick half a millisecond later or earlier.
    const double there = all.at(row, of(merged, "hand2_pos_x"));
    const std::size_t column = of(right, "hand_pos_x");
    EXPECT_TRUE(there == others.at(row, column) || there == others.at(row - 1, column) || there == others.at(row + 1, column)) << row;
    EXPECT_NE(all.at(row, of(merged, "hand_work")), 0);
  }
  ASSERT_EQ(logsOfMerged(merged).size(), 2u);
  for (const std::string& log : logsOfMerged(merged)) EXPECT_TRUE(replayStation(record::RunLog::open(log)).identical()) << log;
  // How each copy stood to the other, as its own log has it.
  const std::size_t row = all.size() * 7 / 8;  // a second after the first sample, so that the loss is known
  for (const char* what : {"ledger", "of_2_apart", "of_2_age", "of_2_fade", "of_2_synchronisation", "of_2_round_trip", "of_2_loss"}) {
    const std::string name = std::string("station1_") + what;
    EXPECT_EQ(all.at(row, of(merged, name.c_str())), own.at(row, of(left, name.c_str()))) << name;
  }
  EXPECT_LT(all.at(row, of(merged, "station1_of_2_apart")), 1e-3);
  EXPECT_GT(all.at(row, of(merged, "station2_of_1_apart")), 0);
  EXPECT_NEAR(all.at(row, of(merged, "station2_of_1_age")), 0.01, 2e-3);
  EXPECT_EQ(all.at(row, of(merged, "station2_of_1_loss")), 0);
  EXPECT_NEAR(all.at(row, of(merged, "station1_of_2_round_trip")), 0.02, 1e-9);
}

TEST_F(StationsOnClocks, AMergedRunEndsWhereALogBrokeOff) {
  run(good);
  const std::string cut = folder_ / "cut.reach", path = folder_ / "merged/sub-01_ses-01_task-chaintwohands_run-03_log.reach";
  std::filesystem::copy(logOf(1), cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  const MergeReport report = mergeStations({logOf(0), cut}, record::madeConfiguration(), path);
  EXPECT_EQ(report.cutOff, 1);
  const record::RunLog merged = record::RunLog::open(path);
  ASSERT_EQ(merged.trials().size(), 1u);
  EXPECT_EQ(merged.trials()[0].result.outcome, trial::Outcome::Interrupted);
  const record::SampleRows rows = merged.allRows();
  EXPECT_LT(rows.ticks.back(), record::RunLog::open(logOf(0)).allRows().ticks.back());
  EXPECT_LT(rows.ticks.back(), record::RunLog::open(cut).ticks().size() + 101) << "no hand stands still where it is not known";
  std::filesystem::remove(logsOfMerged(merged).front());
  EXPECT_TRUE(holds(refusalOf([&] { (void)logsOfMerged(merged); }), "1 of the 2 stations' logs"));
}

TEST_F(StationsOnClocks, AFailedMergeLeavesNothing) {
  run(good);
  std::filesystem::create_directories(folder_ / "merged/taken_log.reach");  // a folder in the log's place
  EXPECT_NE(refusalOf([&] { mergeStations({logOf(0), logOf(1)}, record::madeConfiguration(), folder_ / "merged/taken_log.reach"); }), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "merged/stations"));
}

TEST(StationEngine, IsOfOneHand) {
  const experiment::CompiledExperiment experiment{experiment::readExperiment("chain-two-hands")};
  CoupledCopy* copy = nullptr;
  const haptics::DeviceInfo hand{.maxForce = 12, .virtualHand = true};
  EXPECT_TRUE(holds(refusalOf([&] { makeStationEngine(experiment, 0, {{hand, hand}}, copy); }), "is 2 devices at a station"));
}

TEST_F(StationsOnClocks, LogsThatAreOfNoOneRunAreRefused) {
  run(good);
  const auto sayOf = [&](const std::vector<std::string>& logs) -> std::string {
    const std::string path = folder_ / "refused_log.reach";
    const std::string said = refusalOf<FaultError>([&] { mergeStations(logs, record::madeConfiguration(), path); });
    EXPECT_EQ(std::filesystem::exists(path), said.empty());
    return said;
  };
  EXPECT_TRUE(holds(sayOf({logOf(0)}), "one of each station"));
  EXPECT_TRUE(holds(sayOf({logOf(0), logOf(0)}), "two are of station 1"));
  conducts_ = {false, false};
  run(good);
  EXPECT_TRUE(holds(sayOf({logOf(0), logOf(1)}), "0 are of a conductor; allowed: one"));
  conducts_ = {true, true};
  run(good);
  EXPECT_TRUE(holds(sayOf({logOf(0), logOf(1)}), "2 are of a conductor; allowed: one"));
  conducts_ = {true, false};
  run(good);
  // Another run's second station.
  const std::string first = folder_ / "first.reach";
  std::filesystem::copy(logOf(0), first);
  run([](std::int64_t sent) { return std::vector<std::int64_t>{sent + 90 * kDelayNs}; });
  const std::string other = sayOf({first, logOf(1)});
  EXPECT_TRUE(holds(other, "not of one run"));
}

// The haptic thread moves the copy while the controlling thread reads what was given: it must not ask the copy anything meanwhile.
TEST(StationSink, IsReadWhileTheCopyMoves) {
  const experiment::CompiledExperiment experiment{experiment::readExperiment("chain-two-hands")};
  const auto memory = std::make_unique<LinkMemory>();
  CoupledCopy* copy = nullptr;
  const auto engine = makeStationEngine(experiment, 0, {{{.maxForce = 12, .virtualHand = true}}}, copy);
  StationSink sink(*memory, *copy, 0);
  std::atomic<bool> on{true};
  std::atomic<int> records{0}, wrong{0};
  std::thread reader([&] {
    while (on) {
      const std::vector<std::uint8_t> given = sink.takeGiven();
      if (given.empty()) continue;
      record::ByteReader in(given);
      const auto count = in.get<std::uint32_t>();
      in.get<std::uint32_t>();
      if (in.get<std::uint32_t>() != 5 || in.get<std::uint32_t>() != 5 || in.left() != count * (88u + 80u)) ++wrong;
      ++records;
    }
  });
  HeardState heard;
  heard.trial = 1, heard.roundTrip = 0.02;
  OwnState sent;
  for (std::uint32_t tick = 1; records < 200 && tick < 5'000'000; ++tick) {
    haptics::TickInput input;
    input.measuredNs = tick * 1'000'000ll;
    if (tick == 5) input.command = trial::Command::NextTrial;
    input.devices[0].position = engine->state().masses[0].r;
    haptics::runTick(*engine, input);
    heard.sample.sequence = tick, heard.sample.time = 1e-3 * tick;
    (void)memory->in[1].tryPush(heard);
    sink.onTick(engine->state(), input.command, 0);
    while (memory->out.tryPop(sent)) {}
  }
  on = false;
  reader.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(records, 200);
}

}  // namespace
}  // namespace reachlab::network
