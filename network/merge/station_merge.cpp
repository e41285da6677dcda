#include "network/merge/station_merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>

#include "base/fault.h"
#include "base/ticks.h"
#include "constraints/constraint.h"
#include "network/link/given_samples.h"
#include "network/link/link_channels.h"
#include "network/link/station_link.h"
#include "network/link/station_replay.h"
#include "sim/experiment/experiment.h"
#include "sim/record/log/atomic_file.h"
#include "sim/record/log/recorder.h"

namespace reachlab::network {
namespace fs = std::filesystem;
namespace {

constexpr const char* kMethod = "stations";
constexpr double kMostContradiction = 0.005;  // [s] of two clocks told from either side, beyond what the link's unequal ways explain

/// A station's log, computed again.
struct Station {
  record::RunLog log;
  int number = 0;  // from 1
  bool conductor = false;
  std::vector<record::RecordedTick> ticks = {};
  std::vector<haptics::HandState> hands = {};  // after each tick
  std::vector<trial::Phase> phases = {};
  std::size_t linkColumns = 0;
  std::vector<double> links = {};  // how its copy stood to the others after each tick, as fillLinks has it
  std::vector<GivenSample> given = {};

  /// The samples of another station that came here.
  template <class Look>
  void eachSampleOf(const Station& there, Look&& look) const {
    const int peer = there.number < number ? there.number - 1 : there.number - 2;
    for (const GivenSample& one : given)
      if (one.peer == peer && one.sample.sequence != 0) look(one);
  }
};

[[noreturn]] void refuse(const std::string& what, const std::string& allowed, const std::string& path = {}) {
  Fault fault{"logs", what, allowed};
  if (!path.empty()) fault.place = FilePlace{path};
  throw FaultError(fault);
}

bool isConductor(const record::RunLog& log) {
  for (const record::RecordedEvent& event : log.events())
    if (event.kind == record::EventKind::Note && event.text.starts_with("station "))
      return event.text.find(", conductor") != std::string::npos;
  return false;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

Station readStation(const std::string& path) {
  Station s{.log = record::RunLog::open(path)};
  s.number = stationOf(s.log);
  if (s.number == 0) refuse("is of no station", "logs of reach station", path);
  s.conductor = isConductor(s.log);
  s.ticks = s.log.ticks();
  s.hands.reserve(s.ticks.size());
  s.given = givenSamples(s.log);
  const record::Replay replay = replayStation(s.log, [&](const haptics::TickState& state, const CoupledCopy& copy) {
    haptics::HandState hand = state.hands[0];
    hand.work = copy.ownWork();
    s.hands.push_back(hand);
    s.phases.push_back(state.phase);
    std::array<double, kMostLinkColumns> columns{};
    fillLinks(copy, columns.data());
    s.linkColumns = linkColumns(copy.peerCount());
    s.links.insert(s.links.end(), columns.begin(), columns.begin() + static_cast<std::ptrdiff_t>(s.linkColumns));
  });
  if (!replay.identical())
    refuse("is another when its copy is computed again: " + replay.firstDifference, "a log as this program recorded it", path);
  return s;
}

/// Another station's clock less this one's, from its samples' times here and in its own log; by seconds of this log, because clocks drift.
class ClockOffset {
 public:
  ClockOffset(const Station& here, const Station& there) : beginNs_(here.ticks.empty() ? 0 : here.ticks.front().measuredNs) {
    std::map<std::int64_t, std::vector<double>> seconds;
    here.eachSampleOf(there, [&](const GivenSample& given) {
      if (given.sample.sequence > there.ticks.size()) return;
      const double offset = static_cast<double>(there.ticks[given.sample.sequence - 1].measuredNs) * 1e-9 - given.sample.time;
      all_.push_back(offset);
      seconds[static_cast<std::int64_t>(given.sample.time - static_cast<double>(beginNs_) * 1e-9)].push_back(offset);
      if (given.roundTrip > 0) longest_ = std::max(longest_, given.roundTrip);
    });
    for (auto& [second, offsets] : seconds) medians_[second] = quantile(std::move(offsets), 0.5);
  }
  bool known() const { return !all_.empty(); }
  double median() const { return quantile(all_, 0.5); }
  double spread() const { return quantile(all_, 0.95) - quantile(all_, 0.05); }
  double longestRoundTrip() const { return longest_; }
  /// [s] at a moment of this station's clock: of the second nearest to it.
  double at(std::int64_t ns) const {
    const std::int64_t second = (ns - beginNs_) / 1'000'000'000;
    auto after = medians_.lower_bound(second);
    if (after == medians_.end()) return std::prev(after)->second;
    if (after == medians_.begin() || after->first - second <= second - std::prev(after)->first) return after->second;
    return std::prev(after)->second;
  }

 private:
  std::int64_t beginNs_;
  std::vector<double> all_;
  std::map<std::int64_t, double> medians_;
  double longest_ = 0;  // [s]
};

/// The tick that is nearest to a moment of its station's clock, from the one `at` of an earlier moment on.
std::size_t nearestTick(const std::vector<record::RecordedTick>& ticks, std::size_t at, std::int64_t ns) {
  while (at + 1 < ticks.size() && std::abs(ticks[at + 1].measuredNs - ns) <= std::abs(ticks[at].measuredNs - ns)) ++at;
  return at;
}

std::vector<Station> readAll(const std::vector<std::string>& logs) {
  std::vector<Station> stations;
  for (const std::string& log : logs) stations.push_back(readStation(log));
  std::sort(stations.begin(), stations.end(), [](const Station& a, const Station& b) { return a.number < b.number; });
  const experiment::Experiment shared = record::recordedValues(stations.front().log.configuration());
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Station& s = stations[i];
    if (i > 0 && s.number == stations[i - 1].number)
      refuse(fmt::format("two are of station {}", s.number), "one of each station", s.log.path());
    const std::uint64_t first = sharedHash(shared), hash = sharedHash(record::recordedValues(s.log.configuration()));
    if (hash != first)
      refuse(fmt::format("has another experiment ({:016x}, station {} {:016x})", hash, stations.front().number, first), "logs of one run",
             s.log.path());
  }
  if (stations.size() != shared.hands.size())
    refuse(fmt::format("are {}, and the experiment has {} hands", stations.size(), shared.hands.size()), "one of each station");
  const auto conductors = std::count_if(stations.begin(), stations.end(), [](const Station& s) { return s.conductor; });
  if (conductors != 1) refuse(fmt::format("{} are of a conductor", conductors), "one");
  return stations;
}

// What came here is what the other's log says it sent: the same hand and the same work, to the bit. A log that broke off has sent more.
void requireSameSamples(const Station& here, const Station& there) {
  // This comes before the comparison of samples. A station that was started again counts its samples anew, so that none would be the same.
  CopySample last;
  here.eachSampleOf(there, [&](const GivenSample& given) {
    // One that was overtaken on its way was also sent earlier.
    if (given.sample.sequence < last.sequence && given.sample.time > last.time)
      refuse(fmt::format("hold samples of station {} that begin anew: it was started again in this run", there.number),
             "a run of which every station was there from the beginning to the end", here.log.path());
    last = given.sample;
  });
  here.eachSampleOf(there, [&](const GivenSample& given) {
    const std::uint32_t sequence = given.sample.sequence;
    if (sequence > there.hands.size() || there.phases[sequence - 1] < trial::Phase::Armed) return;
    if (!(given.sample.hand == there.hands[sequence - 1].hip.position && given.sample.work == there.hands[sequence - 1].work))
      refuse(fmt::format("of stations {} and {} are not of one run: sample {} came otherwise than it was sent", here.number, there.number,
                         sequence),
             "logs of one run", there.log.path());
  });
}

int countOtherOutcomes(const record::RunLog& log, const record::RunLog& conductors) {
  int differing = 0;
  for (const record::RecordedTrial& trial : log.trials())
    for (const record::RecordedTrial& judged : conductors.trials())
      if (judged.trial == trial.trial && (judged.result.outcome != trial.result.outcome || judged.result.reason != trial.result.reason))
        ++differing;
  return differing;
}

double rmsApart(const Station& s) {
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < s.phases.size(); ++i) {
    if (s.phases[i] != trial::Phase::Moving) continue;
    for (int peer = 0; linkColumns(peer) < s.linkColumns; ++peer)
      if (const double apart = s.links[i * s.linkColumns + linkColumns(peer)]; !std::isnan(apart)) squares += apart * apart, ++count;
  }
  return count == 0 ? 0 : std::sqrt(squares / static_cast<double>(count));
}

record::RunConfiguration mergedConfiguration(const std::vector<Station>& stations, const Station& conductor,
                                             const record::RunConfiguration& asked) {
  record::RunConfiguration c = conductor.log.configuration();
  c.subject = asked.subject, c.session = asked.session, c.run = c.firstRun = asked.run;
  const record::RunConfiguration& first = stations.front().log.configuration();
  c.device = first.device;
  c.firstHand = first.firstHand;
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const record::RunConfiguration& o = stations[i].log.configuration();
    c.device += " + " + o.device;
    c.otherHands.push_back(o.firstHand);
  }
  c.methodReason =
      fmt::format("merged from the logs of {} stations, each with a copy of its own ({}); the object is the conductor's, station {}",
                  stations.size(), c.methodReason, conductor.number);
  c.method = kMethod;
  const experiment::CompiledExperiment compiled = record::recordedExperiment(conductor.log.configuration());
  c.table = record::makeChannelTable(compiled.experiment(), compiled.constraint().parameterCount(), c.firstHand.rendersForce);
  for (const Station& s : stations)
    for (const record::Channel& channel : linkChannels(s.number, static_cast<int>(stations.size()))) c.table.channels.push_back(channel);
  return c;
}

/// How every station's copy stood to the others at the tick of its own that a row is of.
class LinksOfAll final : public record::FurtherColumns {
 public:
  LinksOfAll(const std::vector<Station>& stations, const std::vector<std::size_t>& ticks) : stations_(stations), ticks_(ticks) {}
  void fill(double* columns) const noexcept override {
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const std::size_t width = stations_[i].linkColumns;
      columns = std::copy_n(stations_[i].links.data() + ticks_[i] * width, width, columns);
    }
  }

 private:
  const std::vector<Station>& stations_;
  const std::vector<std::size_t>& ticks_;
};

// That of a station against the conductor's, where the two logs are of one run. Told from either side the two must be opposite, but for the
// link's unequal ways.
ClockOffset clockOffset(const Station& conductor, const Station& s) {
  const ClockOffset offset(conductor, s), back(s, conductor);
  if (!offset.known())
    refuse(fmt::format("of the conductor holds nothing of station {}", s.number), "logs of one run", conductor.log.path());
  const double contradiction = back.known() ? std::abs(offset.median() + back.median()) : 0;
  const double allowed = 0.5 * std::max(offset.longestRoundTrip(), back.longestRoundTrip()) + kMostContradiction;
  if (contradiction > allowed)
    refuse(fmt::format("of stations {} and {} tell clocks that differ by {:.6f} s", s.number, conductor.number, contradiction),
           fmt::format("up to {:.6f} s: logs of one run", allowed));
  requireSameSamples(conductor, s), requireSameSamples(s, conductor);
  return offset;
}

MergedStation reportOf(const Station& s, const Station& conductor, const std::optional<ClockOffset>& offset) {
  return {s.number,
          s.conductor,
          s.ticks.size(),
          s.given.size(),
          countOtherOutcomes(s.log, conductor.log),
          offset ? offset->median() : 0,
          offset ? offset->spread() : 0,
          rmsApart(s)};
}

// Writes the hands of all stations at each tick of the conductor. A hand has the place of its own station's nearest tick. The merged log ends where the
// first of the logs ends, and a trial that is under way there is interrupted. Returns the number of rows.
std::uint64_t writeMerged(const std::vector<Station>& stations, const Station& conductor,
                          const std::vector<std::optional<ClockOffset>>& offsets, const record::RunConfiguration& merged,
                          const std::string& path) {
  std::vector<std::size_t> ticks(stations.size());
  const LinksOfAll links(stations, ticks);
  record::Recorder recorder(path, merged, record::RecorderOptions{.threaded = false, .further = &links});
  const std::vector<record::TrialSetup> setups = conductor.log.setups();
  std::size_t number = 0, setup = 0;
  std::uint64_t rows = 0;
  bool ended = false;
  constexpr std::int64_t kEndsApartNs = 100'000'000;  // stations hear up to so late of the end of a run
  const auto state = std::make_unique<haptics::TickState>();
  (void)replayStation(conductor.log, [&](const haptics::TickState& own, const CoupledCopy&) {
    if (ended) return;
    const record::RecordedTick& tick = conductor.ticks[number];
    haptics::copyState(own, *state);
    state->handCount = static_cast<std::int32_t>(stations.size());
    for (std::size_t i = 0; i < stations.size(); ++i) {
      const Station& s = stations[i];
      const std::int64_t there = s.conductor ? tick.measuredNs : tick.measuredNs + std::llround(1e9 * offsets[i]->at(tick.measuredNs));
      ticks[i] = s.conductor ? number : nearestTick(s.ticks, ticks[i], there);
      ended = ended || (ticks[i] + 1 == s.ticks.size() && there > s.ticks[ticks[i]].measuredNs + kEndsApartNs);
      state->hands[i] = s.hands[ticks[i]];
    }
    if (ended) return;
    if (tick.command == trial::Command::NextTrial && setup < setups.size()) {
      recorder.announce(setups[setup].trial - merged.firstTrial + 1, setups[setup].planned);
      ++setup;
    }
    recorder.onTick(*state, tick.command, tick.missedTicks);
    if (own.tick % merged.sampleEveryTicks == 0) ++rows;
    ++number;
  });
  for (const Station& s : stations)
    for (const record::RecordedEvent& event : s.log.events())
      if (event.kind == record::EventKind::Note) recorder.note(fmt::format("station {}: {}", s.number, event.text));
  recorder.close();
  return rows;
}

// Copies the stations' logs into the folder `stations` beside the merged one. `made` gets their paths.
void keepLogs(const std::vector<Station>& stations, const std::string& path, std::vector<std::string>& made) {
  const fs::path kept = fs::path(path).parent_path() / "stations";
  for (const Station& s : stations) {
    made.push_back((kept / fmt::format("{}_station-{}.reach", fs::path(path).stem().string(), s.number)).string());
    record::AtomicFile copy(made.back());
    std::ifstream log(s.log.path(), std::ios::binary);
    std::vector<char> piece(1 << 20);
    while (log.read(piece.data(), static_cast<std::streamsize>(piece.size())) || log.gcount() > 0)
      copy.append({piece.data(), static_cast<std::size_t>(log.gcount())});
    copy.commit();
  }
}

}  // namespace

int stationOf(const record::RunLog& log) { return isOfStation(log) ? readGiven(log).own + 1 : 0; }

bool isMerged(const record::RunLog& log) { return log.configuration().method == kMethod; }

std::vector<std::string> logsOfMerged(const record::RunLog& log) {
  const fs::path path(log.path());
  const std::string stem = path.stem().string();
  std::vector<std::string> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path() / "stations", error))
    if (entry.path().filename().string().starts_with(stem + "_station-")) found.push_back(entry.path().string());
  std::sort(found.begin(), found.end());
  const auto hands = static_cast<std::size_t>(log.configuration().table.hands);
  if (found.size() != hands)
    throw FaultError(Fault{{},
                           fmt::format("{} of the {} stations' logs are beside it in the folder stations", found.size(), hands),
                           "all of them",
                           FilePlace{log.path()}});
  return found;
}

MergeReport mergeStations(const std::vector<std::string>& logs, const record::RunConfiguration& configuration, const std::string& path) {
  if (logs.size() < 2) refuse(fmt::format("are {}", logs.size()), "one of each station, two or more");
  const std::vector<Station> stations = readAll(logs);
  const Station& conductor = *std::find_if(stations.begin(), stations.end(), [](const Station& s) { return s.conductor; });
  MergeReport report;
  std::vector<std::optional<ClockOffset>> offsets;  // none for the conductor
  for (const Station& s : stations) {
    offsets.push_back(s.conductor ? std::nullopt : std::optional(clockOffset(conductor, s)));
    report.stations.push_back(reportOf(s, conductor, offsets.back()));
  }
  std::vector<std::string> made;
  try {
    keepLogs(stations, path, made);
    made.push_back(path);
    report.rows = writeMerged(stations, conductor, offsets, mergedConfiguration(stations, conductor, configuration), path);
  } catch (...) {  // half a run would count as one
    std::error_code error;
    for (const std::string& file : made) fs::remove(file, error);
    throw;
  }
  const record::RunLog merged = record::RunLog::open(path, record::LogCheck::Trials);
  report.trials = static_cast<int>(merged.trials().size());
  const auto& conducted = conductor.log.trials();
  for (std::size_t i = 0; i < conducted.size(); ++i)
    if (i >= merged.trials().size() ||
        (merged.trials()[i].result.outcome == trial::Outcome::Interrupted && conducted[i].result.outcome != trial::Outcome::Interrupted))
      ++report.cutOff;
  return report;
}

}  // namespace reachlab::network
