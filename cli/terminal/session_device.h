#pragma once
#include "sim/session/recorded_session.h"

/// The device of a session that the command line conducts. Warnings about it are printed on stderr.
namespace reachlab::cli {

/// The requested device. Each hand that asks for no mapping has the one that is kept for the subject.
std::string withMappings(const session::SessionRequest& request);

/// Makes the device of each block, and warns of forces, speeds and places that the device does not reach. A virtual person keeps from block to
/// block the things that it has learned.
session::DeviceMaker checkedDeviceMaker();

}  // namespace reachlab::cli
