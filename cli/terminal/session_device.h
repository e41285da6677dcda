#pragma once
#include "sim/session/recorded_session.h"

/// The device of a session that the command line conducts, and the warnings on stderr before its runs.
namespace reachlab::cli {

/// The requested device. Each hand that asks for no mapping has the one that is kept for the subject.
std::string withMappings(const session::SessionRequest& request);

/// Makes the device of each block, and warns of forces, speeds and places that the device does not reach. A virtual person keeps from block to
/// block the things that it has learned.
session::DeviceMaker checkedDeviceMaker();

/// The warnings of the run's scenes.
void printWarnings(const session::RecordedRun& run);

}  // namespace reachlab::cli
