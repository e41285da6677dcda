#include "sim/record/log/recorder.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <thread>

#include "base/error.h"
#include "base/system/error_report.h"
#include "base/system/os.h"
#include "sim/record/log/run_writer.h"

namespace reachlab::record {
namespace {

constexpr std::uint32_t kPictureTicks = 10;           // a picture shows no more than 60 states a second
constexpr auto kNap = std::chrono::milliseconds(10);  // the recorder looks at its queue this often

}  // namespace

struct Recorder::Impl {
  Impl(const std::string& path, const RunConfiguration& configuration, const RecorderOptions& recorderOptions)
      : options(recorderOptions), table(configuration.table), every(std::max(1u, configuration.sampleEveryTicks)),
        firstTrial(configuration.firstTrial), sceneColumns(rowWidth(table)),
        writer(path, configuration, options.diskReserve, options.threaded ? RunWriter::CutBy::Clock : RunWriter::CutBy::Ticks),
        ring(options.threaded ? options.queueTicks : 1, options.threaded ? options.queueTicks / every + 2 : 1, table.size(),
             static_cast<std::size_t>(table.hands)) {}

  RecorderOptions options;
  ChannelTable table;
  std::uint32_t every;
  int firstTrial;
  std::size_t sceneColumns;
  std::int64_t startNs = 0;  // haptic thread: clock at the first tick
  bool anyTick = false;

  mutable std::mutex mutex;  // guards what follows; the haptic thread never takes it
  std::condition_variable changed;
  RunWriter writer;
  std::string fault;
  int finishedTrial = 0;
  bool closed = false;

  TickRing ring;
  std::atomic<double> processorSeconds{0};
  std::jthread thread;

  // With the mutex held.
  void drain() {
    const double* row = nullptr;
    while (const QueuedTick* tick = ring.front(row)) {
      if (fault.empty())
        guarded([&] {
          if (writer.add(*tick, ring.devicesOf(tick), row)) finishedTrial = writer.lastTrial().trial;
        });
      ring.pop(tick->hasRow);
    }
    if (fault.empty()) guarded([this] { writer.flushIfDue(); });
  }

  // Behind the ticks so far.
  template <typename Work>
  void inOrder(Work&& work) {
    const std::scoped_lock lock(mutex);
    throwIfFaulty();
    drain();
    guarded(work);
    throwIfFaulty();
  }
  template <typename Work>
  void guarded(Work&& work) {
    try {
      work();
    } catch (const std::exception& error) {
      fault = errorReportOf(error).sentence;
    }
  }
  void throwIfFaulty() const {
    if (!fault.empty()) throw ResourceError(fault);
  }

  void record(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      {
        const std::scoped_lock lock(mutex);
        drain();
      }
      changed.notify_all();
      processorSeconds = static_cast<double>(os::threadProcessorTime()) * 1e-9;
      std::this_thread::sleep_for(kNap);
    }
  }
};

Recorder::Recorder(const std::string& path, const RunConfiguration& configuration, const RecorderOptions& options)
    : impl_(std::make_unique<Impl>(path, configuration, options)) {
  if (options.threaded) impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& stop) { impl->record(stop); });
}

Recorder::~Recorder() {
  try {
    close();
  } catch (const Error&) {  // the owner has had the chance to hear of it from close()
  }
}

bool Recorder::onTick(const haptics::TickState& state, trial::Command command, std::uint32_t missedTicks) noexcept {
  Impl& impl = *impl_;
  if (!impl.anyTick) impl.startNs = state.measuredNs;
  impl.anyTick = true;
  double* rowSpace = nullptr;
  QueuedTick* slot = impl.ring.beginPush(rowSpace);
  if (slot == nullptr) return false;
  const bool due = state.tick % impl.every == 0;
  slot->stamp = {state.tick, state.measuredNs, command, missedTicks};
  slot->facts = factsOf(state);
  const auto devices = impl.ring.deviceSpace(slot);
  for (std::size_t i = 0; i < devices.size(); ++i) devices[i] = state.hands[i].device;
  slot->hasRow = due && rowSpace != nullptr;
  if (slot->hasRow) {
    fillRow(impl.table, state, rowSpace);
    numberTrial(impl.table, impl.firstTrial, rowSpace);
    if (impl.options.further != nullptr && impl.table.size() > impl.sceneColumns) impl.options.further->fill(rowSpace + impl.sceneColumns);
    rowSpace[1] = static_cast<double>(state.measuredNs - impl.startNs) * 1e-9;
  }
  impl.ring.publish(slot->hasRow);
  if (!impl.options.threaded) {
    // The virtual clock waits for the disk; no other thread writes, so the lock is free.
    const std::scoped_lock lock(impl.mutex);
    impl.drain();
  }
  return !due || slot->hasRow;
}

std::uint32_t Recorder::massesEvery() const noexcept { return std::gcd(impl_->every, kPictureTicks); }

void Recorder::announce(std::int32_t trial, const trial::PlannedTrial& planned) {
  const TrialSetup setup{trial + impl_->firstTrial - 1, planned};
  impl_->inOrder([&] { impl_->writer.announce(setup); });
}

void Recorder::awaitTrial(std::int32_t trial) {
  trial += impl_->firstTrial - 1;
  std::unique_lock lock(impl_->mutex);
  if (!impl_->options.threaded) impl_->drain();
  impl_->changed.wait(lock, [&] { return impl_->finishedTrial >= trial || !impl_->fault.empty() || !impl_->options.threaded; });
  impl_->throwIfFaulty();
}

RecordedTrial Recorder::lastTrial() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->writer.lastTrial();
}

void Recorder::note(const std::string& text) {
  impl_->inOrder([&] { impl_->writer.note(text); });
}

void Recorder::add(const std::vector<RecordedEvent>& events) {
  if (!events.empty()) impl_->inOrder([&] { impl_->writer.add(events); });
}

void Recorder::append(RecordType type, std::span<const std::uint8_t> payload) {
  const std::scoped_lock lock(impl_->mutex);
  impl_->throwIfFaulty();
  impl_->guarded([&] { impl_->writer.append(type, payload); });
  impl_->throwIfFaulty();
}

void Recorder::close() {
  if (impl_->thread.joinable()) {
    impl_->thread.request_stop();
    impl_->thread.join();
  }
  const std::scoped_lock lock(impl_->mutex);
  if (impl_->closed) return;
  impl_->closed = true;
  impl_->drain();
  if (impl_->fault.empty()) impl_->guarded([this] { impl_->writer.close(); });
  impl_->throwIfFaulty();
}

std::string Recorder::fault() const {
  const std::scoped_lock lock(impl_->mutex);
  return impl_->fault;
}

double Recorder::processorSeconds() const { return impl_->processorSeconds; }

}  // namespace reachlab::record
