#include "gui/window_run.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <QString>
#include <QSysInfo>
#include <chrono>

#include "devices/make_device.h"
#include "devices/mouse_device.h"
#include "sim/record/channels.h"
#include "sim/trial/protocol.h"

namespace reachlab {
namespace {

std::string nowUtc() {
  const auto now = std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(seconds)), (now - seconds).count());
}

std::vector<PlannedTrial> plannedOf(const std::vector<TrialSetup>& setups) {
  std::vector<PlannedTrial> planned;
  for (const TrialSetup& setup : setups) planned.push_back(setup.planned);
  return planned;
}

}  // namespace

WindowRun::WindowRun(const BlockToRun& block, const std::string& deviceSpec)
    : configuration_(block.configuration), logPath_(block.logPath), trialCount_(block.trials.size()) {
  std::unique_ptr<HapticDevice> device;
  if (deviceSpec == "mouse") {
    const ProtocolSettings task = makeProtocolSettings(block.experiment, makeConstraint(block.experiment.constraint));
    auto mouse = std::make_unique<MouseDevice>(task.start);
    mouse_ = mouse.get();
    device = std::move(mouse);
  } else {
    device = makeDevice(deviceSpec, block.experiment, configuration_.seed);
  }
  const DeviceInfo info = device->info();
  conductor_ = std::make_unique<RunConductor>(block.experiment, std::move(device), plannedOf(block.trials));
  choice_ = conductor_->engine().choice();

  RunConfiguration& c = configuration_;
  c.device = deviceSpec;
  c.deviceName = info.name;
  c.deviceVersion = info.version;
  c.deviceMaxForce = block.experiment.forceLimit.value_or(info.maxForce);
  c.method = choice_.method;
  c.methodReason = choice_.reason;
  c.softwareVersion = REACHLAB_VERSION;
  c.buildDescription = "reachlab, window";
  c.computer = QSysInfo::prettyProductName().toStdString() + ", " + QSysInfo::currentCpuArchitecture().toStdString();
  c.startedUtc = nowUtc();
  c.clock = "steady";
  c.table = makeChannelTable(block.experiment, conductor_->engine().constraint().parameterCount());
  if (!logPath_.empty()) recorder_ = std::make_unique<Recorder>(logPath_, c);
  sink_ = std::make_unique<TraceSink>(recorder_.get());
  conductor_->start(sink_.get());
}

WindowRun::~WindowRun() {
  try {
    finish();
  } catch (const std::exception&) {  // the disk is gone: it was said when the trial ended, and nothing can be said here
  }
}

void WindowRun::repeat(const PlannedTrial& trial) {
  conductor_->append(trial);
  ++trialCount_;
}

void WindowRun::note(const std::string& text) {
  if (recorder_) recorder_->note(text);
}

void WindowRun::pointTo(const Vec3& hand) {
  if (mouse_ != nullptr) mouse_->setTarget(hand);
}

void WindowRun::finish() { conductor_->finish(); }

}  // namespace reachlab
