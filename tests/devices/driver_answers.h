#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "devices/driver/registry.h"
#include "devices/make_device.h"
#include "sim/experiment/experiment.h"
#include "tests/refusal.h"

namespace reachlab::devices {

/// What drivers find, and what they make or refuse for an experiment: a base of fixtures.
class DriverAnswers {
 protected:
  static std::vector<FoundDevice> rows(const std::string& driver) { return findDriver(driver)->find(*findDriver(driver)); }
  std::unique_ptr<haptics::HapticDevice> make(const std::string& spec) const { return makeDevice(spec, experiment, 1); }
  std::string refusalOf(const std::string& spec) const {
    return reachlab::refusalOf([&] { make(spec); }, "made");
  }
  experiment::Experiment experiment = experiment::readExperiment("chain-slow");
};

}  // namespace reachlab::devices
