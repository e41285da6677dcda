#include "gui/window_run.h"

#include <QDateTime>
#include <QString>
#include <QSysInfo>

#include "devices/make_device.h"
#include "devices/mouse/mouse_device.h"
#include "sim/record/bids.h"
#include "sim/record/channels.h"
#include "sim/trial/protocol.h"

namespace reachlab::gui {
namespace {

std::string nowUtc() { return QDateTime::currentDateTimeUtc().toString(Qt::ISODateWithMs).toStdString(); }

std::string computerName() {
  return (QSysInfo::kernelType() + QLatin1Char(' ') + QSysInfo::kernelVersion() + QLatin1Char(' ') + QSysInfo::currentCpuArchitecture())
      .toStdString();
}

}  // namespace

WindowRun::WindowRun(const session::BlockToRun& block, const std::string& deviceSpec, const std::string& dataFolder)
    : configuration_(block.configuration), logPath_(block.logPath), dataFolder_(dataFolder), trialCount_(block.trials.size()) {
  std::unique_ptr<haptics::HapticDevice> device;
  if (deviceSpec == "mouse") {
    const trial::ProtocolSettings task =
        trial::makeProtocolSettings(block.experiment, constraints::makeConstraint(block.experiment.constraint));
    auto mouse = std::make_unique<devices::MouseDevice>(task.start);
    mouse_ = mouse.get();
    device = std::move(mouse);
  } else {
    device = devices::makeDevice(deviceSpec, block.experiment, configuration_.seed);
  }
  const haptics::DeviceInfo info = device->info();
  conductor_ = std::make_unique<haptics::RunConductor>(block.experiment, std::move(device), block.trials);
  choice_ = conductor_->engine().choice();

  record::RunConfiguration& c = configuration_;
  c.device = deviceSpec;
  c.deviceName = info.name;
  c.deviceVersion = info.version;
  c.deviceMaxForce = info.maxForce;
  c.virtualHand = info.virtualHand;
  c.rendersForce = info.rendersForce;
  c.deviceContinuousForce = info.maxContinuousForce;
  c.deviceThermalSeconds = info.thermalSeconds;
  c.method = choice_.method;
  c.methodReason = choice_.reason;
  c.softwareVersion = "reachlab " REACHLAB_VERSION;
  c.buildDescription = "g++ " __VERSION__;
  c.computer = computerName();
  c.startedUtc = nowUtc();
  c.clock = "monotonic";
  c.table = record::makeChannelTable(block.experiment, conductor_->engine().constraint().parameterCount());
  if (!logPath_.empty()) recorder_ = std::make_unique<record::Recorder>(logPath_, c);
  sink_ = std::make_unique<TraceSink>(recorder_.get());
  conductor_->start(sink_.get());
}

WindowRun::~WindowRun() {
  try {
    finish();
  } catch (const std::exception&) {  // the disk is gone: it was said when the trial ended, and nothing can be said here
  }
}

void WindowRun::repeat(const trial::PlannedTrial& trial) {
  conductor_->append(trial);
  ++trialCount_;
}

void WindowRun::note(const std::string& text) {
  if (recorder_) recorder_->note(text);
}

void WindowRun::pointTo(const Vec3& hand) {
  if (mouse_ != nullptr) mouse_->setTarget(hand);
}

void WindowRun::finish() {
  if (finished_) return;
  finished_ = true;
  conductor_->finish();
  if (logPath_.empty()) return;
  const record::RunLog log = record::RunLog::open(logPath_);
  record::writeBidsRun(log, dataFolder_);
  record::writeBidsTables({log.configuration()}, dataFolder_);
}

}  // namespace reachlab::gui
