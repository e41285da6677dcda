#include <dds/dds.h>
#include <dds/ddsc/dds_statistics.h>
#include <dds/ddsrt/log.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "Reachlab.h"
#include "base/error.h"
#include "base/system/os.h"
#include "network/endpoint/message_limit.h"
#include "network/endpoint/peer_clock.h"
#include "network/endpoint/probe_loss.h"
#include "network/link/link_memory.h"

/// A station's endpoint: sends what the station puts into the rings, and puts into them what comes. It is a separate process,
/// because it allocates, encrypts and listens to the network. If it dies, the station loses its peers and nothing else.
namespace reachlab::network {
namespace {

static_assert(reach_stations == kMaxStations && reach_coordinates == kMaxCoordinates);
constexpr std::int64_t kProbeNs = 20'000'000;
constexpr std::int64_t kNapNs = 200'000, kNapPerPeerNs = 100'000;  // with many peers a round takes longer, and finds more

struct DdsError : ResourceError {
  using ResourceError::ResourceError;
};
using Statistics = std::unique_ptr<dds_statistics, decltype([](dds_statistics* statistics) { dds_delete_statistics(statistics); })>;
using Qos = std::unique_ptr<dds_qos_t, decltype([](dds_qos_t* qos) { dds_delete_qos(qos); })>;
dds_entity_t made(dds_entity_t entity, const char* what) {
  if (entity < 0) throw DdsError(fmt::format("{} cannot be made: {}", what, dds_strretcode(-entity)));
  return entity;
}

// Unicast beyond one network; multicast is left to the default where no peers are named.
std::string configurationOf(const EndpointSettings& settings) {
  std::string general, discovery, peers;
  for (const auto& peer : settings.peers) {
    if (peer[0] == 0) break;
    peers += fmt::format("<Peer address=\"{}\"/>", peer.data());
  }
  if (settings.interface[0] != 0)
    general += fmt::format("<Interfaces><NetworkInterface name=\"{}\"{}/></Interfaces>", settings.interface.data(),
                           peers.empty() ? "" : " multicast=\"false\"");
  if (!peers.empty()) {
    general += "<AllowMulticast>false</AllowMulticast>";
    discovery =
        fmt::format("<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex><Peers>{}</Peers>",
                    2 * kMaxStations, peers);
  }
  return fmt::format("<CycloneDDS><Domain id=\"any\"><General>{}</General><Discovery>{}</Discovery></Domain></CycloneDDS>", general,
                     discovery);
}

void addSecurity(dds_qos_t* qos, const std::string& folder) {
  const auto set = [&](const std::string& name, const std::string& value) { dds_qset_prop(qos, name.c_str(), value.c_str()); };
  const std::string libraries = REACHLAB_DDS_SECURITY;
  if (libraries.empty()) throw DdsError("Cyclone DDS has no security plugins here");
  struct Plugin {
    const char *key, *file, *function;
  };
  for (const Plugin& plugin :
       {Plugin{"auth", "auth", "authentication"}, Plugin{"crypto", "crypto", "crypto"}, Plugin{"access", "ac", "access_control"}}) {
    const std::string key = fmt::format("dds.sec.{}.library.", plugin.key);
    set(key + "path", fmt::format("{}/libdds_security_{}.so", libraries, plugin.file));
    set(key + "init", fmt::format("init_{}", plugin.function));
    set(key + "finalize", fmt::format("finalize_{}", plugin.function));
  }
  const auto file = [&](const char* name) {
    const std::string path = std::filesystem::absolute(folder).string() + "/" + name;
    if (!std::filesystem::exists(path)) throw DdsError(path + " is not there; reach peers makes it");
    return "file:" + path;
  };
  set("dds.sec.auth.identity_ca", file("identity_ca.pem"));
  set("dds.sec.auth.identity_certificate", file("identity.pem"));
  set("dds.sec.auth.private_key", file("key.pem"));
  set("dds.sec.access.permissions_ca", file("permissions_ca.pem"));
  set("dds.sec.access.governance", file("governance.p7s"));
  set("dds.sec.access.permissions", file("permissions.p7s"));
}

LinkMemory& mapMemory(const std::string& name) {
  const int descriptor = ::shm_open(name.c_str(), O_RDWR, 0);
  if (descriptor < 0) throw DdsError(fmt::format("the station's memory {} cannot be opened: {}", name, std::strerror(errno)));
  void* at = ::mmap(nullptr, sizeof(LinkMemory), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  ::close(descriptor);
  ::shm_unlink(name.c_str());  // both have it now, and nothing of it is left when they are killed
  if (at == MAP_FAILED) throw DdsError(fmt::format("the station's memory cannot be mapped: {}", std::strerror(errno)));
  auto& memory = *static_cast<LinkMemory*>(at);
  if (memory.version != LinkMemory::kVersion) throw DdsError("the station is of another version than its endpoint");
  return memory;
}

/// Topic, writer and reader of one kind of message.
template <class Message>
struct TopicEnds {
  dds_entity_t writer = 0, reader = 0;
  TopicEnds(dds_entity_t participant, const dds_topic_descriptor_t& type, const char* topic, const Qos& qos) {
    const dds_entity_t made = network::made(dds_create_topic(participant, &type, topic, nullptr, nullptr), topic);
    writer = network::made(dds_create_writer(participant, made, qos.get(), nullptr), "a writer");
    reader = network::made(dds_create_reader(participant, made, qos.get(), nullptr), "a reader");
  }
  template <class Take>
  void takeAll(Take&& take) {
    constexpr int kMost = 32;
    void* samples[kMost] = {};
    dds_sample_info_t infos[kMost];
    const dds_return_t count = dds_take(reader, samples, infos, kMost, kMost);
    for (int i = 0; i < count; ++i)
      if (infos[i].valid_data) take(*static_cast<const Message*>(samples[i]));
    if (count > 0) dds_return_loan(reader, samples, count);
  }
};

Qos makeQos(dds_reliability_kind_t reliability, dds_history_kind_t history, int depth) {
  Qos qos(dds_create_qos());
  dds_qset_reliability(qos.get(), reliability, reliability == DDS_RELIABILITY_RELIABLE ? DDS_MSECS(100) : 0);
  dds_qset_history(qos.get(), history, depth);
  return qos;
}
// A reader holds one instance for all: what several stations send between two rounds must fit.
Qos stateQos() { return makeQos(DDS_RELIABILITY_BEST_EFFORT, DDS_HISTORY_KEEP_LAST, 32); }
Qos cardQos() {
  Qos qos = makeQos(DDS_RELIABILITY_RELIABLE, DDS_HISTORY_KEEP_LAST, 16);
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);  // a card with the own number is then of another station
  return qos;
}
Qos eventQos() {
  Qos qos = makeQos(DDS_RELIABILITY_RELIABLE, DDS_HISTORY_KEEP_ALL, 0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
  return qos;
}

template <std::size_t N>
void copyText(const char* from, std::array<char, N>& to) {
  to.fill(0);
  if (from != nullptr) std::copy_n(from, std::min(std::strlen(from), N - 1), to.begin());
}

class Endpoint {
 public:
  Endpoint(LinkMemory& memory, dds_entity_t participant)
      : own_(memory.settings.card), memory_(memory), states_(participant, reach_State_desc, "reach_state", stateQos()),
        probes_(participant, reach_Probe_desc, "reach_probe", stateQos()),
        events_(participant, reach_Event_desc, "reach_event", eventQos()), cards_(participant, reach_Card_desc, "reach_station", cardQos()),
        statistics_(dds_create_statistics(states_.reader)) {}

  void run() {
    std::int64_t cardNs = 0, probeNs = 0;
    while (!memory_.stop.load(std::memory_order_acquire)) {
      const std::int64_t now = os::now();
      memory_.aliveNs.store(now, std::memory_order_release);
      receive();
      send();
      if (now - probeNs >= kProbeNs) {
        sendProbe();
        probeNs = now;
      }
      if (now - cardNs > 1'000'000'000) {
        sendCard();
        countDiscarded();
        cardNs = now;
      }
      os::sleepUntil(now + std::max(kNapNs, kNapPerPeerNs * peers_));
    }
    send();  // the last event
    constexpr std::int64_t kLastWords = 200'000'000;
    os::sleepUntil(os::now() + kLastWords);
  }

 private:
  bool isPeer(std::uint32_t station) const { return station >= 1 && station <= kMaxStations && station != own_.station; }

  void receive() {
    states_.takeAll([&](const reach_State& s) { hear(s); });
    probes_.takeAll([&](const reach_Probe& probe) {
      if (isPeer(probe.station)) losses_[probe.station - 1].add(probe.number);
    });
    events_.takeAll([&](const reach_Event& e) { hear(e); });
    cards_.takeAll([&](const reach_Card& c) { hear(c); });
  }

  void hear(const reach_State& s) {
    if (!isPeer(s.station)) return;
    const std::int64_t now = os::now();
    PeerClock& clock = clocks_[s.station - 1];
    if (clock.echoHeard == 0) ++peers_;
    const auto ours = static_cast<std::size_t>(own_.station) - 1;
    clock.add(own_.station == 0 ? Echo{s.seq, s.sent_ns} : Echo{s.seq, s.sent_ns, s.echo_sent_ns[ours], s.echo_heard_ns[ours]}, now);
    const ProbeLoss& probes = losses_[s.station - 1];
    const double loss = probes.share();
    LinkStatus& status = memory_.status[s.station - 1];
    status.roundTrip.store(clock.roundTrip), status.jitter.store(clock.jitter), status.offset.store(clock.offset);
    status.loss.store(loss), status.lossBound.store(probes.bound()), status.overtaken.store(std::max(0.0, clock.missing - loss)),
        status.gap.store(clock.gap), status.heardNs.store(now);
    if (clock.roundTrip < 0 && own_.station != 0) return;  // its time means nothing here yet
    HeardState heard;
    heard.trial = s.trial;
    heard.phase = s.phase;
    heard.roundTrip = clock.roundTrip;
    CopySample& sample = heard.sample;
    sample.sequence = s.seq;
    sample.time = own_.station == 0 ? seconds(now) : seconds(s.time_ns) - clock.offset;  // nobody answers an observer
    sample.hand = {s.hand[0], s.hand[1], s.hand[2]};
    sample.handVelocity = {s.hand_velocity[0], s.hand_velocity[1], s.hand_velocity[2]};
    sample.work = s.work;
    std::copy_n(s.places._buffer, std::min<std::size_t>(s.places._length, kMaxCoordinates), sample.places.begin());
    std::copy_n(s.rates._buffer, std::min<std::size_t>(s.rates._length, kMaxCoordinates), sample.rates.begin());
    if (!memory_.in[s.station - 1].tryPush(heard)) memory_.ringsFull.fetch_add(1);
  }

  void hear(const reach_Event& e) {
    if (!isPeer(e.station) || e.kind > static_cast<std::uint8_t>(LinkEvent::Kind::Finish)) return;
    LinkEvent event{e.station,
                    static_cast<LinkEvent::Kind>(e.kind),
                    e.trial,
                    {e.index, e.foreperiod_ticks, e.catch_trial != 0},
                    e.frequency,
                    static_cast<trial::Outcome>(std::min<int>(e.outcome, static_cast<int>(trial::Outcome::Interrupted))),
                    static_cast<trial::Reason>(std::min<int>(e.reason, static_cast<int>(trial::kLastReason))),
                    e.apart};
    if (!memory_.eventsIn.tryPush(event)) memory_.ringsFull.fetch_add(1);
  }

  void hear(const reach_Card& c) {
    if (!isPeer(c.station) && c.station != own_.station) return;
    StationCard card;
    card.station = c.station, card.version = c.version, card.experiment = c.experiment, card.conductor = c.conductor != 0;
    copyText(c.name, card.name), copyText(c.software, card.software), copyText(c.device, card.device);
    (void)memory_.cardsIn.tryPush(card);
  }

  void send() {
    OwnState own;
    while (memory_.out.tryPop(own)) {
      reach_State& s = outgoing_;
      s.station = own_.station;
      s.seq = own.sample.sequence;
      s.time_ns = own.timeNs;
      s.trial = own.trial;
      s.phase = own.phase;
      CopySample& sample = own.sample;
      s.hand[0] = sample.hand.x, s.hand[1] = sample.hand.y, s.hand[2] = sample.hand.z;
      s.hand_velocity[0] = sample.handVelocity.x, s.hand_velocity[1] = sample.handVelocity.y, s.hand_velocity[2] = sample.handVelocity.z;
      s.work = sample.work;
      const auto of = [](std::array<double, kMaxCoordinates>& numbers, std::uint32_t count) {
        return dds_sequence_double{kMaxCoordinates, std::min<std::uint32_t>(count, kMaxCoordinates), numbers.data(), false};
      };
      s.places = of(sample.places, own.places), s.rates = of(sample.rates, own.rates);
      for (std::size_t i = 0; i < kMaxStations; ++i) s.echo_sent_ns[i] = clocks_[i].echoSent, s.echo_heard_ns[i] = clocks_[i].echoHeard;
      s.sent_ns = os::now();
      dds_write(states_.writer, &s);
    }
    LinkEvent event;
    while (memory_.eventsOut.tryPop(event)) {
      reach_Event e{};
      e.station = own_.station, e.kind = static_cast<std::uint8_t>(event.kind), e.trial = event.trial;
      e.index = event.planned.index, e.foreperiod_ticks = event.planned.foreperiodTicks, e.catch_trial = event.planned.catchTrial;
      e.frequency = event.frequency;
      e.outcome = static_cast<std::uint8_t>(event.outcome), e.reason = static_cast<std::uint8_t>(event.reason), e.apart = event.apart;
      dds_write(events_.writer, &e);
    }
  }

  // What came twice, or long after its time, and was dropped before anybody saw it.
  void countDiscarded() {
    if (!statistics_ || dds_refresh_statistics(statistics_.get()) != DDS_RETCODE_OK) return;
    if (const dds_stat_keyvalue* bytes = dds_lookup_statistic(statistics_.get(), "discarded_bytes"))
      memory_.discardedBytes.store(bytes->u.u64);
  }

  void sendProbe() {
    if (own_.station == 0) return;
    const reach_Probe probe{own_.station, ++probe_};
    dds_write(probes_.writer, &probe);
  }

  void sendCard() {
    if (own_.station == 0) return;  // an observer is nobody's peer
    reach_Card card{};
    card.station = own_.station, card.version = LinkMemory::kVersion, card.experiment = own_.experiment, card.conductor = own_.conductor;
    std::copy(own_.name.begin(), own_.name.end(), std::begin(card.name));
    std::copy(own_.software.begin(), own_.software.end(), std::begin(card.software));
    std::copy(own_.device.begin(), own_.device.end(), std::begin(card.device));
    dds_write(cards_.writer, &card);
  }

  StationCard own_;
  LinkMemory& memory_;
  TopicEnds<reach_State> states_;
  TopicEnds<reach_Probe> probes_;
  TopicEnds<reach_Event> events_;
  TopicEnds<reach_Card> cards_;
  Statistics statistics_;  // of the states' reader; null where there are none
  std::array<PeerClock, kMaxStations> clocks_;
  std::array<ProbeLoss, kMaxStations> losses_;
  std::uint32_t probe_ = 0;
  std::int64_t peers_ = 0;  // heard so far
  reach_State outgoing_{};
};

/// What Cyclone DDS has to say goes to standard error, but no more of it than somebody can read: whoever sends rubbish to the port makes it
/// say something of every packet.
class LimitedMessages {
 public:
  LimitedMessages() { dds_set_log_sink(&LimitedMessages::take, this); }
  ~LimitedMessages() {
    dds_set_log_sink(nullptr, nullptr);
    tell(limit_.takeHeld());
  }
  LimitedMessages(const LimitedMessages&) = delete;
  LimitedMessages& operator=(const LimitedMessages&) = delete;

 private:
  static void tell(std::uint64_t held) {
    if (held > 0) fmt::print(stderr, "endpoint: {} more messages about the network were not printed\n", held);
  }
  static void take(void* self, const dds_log_data_t* said) {
    auto& messages = *static_cast<LimitedMessages*>(self);
    const std::lock_guard lock(messages.mutex_);
    const std::optional<std::uint64_t> held = messages.limit_.admit(seconds(os::now()));
    if (!held) return;
    tell(*held);
    std::fwrite(said->message - said->hdrsize, 1, said->hdrsize + said->size, stderr);
  }
  std::mutex mutex_;
  MessageLimit limit_;
};

void run(const std::string& memoryName) {
  LinkMemory& memory = mapMemory(memoryName);
  const EndpointSettings settings = memory.settings;
  // Below the haptic thread, above what else the computer does; the threads of Cyclone DDS inherit it. Where it is not allowed the link is as
  // late as the computer is busy.
  constexpr int kPriority = 40;
  (void)os::requestRealTime(kPriority);
  os::requestExactSleep();
  const auto domain = static_cast<dds_domainid_t>(settings.domain);
  LimitedMessages messages;
  // Ends all threads of Cyclone DDS, on every way out: what they use (OpenSSL) is taken down behind main.
  const std::shared_ptr<void> threads(nullptr, [](void*) { dds_delete(DDS_CYCLONEDDS_HANDLE); });
  made(dds_create_domain(domain, configurationOf(settings).c_str()), "the domain");
  const Qos qos(dds_create_qos());
  if (settings.secure[0] != 0) addSecurity(qos.get(), settings.secure.data());
  const dds_entity_t participant = made(dds_create_participant(domain, qos.get(), nullptr), "the participant");
  Endpoint endpoint(memory, participant);
  endpoint.run();
}

}  // namespace
}  // namespace reachlab::network

/// The one argument is the name of the memory that the station has made.
int main(int argc, char** argv) {
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);  // no endpoint without its station
  if (argc != 2) {
    fmt::print(stderr, "endpoint: this program is started by a station\n");
    return 2;
  }
  try {
    reachlab::network::run(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "endpoint: {}\n", error.what());
    return 3;
  }
  return 0;
}
