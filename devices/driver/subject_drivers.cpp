#include "base/device_options.h"
#include "base/fault.h"
#include "devices/driver/drivers.h"
#include "sim/experiment/experiment.h"
#include "sim/subjects/plans/partner_hand.h"
#include "sim/subjects/plans/simulated_hand.h"
#include "sim/subjects/subject_kinds.h"

namespace reachlab::devices {

DeviceDriver simulatedDriver() {
  return {"simulated",
          "simulated[:KEY=VALUE,…]",
          "a virtual subject: plans by a criterion for this very object, or feels, errs and learns (docs/virtual-subjects.md)",
          alwaysThere,
          [](const DeviceRequest& r) {
            std::shared_ptr<void> nothing;
            return subjects::prepareSubjects(r.experiment, r.argument.empty() ? "simulated" : "simulated:" + r.argument)(
                r.seed, 0, r.learnt != nullptr ? *r.learnt : nothing);
          },
          true};
}

DeviceDriver partnerDriver() {
  return {"partner",
          "partner:ROLE[,hand-mass=KG,arm-stiffness=N_PER_M,arm-damping=N_S_PER_M,reaction=S,mass=I,…]",
          "a simulated partner who feels the object: leader, follower or stubborn",
          alwaysThere,
          [](const DeviceRequest& r) {
            DeviceOptions options(r.argument, r.words());
            subjects::PartnerSpec spec;
            if (options.plain() == "leader") spec.role = subjects::PartnerRole::Leader;
            else if (options.plain() == "follower") spec.role = subjects::PartnerRole::Follower;
            else if (options.plain() == "stubborn") spec.role = subjects::PartnerRole::Stubborn;
            else throw FaultError(Fault{"device", "is " + r.words(), "partner:leader, partner:follower or partner:stubborn"});
            spec.handMass = options.number("hand-mass", spec.handMass, 0.05, 50);
            spec.stiffness = options.number("arm-stiffness", spec.stiffness, 0, 1e5);
            spec.damping = options.number("arm-damping", spec.damping, 0, 1e4);
            spec.mass = options.count("mass", 0, 0, experiment::kMaxMasses);
            const bool leads = spec.role == subjects::PartnerRole::Leader;
            const subjects::SubjectSpec leader = leads ? subjects::takeSubject(options) : subjects::SubjectSpec{};
            if (!leads) spec.reaction = options.number("reaction", spec.reaction, 0.001, 5);
            options.done();
            return subjects::makePartnerHand(r.experiment, spec,
                                             leads ? subjects::makeSimulatedHand(r.experiment, leader, r.seed) : nullptr);
          },
          true};
}

}  // namespace reachlab::devices
