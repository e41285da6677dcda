#include "gui/window_run.h"

#include <QDateTime>
#include <QString>
#include <QSysInfo>

#include "devices/make_device.h"
#include "devices/mouse_device.h"
#include "sim/record/bids.h"
#include "sim/record/channels.h"
#include "sim/trial/protocol.h"

namespace reachlab {
namespace {

std::string nowUtc() { return QDateTime::currentDateTimeUtc().toString(Qt::ISODateWithMs).toStdString(); }

std::string computerName() {
  return (QSysInfo::kernelType() + QLatin1Char(' ') + QSysInfo::kernelVersion() + QLatin1Char(' ') + QSysInfo::currentCpuArchitecture())
      .toStdString();
}

}  // namespace

WindowRun::WindowRun(const BlockToRun& block, const std::string& deviceSpec, const std::string& dataFolder)
    : configuration_(block.configuration), logPath_(block.logPath), dataFolder_(dataFolder), trialCount_(block.trials.size()) {
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
  conductor_ = std::make_unique<RunConductor>(block.experiment, std::move(device), block.trials);
  choice_ = conductor_->engine().choice();

  RunConfiguration& c = configuration_;
  c.device = deviceSpec;
  c.deviceName = info.name;
  c.deviceVersion = info.version;
  c.deviceMaxForce = info.maxForce;
  c.virtualHand = info.virtualHand;
  c.method = choice_.method;
  c.methodReason = choice_.reason;
  c.softwareVersion = "reachlab " REACHLAB_VERSION;
  c.buildDescription = "g++ " __VERSION__;
  c.computer = computerName();
  c.startedUtc = nowUtc();
  c.clock = "monotonic";
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

void WindowRun::finish() {
  if (finished_) return;
  finished_ = true;
  conductor_->finish();
  if (logPath_.empty()) return;
  const RunLog log = RunLog::open(logPath_);
  writeBidsRun(log, dataFolder_);
  writeBidsTables({log.configuration()}, dataFolder_);
}

}  // namespace reachlab
