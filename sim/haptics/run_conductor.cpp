#include "sim/haptics/run_conductor.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/error.h"

namespace reachlab::haptics {
namespace {

constexpr auto kLook = std::chrono::milliseconds(2);  // how often a waiting caller looks at the newest state

}  // namespace

RunConductor::RunConductor(std::unique_ptr<TickEngine> engine, std::unique_ptr<HapticDevice>&& device,
                           std::vector<trial::PlannedTrial> trials, const LoopOptions& options)
    : device_(std::move(device)), engine_(std::move(engine)), options_(options), trials_(std::move(trials)), planned_(trials_.size()),
      first_(std::make_unique<TickState>(engine_->state())), latest_(first_.get()) {}

RunConductor::RunConductor(const experiment::CompiledExperiment& experiment, std::unique_ptr<HapticDevice> device,
                           std::vector<trial::PlannedTrial> trials, const LoopOptions& options)
    : RunConductor(std::make_unique<TickEngine>(experiment, engineOptions(*device)), std::move(device), std::move(trials), options) {}

RunConductor::~RunConductor() {
  if (loop_) loop_->stop();
}

void RunConductor::start(RunSink* sink) {
  sink_ = sink;
  loop_ = std::make_unique<HapticLoop>(std::move(engine_), device_, sink, options_);
  loop_->start();
}

bool RunConductor::putUpNext() {
  if (underWay_ || next_ == trials_.size()) return false;
  const trial::PlannedTrial& planned = trials_[next_];
  device_->prepareTrial(planned.index, planned.scene);
  if (sink_ != nullptr) sink_->announce(trial_ + 1, planned);
  if (!loop_->tryCommand(trial::Command::NextTrial, planned)) return false;
  ++trial_;
  ++next_;
  underWay_ = true;
  return true;
}

bool RunConductor::takeBackAppended() {
  if (trials_.size() <= std::max(planned_, next_)) return false;
  trials_.pop_back();
  return true;
}

void RunConductor::advanceUntilDone(const std::atomic<bool>* stop) {
  const TickState& state = loop_->engine().state();
  bool asked = false;
  while (state.trial != trial_ || state.phase != trial::Phase::Done) {
    if (stop != nullptr && *stop && !asked) {
      interrupt();
      asked = true;
    }
    loop_->advance();
  }
}

std::optional<ConductedTrial> RunConductor::poll() {
  if (options_.virtualClock && underWay_) {
    advanceUntilDone(nullptr);
    loop_->advance();  // one tick in Done, whoever conducts: the same recording
  }
  if (loop_->hangs() && underWay_) loop_->endWithoutDevice();
  if (const TickState* newer = loop_->takeLatest()) latest_ = newer;
  if (loop_->hangs() && !underWay_) throw ResourceError(describe(loop_->fault(), device_->info().name));
  if (!underWay_ || latest_->trial != trial_ || latest_->phase != trial::Phase::Done) return std::nullopt;
  underWay_ = false;
  if (sink_ != nullptr) sink_->awaitTrial(trial_);
  return ConductedTrial{trial_, trials_[next_ - 1], latest_->result};
}

std::optional<ConductedTrial> RunConductor::runTrial(const std::atomic<bool>& stop, const std::function<void()>& looked) {
  if (!putUpNext()) return std::nullopt;
  if (options_.virtualClock) advanceUntilDone(&stop);
  bool asked = false;
  while (true) {
    if (const auto ended = poll()) return ended;
    if (looked) looked();
    if (stop && !asked) {
      interrupt();
      asked = true;
    }
    std::this_thread::sleep_for(kLook);
  }
}

std::optional<std::string> RunConductor::fault() const {
  if (!loop_) return std::nullopt;
  const auto withItsWords = [](const std::string& sentence, const HapticDevice& device) {
    const std::string said = device.healthText();
    return said.empty() ? sentence : sentence + ": " + said;
  };
  const std::vector<HapticDevice*> hands = device_->hands();
  for (const HapticDevice* hand : hands)
    if (hand->health() == DeviceHealth::Lost) return withItsWords(fmt::format("device {} is lost", hand->info().name), *hand);
  const LatchedFault latched = loop_->latched();
  if (latched.fault == DeviceFault::None) return std::nullopt;
  return withItsWords(describe(latched.fault, hands[latched.hand]->info().name), *hands[latched.hand]);
}

void RunConductor::finish() {
  if (!loop_ || finished_) return;
  finished_ = true;
  loop_->stop();
  if (sink_ != nullptr) sink_->close();
}

}  // namespace reachlab::haptics
