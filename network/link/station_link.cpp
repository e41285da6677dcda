#include "network/link/station_link.h"

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
#include "sim/experiment/experiment.h"

extern char** environ;

namespace reachlab::network {
namespace {

constexpr double kMostRoundTrip = 0.12, kMostGap = 0.05;  // [s]: beyond them the coupling is not known to be stable
constexpr double kMostLoss = 0.2;                         // share
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
  card.version = LinkMemory::kVersion;
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

}  // namespace

std::uint64_t sharedHash(const experiment::Experiment& experiment) { return hashOf(experiment::toJson(experiment)); }

StationLink::StationLink(const StationOptions& options, std::uint64_t experiment)
    : options_(options), experiment_(experiment), memoryName_(fmt::format("/reachlab-{}-{}", ::getpid(), options.station)) {
  EndpointSettings settings;
  fillSettings(options, experiment, settings);
  const int descriptor = ::shm_open(memoryName_.c_str(), O_RDWR | O_CREAT | O_EXCL, 0600);
  if (descriptor < 0) throw ResourceError(fmt::format("memory to share with the endpoint cannot be had: {}", std::strerror(errno)));
  void* at = ::ftruncate(descriptor, sizeof(LinkMemory)) == 0
                 ? ::mmap(nullptr, sizeof(LinkMemory), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0)
                 : MAP_FAILED;
  ::close(descriptor);
  if (at == MAP_FAILED) {
    ::shm_unlink(memoryName_.c_str());
    throw ResourceError(fmt::format("memory to share with the endpoint cannot be had: {}", std::strerror(errno)));
  }
  memory_ = new (at) LinkMemory;
  memory_->settings = settings;
  std::string program = options.endpoint, name = memoryName_;
  std::array<char*, 3> arguments{program.data(), name.data(), nullptr};
  pid_t process = -1;
  // The endpoint gets a process group of its own. Otherwise Ctrl-C in a terminal would end it before it has told the
  // other stations that this one ends.
  posix_spawnattr_t apart;
  ::posix_spawnattr_init(&apart);
  ::posix_spawnattr_setflags(&apart, POSIX_SPAWN_SETPGROUP);
  const int failed = ::posix_spawn(&process, options.endpoint.c_str(), nullptr, &apart, arguments.data(), environ);
  ::posix_spawnattr_destroy(&apart);
  if (failed != 0) {
    ::shm_unlink(memoryName_.c_str());
    throw ResourceError(fmt::format("the endpoint {} cannot be started: {}", options.endpoint, std::strerror(failed)));
  }
  process_ = process;
}

StationLink::~StationLink() {
  (void)finish();
  ::munmap(memory_, sizeof(LinkMemory));
  ::shm_unlink(memoryName_.c_str());
}

std::string StationLink::finish() {
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

void StationLink::send(const LinkEvent& event) {
  LinkEvent own = event;
  own.station = static_cast<std::uint32_t>(options_.station);
  if (!memory_->eventsOut.tryPush(own)) throw ResourceError("the endpoint takes no messages any more");
}

void StationLink::look() {
  StationCard card;
  while (memory_->cardsIn.tryPop(card)) {
    if (card.station < 1 || card.station > kMaxStations) continue;
    cards_[card.station - 1] = card;
    cardNs_[card.station - 1] = os::now();
  }
  const std::int64_t now = os::now();
  for (std::size_t i = 0; i < kMaxStations; ++i) {
    const LinkStatus& link = memory_->status[i];
    Offset& known = offsets_[i];
    if (link.roundTrip.load() < 0 || now - link.heardNs.load() > kHeardNs) {
      known = {};
      continue;
    }
    const double offset = link.offset.load();
    if (known.sinceNs == 0) known.sinceNs = now;
    else if (now - known.sinceNs > kSettledNs && std::abs(offset - known.value) > kMostJump)
      known.jump = offset - known.value, known.jumpNs = now;
    known.value = offset;
  }
}

bool StationLink::endpointAlive() const {
  constexpr std::int64_t kSilentNs = 1'000'000'000;
  const std::int64_t alive = memory_->aliveNs.load(std::memory_order_acquire);
  return endpointFault().empty() && (alive == 0 || os::now() - alive < kSilentNs);
}

double StationLink::conductorSilence() const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < kMaxStations; ++i)
    if (cardNs_[i] != 0 && cards_[i].conductor) least = std::min(least, static_cast<double>(os::now() - cardNs_[i]) * 1e-9);
  return least;
}

std::string StationLink::endpointFault() const {
  if (process_ <= 0) return {};
  siginfo_t ended{};
  if (::waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 || ended.si_pid == 0) return {};
  if (ended.si_code == CLD_EXITED) return fmt::format("this station's endpoint has ended with exit code {}", ended.si_status);
  return fmt::format("this station's endpoint was ended by signal {}", ended.si_status);
}

std::vector<std::string> StationLink::obstacles() const {
  std::vector<std::string> found;
  if (const std::string fault = endpointFault(); !fault.empty()) found.push_back(fault);
  else if (!endpointAlive()) found.push_back("this station's endpoint has not done a round for a second");
  for (const StationStatus& other : statuses())
    for (const std::string& what : other.obstacles) found.push_back(fmt::format("station {}: {}", other.station, what));
  return found;
}

std::vector<StationStatus> StationLink::statuses() const {
  std::vector<StationStatus> all;
  for (int station = 1; station <= options_.stations; ++station)
    if (station != options_.station) all.push_back(statusOf(station));
  return all;
}

StationStatus StationLink::statusOf(int station) const {
  using Light = StationStatus::Light;
  const std::int64_t now = os::now();
  const auto index = static_cast<std::size_t>(station - 1);
  const StationCard& card = cards_[index];
  const LinkStatus& link = memory_->status[index];
  StationStatus s;
  s.station = station;
  if (cardNs_[index] != 0)
    s.name = card.name.data(), s.software = card.software.data(), s.device = card.device.data(), s.conductor = card.conductor;
  if (cardNs_[index] == 0 || now - cardNs_[index] > kPresentNs) {
    const bool twice = options_.station > 0 && cardNs_[static_cast<std::size_t>(options_.station - 1)] != 0;
    s.obstacles.push_back(twice ? fmt::format("is not there, and another station has this one's number, {}", options_.station)
                                : "is not there");
    return s;
  }
  const auto say = [&](const std::string& what) { s.obstacles.push_back(what); };
  if (card.version != LinkMemory::kVersion)
    say(fmt::format("speaks version {} of the messages, and this one {}", card.version, LinkMemory::kVersion));
  if (options_.software != s.software) say(fmt::format("runs {}, and this one {}", s.software, options_.software));
  if (card.experiment != experiment_) say(fmt::format("has another experiment ({:016x}, here {:016x})", card.experiment, experiment_));
  if (card.conductor && options_.conductor) say("is a conductor too");
  s.roundTrip = link.roundTrip.load(), s.jitter = link.jitter.load(), s.loss = link.loss.load(), s.lossBound = link.lossBound.load(),
  s.overtaken = link.overtaken.load(), s.offset = link.offset.load();
  const std::int64_t silentNs = std::max<std::int64_t>(now - link.heardNs.load(), 0);
  const double gap = link.gap.load();
  const bool observes = options_.station == 0;  // nobody answers it: there is no round trip
  s.heard = silentNs <= kHeardNs && (s.roundTrip >= 0 || observes);
  s.age = static_cast<double>(silentNs) * 1e-9;
  if (!s.heard) {
    say("sends nothing");
    s.light = Light::Stop;
    return s;
  }
  if (s.roundTrip > kMostRoundTrip)
    say(fmt::format("a round trip takes {:.0f} ms; allowed: up to {:.0f}", 1e3 * s.roundTrip, 1e3 * kMostRoundTrip));
  // Overtaken samples are dropped by design, so their share says nothing; what is lost and how long nothing comes does.
  // A sentence without the bound stays the same while the bound falls, and is printed once.
  if (s.loss > kMostLoss) say(fmt::format("{:.0f} % of what it sends is lost; allowed: up to {:.0f}", 100 * s.loss, 100 * kMostLoss));
  else if (s.lossBound > kMostLoss)
    say(fmt::format("how much of what it sends is lost is not known well enough yet; allowed: up to {:.0f} %", 100 * kMostLoss));
  if (gap > kMostGap) say(fmt::format("nothing comes for {:.0f} ms at a time; allowed: up to {:.0f}", 1e3 * gap, 1e3 * kMostGap));
  if (offsets_[index].jumpNs != 0 && now - offsets_[index].jumpNs < kJumpNs)
    say(fmt::format("its clock jumped by {:.1f} ms against this one's; allowed: up to {:.0f}", 1e3 * offsets_[index].jump,
                    1e3 * kMostJump));
  s.light = !s.obstacles.empty()                                                                     ? Light::Stop
            : s.roundTrip > 0.5 * kMostRoundTrip || gap > 0.5 * kMostGap || s.loss > 0.5 * kMostLoss ? Light::Fair
                                                                                                     : Light::Good;
  return s;
}

std::optional<bool> StationLink::isConductor(std::uint32_t station) const {
  if (station < 1 || station > kMaxStations || cardNs_[station - 1] == 0) return std::nullopt;
  return cards_[station - 1].conductor;
}

std::string StationLink::describe() const {
  std::string text;
  for (const StationCard& card : cards_) {
    if (card.station == 0 || static_cast<int>(card.station) == options_.station) continue;
    const LinkStatus& link = memory_->status[card.station - 1];
    text +=
        fmt::format("station {} ({}, {}{}): round trip {:.2f} ms, jitter {:.2f} ms, loss {:.1f} %, overtaken {:.1f} %, clock {:+.6f} s\n",
                    card.station, card.name.data(), card.device.data(), card.conductor ? ", conductor" : "", 1e3 * link.roundTrip.load(),
                    1e3 * link.jitter.load(), 100 * link.loss.load(), 100 * link.overtaken.load(), link.offset.load());
  }
  return text;
}

}  // namespace reachlab::network
