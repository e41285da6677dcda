#include "network/line/station_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <new>
#include <utility>

#include "base/fault.h"
#include "base/math/seeded.h"
#include "base/system/os.h"
#include "base/ticks.h"
#include "sim/dynamics/scene.h"
#include "sim/experiment/experiment.h"

extern char** environ;

namespace reachlab::network {
namespace {

constexpr double kMostRoundTrip = 0.12, kMostGap = 0.05;  // [s]: beyond them the coupling is not known to be stable
constexpr std::int64_t kPresentNs = 3'000'000'000;        // a card comes every second
constexpr std::int64_t kHeardNs = 500'000'000;
constexpr double kMostJump = 0.005;                 // [s] of a clock against ours, in one look
constexpr std::int64_t kSettledNs = 1'000'000'000;  // until then the fastest exchange is still looked for
constexpr std::int64_t kJumpNs = 1'000'000'000;     // for so long a jump stands in the way

template <std::size_t N>
void put(const std::string& from, std::array<char, N>& to, const char* key) {
  if (from.size() >= N) throw FaultError(Fault{key, fmt::format("is {} characters long", from.size()), fmt::format("up to {}", N - 1)});
  to.fill(0);
  std::copy(from.begin(), from.end(), to.begin());
}

void fillSettings(const StationOptions& options, std::uint64_t experiment, EndpointSettings& settings) {
  StationCard& card = settings.card;
  card.station = static_cast<std::uint32_t>(options.station);
  card.version = LineMemory::kVersion;
  card.experiment = experiment;
  card.conductor = options.conductor;
  put(options.name.substr(0, card.name.size() - 1), card.name, "name");
  put(options.software.substr(0, card.software.size() - 1), card.software, "software");
  put(options.device.substr(0, card.device.size() - 1), card.device, "device");
  settings.domain = options.domain;
  put(options.secure.empty() ? std::string() : std::filesystem::absolute(options.secure).string(), settings.secure, "peers");
  put(options.interface, settings.interface, "interface");
  if (options.peers.size() > settings.peers.size())
    throw FaultError(
        Fault{"peer", fmt::format("is given {} times", options.peers.size()), fmt::format("up to {} times", settings.peers.size())});
  for (std::size_t i = 0; i < options.peers.size(); ++i) put(options.peers[i], settings.peers[i], "peer");
}

// What holds at the end of the tick to come.
double nextTime(const haptics::TickState& state) noexcept { return static_cast<double>(state.measuredNs + kTickNs) * 1e-9; }

std::vector<GivenSample> decodeGiven(std::span<const std::uint8_t> payload, int& own) {
  record::ByteReader in(payload);
  std::vector<GivenSample> all(std::min<std::size_t>(in.get<std::uint32_t>(), payload.size()));
  own = static_cast<int>(std::min<std::uint32_t>(in.get<std::uint32_t>(), kMaxStations));
  const auto vector = [&](Vec3& v) { v.x = in.get<double>(), v.y = in.get<double>(), v.z = in.get<double>(); };
  const std::size_t places = in.get<std::uint32_t>(), rates = in.get<std::uint32_t>();
  if (places > kMaxCoordinates || rates > kMaxCoordinates) throw FaultError(Fault{.what = "peer record of an unknown form"});
  for (GivenSample& given : all) {
    given.tick = in.get<std::uint64_t>();
    given.peer = in.get<std::int32_t>();
    given.roundTrip = in.get<double>();
    CopySample& s = given.sample;
    s.sequence = in.get<std::uint32_t>();
    s.time = in.get<double>();
    vector(s.hand), vector(s.handVelocity);
    s.work = in.get<double>();
    for (std::size_t i = 0; i < places; ++i) s.places[i] = in.get<double>();
    for (std::size_t i = 0; i < rates; ++i) s.rates[i] = in.get<double>();
  }
  if (!in.ok() || in.left() != 0) throw FaultError(Fault{.what = "peer record of an unknown form"});
  return all;
}

}  // namespace

std::uint64_t sharedHash(const experiment::Experiment& experiment) { return hashOf(experiment::toJson(experiment)); }

StationLine::StationLine(const StationOptions& options, std::uint64_t experiment)
    : options_(options), experiment_(experiment), memoryName_(fmt::format("/reachlab-{}-{}", ::getpid(), options.station)) {
  EndpointSettings settings;
  fillSettings(options, experiment, settings);
  const int descriptor = ::shm_open(memoryName_.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
  if (descriptor < 0) throw ResourceError(fmt::format("memory to share with the endpoint cannot be had: {}", std::strerror(errno)));
  void* at = ::ftruncate(descriptor, sizeof(LineMemory)) == 0
                 ? ::mmap(nullptr, sizeof(LineMemory), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0)
                 : MAP_FAILED;
  ::close(descriptor);
  if (at == MAP_FAILED) {
    ::shm_unlink(memoryName_.c_str());
    throw ResourceError(fmt::format("memory to share with the endpoint cannot be had: {}", std::strerror(errno)));
  }
  memory_ = new (at) LineMemory;
  memory_->settings = settings;
  std::string program = options.endpoint, name = memoryName_;
  std::array<char*, 3> arguments{program.data(), name.data(), nullptr};
  pid_t process = -1;
  const int failed = ::posix_spawn(&process, options.endpoint.c_str(), nullptr, nullptr, arguments.data(), environ);
  if (failed != 0) {
    ::shm_unlink(memoryName_.c_str());
    throw ResourceError(fmt::format("the endpoint {} cannot be started: {}", options.endpoint, std::strerror(failed)));
  }
  process_ = process;
}

StationLine::~StationLine() {
  (void)finish();
  ::munmap(memory_, sizeof(LineMemory));
  ::shm_unlink(memoryName_.c_str());
}

std::string StationLine::finish() {
  if (process_ <= 0) return {};
  const std::string early = endpointFault();
  memory_->stop.store(true, std::memory_order_release);
  constexpr int kLooks = 300;
  constexpr std::int64_t kLookNs = 10'000'000;
  int status = 0;
  for (int look = 0; look < kLooks; ++look) {
    if (::waitpid(process_, &status, WNOHANG) == process_) {
      process_ = -1;
      break;
    }
    os::sleepUntil(os::now() + kLookNs);
  }
  if (!early.empty()) return early;
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, &status, 0);
    process_ = -1;
    return "the endpoint did not end when it was asked to, and was killed";
  }
  if (WIFSIGNALED(status)) return fmt::format("the endpoint ended by signal {} when it was asked to end", WTERMSIG(status));
  return {};
}

void StationLine::send(const LineEvent& event) {
  LineEvent own = event;
  own.station = static_cast<std::uint32_t>(options_.station);
  if (!memory_->eventsOut.tryPush(own)) throw ResourceError("the endpoint takes no messages any more");
}

void StationLine::look() {
  StationCard card;
  while (memory_->cardsIn.tryPop(card)) {
    if (card.station < 1 || card.station > kMaxStations) continue;
    cards_[card.station - 1] = card;
    cardNs_[card.station - 1] = os::now();
  }
  const std::int64_t now = os::now();
  for (std::size_t i = 0; i < kMaxStations; ++i) {
    const LineStatus& line = memory_->status[i];
    Offset& known = offsets_[i];
    if (line.roundTrip.load() < 0 || now - line.heardNs.load() > kHeardNs) {
      known = {};
      continue;
    }
    const double offset = line.offset.load();
    if (known.sinceNs == 0) known.sinceNs = now;
    else if (now - known.sinceNs > kSettledNs && std::abs(offset - known.value) > kMostJump)
      known.jump = offset - known.value, known.jumpNs = now;
    known.value = offset;
  }
}

bool StationLine::endpointAlive() const {
  constexpr std::int64_t kSilentNs = 1'000'000'000;
  const std::int64_t alive = memory_->aliveNs.load(std::memory_order_acquire);
  return endpointFault().empty() && (alive == 0 || os::now() - alive < kSilentNs);
}

double StationLine::conductorSilence() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kMaxStations; ++i)
    if (cardNs_[i] != 0 && cards_[i].conductor) least = std::min(least, static_cast<double>(os::now() - cardNs_[i]) * 1e-9);
  return least;
}

std::string StationLine::endpointFault() const {
  if (process_ <= 0) return {};
  siginfo_t ended{};
  if (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid == 0) return {};
  if (ended.si_code == CLD_EXITED) return fmt::format("this station's endpoint has ended with exit code {}", ended.si_status);
  return fmt::format("this station's endpoint was ended by signal {}", ended.si_status);
}

std::vector<std::string> StationLine::obstacles() const {
  std::vector<std::string> found;
  if (const std::string fault = endpointFault(); !fault.empty()) found.push_back(fault);
  else if (!endpointAlive()) found.push_back("this station's endpoint has not done a round for a second");
  for (const StationStanding& other : standings())
    for (const std::string& what : other.obstacles) found.push_back(fmt::format("station {}: {}", other.station, what));
  return found;
}

std::vector<StationStanding> StationLine::standings() const {
  std::vector<StationStanding> all;
  for (int station = 1; station <= options_.stations; ++station)
    if (station != options_.station) all.push_back(standingOf(station));
  return all;
}

StationStanding StationLine::standingOf(int station) const {
  using Light = StationStanding::Light;
  const std::int64_t now = os::now();
  const auto index = static_cast<std::size_t>(station - 1);
  const StationCard& card = cards_[index];
  const LineStatus& line = memory_->status[index];
  StationStanding s;
  s.station = station;
  if (cardNs_[index] != 0)
    s.name = card.name.data(), s.software = card.software.data(), s.device = card.device.data(), s.conductor = card.conductor;
  if (cardNs_[index] == 0 || now - cardNs_[index] > kPresentNs) {
    s.obstacles.push_back("is not there");
    return s;
  }
  const auto say = [&](const std::string& what) { s.obstacles.push_back(what); };
  if (card.version != LineMemory::kVersion)
    say(fmt::format("speaks version {} of the messages, and this one {}", card.version, LineMemory::kVersion));
  if (options_.software != s.software) say(fmt::format("runs {}, and this one {}", s.software, options_.software));
  if (card.experiment != experiment_) say(fmt::format("has another experiment ({:016x}, here {:016x})", card.experiment, experiment_));
  if (card.conductor && options_.conductor) say("is a conductor too");
  s.roundTrip = line.roundTrip.load(), s.jitter = line.jitter.load(), s.loss = line.loss.load(), s.offset = line.offset.load();
  const std::int64_t silentNs = std::max<std::int64_t>(now - line.heardNs.load(), 0);
  const double gap = line.gap.load();
  const bool looksOn = options_.station == 0;  // nobody answers it: there is no round trip
  s.heard = silentNs <= kHeardNs && (s.roundTrip >= 0 || looksOn);
  s.age = static_cast<double>(silentNs) * 1e-9;
  if (!s.heard) {
    say("sends nothing");
    s.light = Light::Stop;
    return s;
  }
  if (s.roundTrip > kMostRoundTrip)
    say(fmt::format("a round trip takes {:.0f} ms; allowed: up to {:.0f}", 1e3 * s.roundTrip, 1e3 * kMostRoundTrip));
  // Overtaken samples are dropped by design, so their share says nothing; how long nothing comes does.
  if (gap > kMostGap) say(fmt::format("nothing comes for {:.0f} ms at a time; allowed: up to {:.0f}", 1e3 * gap, 1e3 * kMostGap));
  if (offsets_[index].jumpNs != 0 && now - offsets_[index].jumpNs < kJumpNs)
    say(fmt::format("its clock jumped by {:.1f} ms against this one's; allowed: up to {:.0f}", 1e3 * offsets_[index].jump,
                    1e3 * kMostJump));
  s.light = !s.obstacles.empty() ? Light::Stop : s.roundTrip > 0.5 * kMostRoundTrip || gap > 0.5 * kMostGap ? Light::Fair : Light::Good;
  return s;
}

std::optional<bool> StationLine::isConductor(std::uint32_t station) const {
  if (station < 1 || station > kMaxStations || cardNs_[station - 1] == 0) return std::nullopt;
  return cards_[station - 1].conductor;
}

std::string StationLine::describe() const {
  std::string text;
  for (const StationCard& card : cards_) {
    if (card.station == 0 || static_cast<int>(card.station) == options_.station) continue;
    const LineStatus& line = memory_->status[card.station - 1];
    text += fmt::format("station {} ({}, {}{}): round trip {:.2f} ms, jitter {:.2f} ms, loss {:.1f} %, clock {:+.6f} s\n", card.station,
                        card.name.data(), card.device.data(), card.conductor ? ", conductor" : "", 1e3 * line.roundTrip.load(),
                        1e3 * line.jitter.load(), 100 * line.loss.load(), line.offset.load());
  }
  return text;
}

std::vector<record::Channel> lineChannels(int station, int stations) {
  std::vector<record::Channel> channels;
  const auto add = [&](const std::string& name, const char* units, const char* columnUnit, const std::string& description) {
    channels.push_back({name, "n/a", "MISC", "n/a", units, description, name + columnUnit});
  };
  const std::string here = fmt::format("{}{}", record::kFurtherName, station);
  add(here + "_ledger", "J", "_j", "what the hands have put in, as far as this station knows, less what its copy of the object holds");
  for (int other = 1; other <= stations; ++other) {
    if (other == station) continue;
    const std::string line = fmt::format("{}_of_{}_", here, other), of = fmt::format("station {}'s newest sample", other);
    add(line + "apart", "m", "_m", "this station's copy and the other's at the moment of " + of + ", root mean square over the masses");
    add(line + "age", "s", "_s", "age of " + of);
    add(line + "fade", "n/a", "", fmt::format("1 while station {}'s hand is held, 0 when it is let go", other));
    add(line + "synchronisation", "rad/s", "_rad_per_s", fmt::format("rate at which this copy is drawn to station {}'s", other));
    add(line + "round_trip", "s", "_s", "there and back, filtered over a second");
    add(line + "loss", "n/a", "",
        fmt::format("share of station {}'s samples of the latest whole second that were not used: lost, or overtaken", other));
  }
  return channels;
}

void fillLines(const CoupledCopy& copy, double* columns) noexcept {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  *columns++ = copy.ledger();
  for (int i = 0; i < copy.peerCount(); ++i) {
    const PeerLine& line = copy.line(i);
    const double round = line.roundTrip > 0 ? line.roundTrip : kUnknown, loss = line.loss >= 0 ? line.loss : kUnknown;
    for (const double value : {line.heard ? line.apart : kUnknown, line.age, line.fade, line.frequency, round, loss}) *columns++ = value;
  }
}

std::uint64_t StationSink::repeatedNow() const noexcept {
  std::uint64_t all = 0;
  for (int i = 0; i < copy_.peerCount(); ++i) all += copy_.line(i).old;
  return all;
}

bool StationSink::onTick(const haptics::TickState& state, trial::Command, std::uint32_t) noexcept {
  fillLines(copy_, lines_.data());
  const bool gives = !givesNoMore_.load(std::memory_order_acquire);
  if (!gives) gaveLast_.store(true, std::memory_order_release);
  if (const double wanted = frequency_.load(std::memory_order_acquire);
      gives && wanted != frequencyNow_ && given_->tryPush({state.tick, GivenSample::kFrequency, wanted, {}})) {
    frequencyNow_ = wanted;
    copy_.setFrequency(wanted);
  }
  if (state.trial != trial_) {
    trial_ = state.trial;
    squares_ = 0, count_ = 0;
    for (auto* apart : {&mostApart_, &rmsApart_, &lastApart_}) apart->store(0, std::memory_order_relaxed);
    oldest_.store(0, std::memory_order_relaxed), fadedTicks_.store(0, std::memory_order_relaxed);
    repeatedBefore_ = repeatedNow();
  }
  if (trial::isEngaged(state.phase)) {
    double apart = 0;
    double oldest = 0;
    bool faded = false;
    for (int i = 0; i < copy_.peerCount(); ++i) {
      const PeerLine& line = copy_.line(i);
      apart = std::max(apart, line.apart), oldest = std::max(oldest, line.age);
      faded = faded || (line.heard && line.age > 0 && line.fade < 1);  // age 0: not stepped yet
    }
    oldest_.store(std::max(oldest, oldest_.load(std::memory_order_relaxed)), std::memory_order_relaxed);
    if (faded) fadedTicks_.store(fadedTicks_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    repeated_.store(repeatedNow() - repeatedBefore_, std::memory_order_relaxed);
    squares_ += apart * apart, ++count_;
    lastApart_.store(apart, std::memory_order_relaxed);
    mostApart_.store(std::max(apart, mostApart_.load(std::memory_order_relaxed)), std::memory_order_relaxed);
    rmsApart_.store(std::sqrt(squares_ / static_cast<double>(count_)), std::memory_order_relaxed);
  }
  const double next = nextTime(state);
  const std::int32_t trial = state.trial < 1 ? state.trial : state.trial + trialsBefore_.load(std::memory_order_acquire);
  copy_.beginTick(next);
  HeardState heard;
  int peer = 0;
  bool came = false;
  for (int station = 0; station < kMaxStations && peer < copy_.peerCount(); ++station) {
    if (station == own_) continue;
    while (memory_.in[static_cast<std::size_t>(station)].tryPop(heard)) {
      seen_.place[static_cast<std::size_t>(station)] = heard.sample.hand;
      seen_.known[static_cast<std::size_t>(station)] = came = true;
      if (!gives || heard.trial != trial || trial < 1) continue;
      copy_.take(peer, heard.sample, heard.roundTrip);
      if (!given_->tryPush({state.tick, peer, heard.roundTrip, heard.sample})) memory_.ringsFull.fetch_add(1, std::memory_order_relaxed);
    }
    ++peer;
  }
  if (came) hands_.publish(seen_);
  OwnState own;
  own.timeNs = state.measuredNs;
  own.trial = trial;
  own.phase = static_cast<std::uint8_t>(state.phase);
  own.places = places_, own.rates = rates_;
  own.sample.sequence = ++sequence_;
  // Before it is armed a hand holds nothing: for the others it is where it will hold.
  const bool armed = state.phase == trial::Phase::Armed || state.phase == trial::Phase::Moving || state.phase == trial::Phase::Done;
  copy_.fill(own.sample, armed ? state.hands[0].hip : dynamics::HandSample{copy_.ownFixedPoint(), {}, true});
  if (state.tick % static_cast<std::uint64_t>(sendEvery_) != 0) return true;
  if (!memory_.out.tryPush(own)) memory_.ringsFull.fetch_add(1, std::memory_order_relaxed);
  return true;
}

std::vector<std::uint8_t> StationSink::takeGiven() {
  record::ByteWriter out;
  std::uint32_t count = 0;
  const auto begin = [&] { out.put(std::uint32_t{0}), out.put(static_cast<std::uint32_t>(own_)), out.put(places_), out.put(rates_); };
  if (!std::exchange(said_, true)) begin();
  GivenSample given;
  while (given_->tryPop(given)) {
    if (out.size() == 0) begin();
    ++count;
    const CopySample& s = given.sample;
    out.put(given.tick), out.put(given.peer), out.put(given.roundTrip), out.put(s.sequence), out.put(s.time);
    for (const Vec3& v : {s.hand, s.handVelocity}) out.put(v.x), out.put(v.y), out.put(v.z);
    out.put(s.work);
    for (std::uint32_t i = 0; i < places_; ++i) out.put(s.places[i]);
    for (std::uint32_t i = 0; i < rates_; ++i) out.put(s.rates[i]);
  }
  if (out.size() == 0) return {};
  out.overwrite(0, count);
  return {out.bytes().begin(), out.bytes().end()};
}

bool isOfStation(const record::RunLog& log) {
  return recordedValues(log.configuration()).hands.size() > static_cast<std::size_t>(log.configuration().table.hands);
}

namespace {

std::vector<GivenSample> readGiven(const record::RunLog& log, int& own) {
  std::vector<GivenSample> given;
  own = -1;
  record::LogReader reader(log.path());
  record::RecordView record;
  while (reader.goodEnd() < log.goodBytes() && reader.next(record)) {
    if (record.type != record::RecordType::PeerTicks) continue;
    for (const GivenSample& one : decodeGiven(record.payload, own)) given.push_back(one);
  }
  return given;
}

}  // namespace

int recordedStation(const record::RunLog& log) {
  int own = -1;
  (void)readGiven(log, own);
  return own + 1;
}

std::vector<GivenSample> givenSamples(const record::RunLog& log) {
  int own = -1;
  std::vector<GivenSample> given = readGiven(log, own);
  std::erase_if(given, [](const GivenSample& one) { return one.peer == GivenSample::kFrequency; });
  return given;
}

record::Replay replayStation(const record::RunLog& log, const LookAtCopy& look) {
  int own = -1;
  const std::vector<GivenSample> given = readGiven(log, own);
  if (own < 0)
    throw FaultError(Fault{{}, "holds nothing of the other stations, so the run cannot be simulated again", {}, FilePlace{log.path()}});
  CoupledCopy* copy = nullptr;
  std::size_t next = 0;
  record::ReplayHooks hooks;
  hooks.makeEngine = [&](const experiment::CompiledExperiment& experiment, const haptics::EngineOptions& options) {
    return makeStationEngine(experiment, own, options, copy);
  };
  hooks.afterTick = [&](const haptics::TickState& state) {
    if (look) look(state, *copy);
    copy->beginTick(nextTime(state));
    for (; next < given.size() && given[next].tick <= state.tick; ++next) {
      const GivenSample& one = given[next];
      if (one.peer == GivenSample::kFrequency) copy->setFrequency(one.roundTrip);
      if (one.peer >= 0 && one.peer < copy->peerCount()) copy->take(one.peer, one.sample, one.roundTrip);
    }
  };
  hooks.further = [&](double* columns) { fillLines(*copy, columns); };
  return record::replayRun(log, hooks);
}

std::unique_ptr<haptics::TickEngine> makeStationEngine(const experiment::CompiledExperiment& experiment, int own,
                                                       const haptics::EngineOptions& options, CoupledCopy*& copy) {
  experiment::Experiment e = experiment.experiment();
  dynamics::Scene scene = dynamics::compileScene(experiment);  // with all that it refuses
  auto plant = std::make_unique<CoupledCopy>(e, experiment.constraint(), own, copySettingsFor(e));
  copy = plant.get();
  e.object.fpOffset = e.hands.at(static_cast<std::size_t>(own)).fpOffset;
  scene.choice.form = fmt::format("copy of station {} of {}", own + 1, e.hands.size());
  scene.choice.reason = "stations move the object together: a full copy at each, rk4, one step a tick";
  scene.shared = nullptr;
  scene.plant = std::move(plant);
  return std::make_unique<haptics::TickEngine>(e, std::move(scene), options);
}

}  // namespace reachlab::network
