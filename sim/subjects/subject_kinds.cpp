#include "sim/subjects/subject_kinds.h"

#include "base/device_options.h"
#include "base/fault.h"

namespace reachlab::subjects {

MakeSubject prepareSubjects(const experiment::CompiledExperiment& experiment, const std::string& device) {
  const std::string name = device.substr(0, device.find(':'));
  if (name != "simulated") throw FaultError(Fault{"subject", "is " + device, "a simulated subject"});
  const std::string options = name == device ? "" : device.substr(name.size() + 1);
  const std::string kind = DeviceOptions(options, "device simulated").word("kind", {"plan", "impedance", "ofc"});
  if (kind == "ofc") return prepareFeedbackSubjects(experiment, options);
  if (kind == "impedance") return prepareImpedanceSubjects(experiment, options);
  return prepareSubjects(experiment, parseSubject(options));
}

}  // namespace reachlab::subjects
