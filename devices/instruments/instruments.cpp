#include "devices/instruments/instruments.h"

#include <fmt/format.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/system/os.h"
#include "base/ticks.h"
#include "sim/record/log/tick_ring.h"

namespace reachlab::devices {
namespace {

constexpr std::int64_t kLookEvery = 200'000;      // [ns]
constexpr std::size_t kQueueTicks = 4096;         // that the instruments may be behind
constexpr int kPriority = 40;                     // below the haptic thread's; without the right to it, as any thread
constexpr std::int64_t kLastTicks = 500'000'000;  // [ns] for the last ticks of a run

class Link final : public record::InstrumentLink {
 public:
  explicit Link(std::vector<std::unique_ptr<Instrument>> instruments)
      : instruments_(std::move(instruments)), present_(instruments_.size(), true) {
    for (const auto& instrument : instruments_) names_ += (names_.empty() ? "" : "; ") + instrument->name();
  }
  ~Link() override { close(); }

  std::string names() const override { return names_; }

  void begin(const record::RunConfiguration& configuration) override {
    close();
    ring_ = std::make_unique<record::TickRing>(kQueueTicks, 0, 0, 0);
    tracker_.emplace(configuration.firstTrial);
    firstTrial_ = configuration.firstTrial;
    pushed_ = taken_ = 0;
    lost_ = 0;
    running_ = true;
    thread_ = std::jthread([this, configuration](const std::stop_token& stop) { run(configuration, stop); });
  }

  bool onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept override {
    if (!running_.load(std::memory_order_relaxed)) return true;
    double* noRow = nullptr;
    record::QueuedTick* slot = ring_->beginPush(noRow);
    if (slot == nullptr) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slot->stamp = {state.tick, state.measuredNs, command, missedTicks};
    slot->facts = record::factsOf(state);
    slot->hasRow = false;
    ring_->publish(false);
    pushed_.fetch_add(1, std::memory_order_relaxed);
    return true;
  }

  std::uint32_t massesEvery() const noexcept override { return 0; }

  void announce(std::int32_t trial, const trial::PlannedTrial& planned) override {
    const std::scoped_lock lock(mutex_);
    setups_.push_back({trial + firstTrial_ - 1, planned});
  }
  void awaitTrial(std::int32_t) override { awaitQueue(); }

  void close() override {
    if (!thread_.joinable()) return;
    awaitQueue();
    running_ = false;
    thread_.request_stop();
    thread_.join();
    if (const std::uint64_t lost = lost_.load(); lost > 0) {
      const std::scoped_lock lock(mutex_);
      warnings_.push_back(fmt::format("instruments: {} ticks were not passed on, because they took too long", lost));
    }
  }

  std::vector<record::RecordedEvent> takeEvents() override {
    const std::scoped_lock lock(mutex_);
    return std::exchange(events_, {});
  }
  std::vector<std::string> takeWarnings() override {
    const std::scoped_lock lock(mutex_);
    return std::exchange(warnings_, {});
  }

 private:
  // Until what was pushed has been handled; not for ever.
  void awaitQueue() const {
    const std::uint64_t pushed = pushed_.load();
    for (const std::int64_t until = os::now() + kLastTicks; taken_.load() < pushed && os::now() < until;)
      os::sleepUntil(os::now() + kLookEvery);
  }

  // From here on: the I/O thread.
  void run(const record::RunConfiguration& configuration, const std::stop_token& stop) {
    (void)os::requestRealTime(kPriority);
    os::requestExactSleep();
    eachPresent([&](Instrument& instrument, std::vector<InstrumentNote>& notes) { instrument.begin(configuration, notes); });
    while (!stop.stop_requested()) {
      drain();
      const std::int64_t now = os::now();
      eachPresent([&](Instrument& instrument, std::vector<InstrumentNote>& notes) { instrument.look(now, notes); });
      os::sleepUntil(now + kLookEvery);
    }
    drain();
    eachPresent([](Instrument& instrument, std::vector<InstrumentNote>& notes) { instrument.end(notes); });
  }

  void drain() {
    const double* row = nullptr;
    while (const record::QueuedTick* tick = ring_->front(row)) {
      handle(*tick);
      ring_->pop(false);
      taken_.fetch_add(1);
    }
  }

  // Of the trial that begins, not of one that was announced since: the tracker forgets the others.
  void takeSetups(int trial) {
    const std::scoped_lock lock(mutex_);
    std::erase_if(setups_, [&](const record::TrialSetup& setup) {
      if (setup.trial > trial) return false;
      tracker_->announce(setup);
      return true;
    });
  }

  void handle(const record::QueuedTick& tick) {
    if (tick.facts.phase == trial::Phase::Waiting) takeSetups(tick.facts.trial + firstTrial_ - 1);  // its own came before its first tick
    tick_ = tick.stamp.tick;
    tickNs_ = tick.stamp.measuredNs;
    const HandAtTick hand{tick.stamp.measuredNs, tick.facts.hip.position, tick.facts.hip.velocity};
    eachPresent([&](Instrument& instrument, std::vector<InstrumentNote>&) { instrument.hand(hand); });
    found_.clear();
    tracker_->add(tick.stamp, tick.facts, found_);
    for (const record::RecordedEvent& event : found_)
      if (const std::optional<Mark> mark = markOf(event)) sendAll({*mark, event.trial, tick.stamp.measuredNs});
  }

  static std::optional<Mark> markOf(const record::RecordedEvent& event) {
    if (event.kind == record::EventKind::Go) return Mark::Go;
    if (event.kind == record::EventKind::Onset) return Mark::Onset;
    if (event.kind == record::EventKind::TrialEnd)
      return event.value == static_cast<double>(trial::Outcome::Success) ? Mark::Success : Mark::End;
    return std::nullopt;
  }

  void sendAll(const Marker& marker) {
    eachPresent([&](Instrument& instrument, std::vector<InstrumentNote>&) {
      if (!instrument.send(marker)) return;
      const double offset = static_cast<double>(os::now() - marker.ns) * 1e-9;
      keep({tick_, record::EventKind::Instrument, marker.trial, offset, instrument.name() + " out " + nameOf(marker.mark)});
    });
  }

  template <typename Work>
  void eachPresent(const Work& work) {
    for (std::size_t i = 0; i < instruments_.size(); ++i) {
      if (!present_[i]) continue;
      Instrument& instrument = *instruments_[i];
      notes_.clear();
      try {
        work(instrument, notes_);
      } catch (const Error& error) {
        present_[i] = false;
        keep({tick_, record::EventKind::Instrument, trialNow(), 0, instrument.name() + " lost: " + error.what()});
        const std::scoped_lock lock(mutex_);
        warnings_.push_back(fmt::format("instrument {} is lost: {}; what follows is recorded without it", instrument.name(), error.what()));
      }
      // A note's tick is the last one before it; the value of an input is what came in, and its offset from the tick stands in the text.
      for (const InstrumentNote& note : notes_)
        keep({tick_, record::EventKind::Instrument, trialNow(), note.value,
              fmt::format("{} {} at {:+.6f} s", instrument.name(), note.text,
                          tickNs_ == 0 ? 0.0 : static_cast<double>(note.ns - tickNs_) * 1e-9)});
    }
  }

  int trialNow() const { return tracker_ && tracker_->underWay() ? tracker_->trial().trial : 0; }
  void keep(record::RecordedEvent event) {
    const std::scoped_lock lock(mutex_);
    events_.push_back(std::move(event));
  }

  std::vector<std::unique_ptr<Instrument>> instruments_;
  std::vector<bool> present_;
  std::string names_;
  std::unique_ptr<record::TickRing> ring_;
  std::optional<record::TrialTracker> tracker_;
  int firstTrial_ = 1;
  std::atomic<bool> running_{false};
  std::atomic<std::uint64_t> pushed_{0}, taken_{0}, lost_{0};
  std::uint64_t tick_ = 0;  // the I/O thread's last
  std::int64_t tickNs_ = 0;
  std::vector<record::RecordedEvent> found_;
  std::vector<InstrumentNote> notes_;
  std::mutex mutex_;  // guards what follows; the haptic thread never takes it
  std::vector<record::TrialSetup> setups_;
  std::vector<record::RecordedEvent> events_;
  std::vector<std::string> warnings_;
  std::jthread thread_;  // last: it ends before what it uses
};

}  // namespace

std::unique_ptr<record::InstrumentLink> linkInstruments(std::vector<std::unique_ptr<Instrument>> instruments) {
  return std::make_unique<Link>(std::move(instruments));
}

}  // namespace reachlab::devices
