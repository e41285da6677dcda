#include "devices/subject/subject_kinds.h"

#include "base/fault.h"
#include "devices/driver/drivers.h"
#include "devices/driver/options.h"

namespace reachlab::devices {

MakeSubject prepareSubjects(const experiment::CompiledExperiment& experiment, const std::string& device) {
  const std::string name = device.substr(0, device.find(':'));
  if (name != "simulated") throw FaultError(Fault{"subject", "is " + device, "a simulated subject"});
  const std::string options = name == device ? "" : device.substr(name.size() + 1);
  const std::string kind = DeviceOptions(options, "device simulated").word("kind", {"plan", "impedance", "ofc"});
  if (kind == "ofc") return prepareFeedbackSubjects(experiment, options);
  if (kind == "impedance") return prepareImpedanceSubjects(experiment, options);
  return prepareSubjects(experiment, parseSubject(options));
}

DeviceDriver simulatedDriver() {
  return {"simulated",
          "simulated[:KEY=VALUE,…]",
          "a virtual subject: plans by a criterion for this very object, or feels, errs and learns (docs/virtual-subjects.md)",
          false,
          alwaysThere,
          [](const DeviceRequest& r) {
            std::shared_ptr<void> learnt;
            return prepareSubjects(r.experiment, r.argument.empty() ? "simulated" : "simulated:" + r.argument)(r.seed, 0, learnt);
          },
          true};
}

}  // namespace reachlab::devices
