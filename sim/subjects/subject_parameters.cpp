#include "sim/subjects/subject_parameters.h"

#include <algorithm>

#include "base/fault.h"

namespace reachlab::subjects {
namespace {

constexpr std::string_view kTodorov = "Todorov 2005, as reimplementations have it", kFitted = "fitted to the success rates of Table 2",
                           kOurs = "assumed", kSmith = "Smith et al. 2006";

constexpr SubjectParameter kFeedback[] = {
    {"arm-mass", "kg", 1.5, 0.05, 20, false, "mass of the arm along the way", "assumed; a point mass of 1 kg in Todorov 2005"},
    {"arm-damping", "N s/m", 10, 0, 500, false, "damping of the arm", "assumed, 5 to 15"},
    {"muscle", "s", 0.04, 0.005, 0.5, true, "time constant of each of the muscle's two stages", kTodorov},
    {"motor-noise", "1", 0.12, 0, 2, false, "SD of the command's noise in a control step, as a part of the command",
     "fitted; 0.5 in Todorov 2005, too large against measured force"},
    {"force-noise", "N", 0.2, 0, 20, false, "SD of the command's additive noise in a control step", kFitted},
    {"touch-position", "m", 0.01, 1e-5, 1, true, "SD of the felt place of the hand in a control step", kTodorov},
    {"touch-velocity", "m/s", 0.1, 1e-5, 10, true, "SD of the felt velocity of the hand", kTodorov},
    {"touch-force", "N", 0.6, 1e-4, 100, false, "SD of the felt force of the object", "half of Todorov 2005, fitted"},
    {"sight-position", "m", 0.004, 1e-5, 1, false, "SD of a seen place", kOurs},
    {"delay-touch", "s", 0.05, 0.01, 0.5, true, "delay of touch, in whole control steps of 0.01 s",
     "long-latency responses 50 to 100 ms: Pruszynski and Scott 2012"},
    {"delay-sight", "s", 0.1, 0.01, 0.5, true, "delay of sight, in whole control steps of 0.01 s",
     "about 90 ms to a cursor: J Neurosci 2019, PMC6703887"},
    {"effort", "1/N^2", 0.03, 1e-9, 1e3, false, "weight of the squared command, without a criterion",
     "assumed; effort against accuracy as in Nagengast et al. 2009"},
    {"criterion-effort", "1/N^2", 0.001, 1e-9, 1e3, false, "weight of the squared command beside a criterion", kOurs},
    {"criterion-weight", "1", 0.1, 1e-6, 1e3, false, "weight of the criterion, against the least cost that its prediction has", kOurs},
    {"time-sd", "1", 0.07, 0, 0.3, true, "SD of the intended movement time, as a part of it", "the paper: 0.09 s of 1.35 s"},
    {"reaction", "s", 0.2, 0, 5, false, "from go to the first command", kOurs},
    {"plan-sd-stiffness", "ln", 0.09, 0, 2, false, "SD of the assumed stiffness from trial to trial, when practised",
     "fitted; of the size of a Weber fraction"},
    {"plan-sd-mass", "ln", 0.21, 0, 2, false, "SD of the assumed mass from trial to trial, when practised",
     "fitted; of the size of a Weber fraction"},
    {"practice", "1", 0, 0, 10, false,
     "The two SDs above are (1 + this number) times as large in the first trial. 1.5 for subjects 1 to 5 and drawn ones",
     "fitted; a slow loss of variability as in Shmuelof et al. 2012"},
    {"practice-trials", "1", 400, 1, 1e6, false, "trials in which that excess falls to 1/e", kFitted},
    {"model-stiffness", "ln", 0, -2, 2, false, "assumed over true stiffness at first", kOurs},
    {"model-mass", "ln", 0, -2, 2, false, "assumed over true mass at first", kOurs},
    {"learn-fast", "1", 0, 0, 1, false, "gain of the fast process; 0.03 for subjects 1 to 5 and drawn ones",
     "fitted; two rates as in Smith et al. 2006"},
    {"keep-fast", "1", 0.6, 0, 1, false, "what a trial leaves of the fast process; overnight nothing is left", kFitted},
    {"learn-slow", "1", 0, 0, 1, false, "gain of the slow process; 0.008 for subjects 1 to 5 and drawn ones", kFitted},
    {"keep-slow", "1", 0.999, 0, 1, false, "what a trial leaves of the slow process", kFitted},
    {"field-learn-fast", "1", 0.21, 0, 1, true, "learning rate of the fast process, of a field on the hand and of a cursor's angle",
     kSmith},
    {"field-keep-fast", "1", 0.59, 0, 1, true, "what a trial leaves of that process; overnight nothing is left", kSmith},
    {"field-learn-slow", "1", 0.02, 0, 1, true, "learning rate of the slow process, of the same", kSmith},
    {"field-keep-slow", "1", 0.992, 0, 1, true, "what a trial leaves of that process", kSmith},
    {"noise", "1", 1, 0, 10, false, "scales every draw; 0: the mean reach", kOurs},
};

constexpr SubjectParameter kImpedance[] = {
    {"arm-mass", "kg", 1.5, 0.05, 20, false, "mass of the arm", "assumed; a point mass of 1 kg in Todorov 2005"},
    {"arm-damping", "N s/m", 10, 0, 500, false, "damping of the arm", "assumed, 5 to 15"},
    {"muscle", "s", 0.04, 0.005, 0.5, true, "time constant of each of the muscle's two stages", kTodorov},
    {"stiffness", "N/m", 300, 0, 1e5, false, "of the arm to its plan, felt at once", kOurs},
    {"damping", "N s/m", 40, 0, 1e4, false, "of the arm to its plan, felt at once", "assumed; near critical with the arm's mass"},
    {"feedback-stiffness", "N/m", 100, 0, 1e5, false, "of the delayed correction", kOurs},
    {"feedback-damping", "N s/m", 10, 0, 1e4, false, "of the delayed correction", kOurs},
    {"delay", "s", 0.06, 0, 0.5, true, "of the correction", "long-latency responses 50 to 100 ms: Pruszynski and Scott 2012"},
    {"motor-noise", "1", 0.12, 0, 2, false, "SD of the command's noise in 10 ms, as a part of the command", "as kind=ofc"},
    {"force-noise", "N", 0.2, 0, 20, false, "SD of the command's additive noise in 10 ms", "as kind=ofc"},
    {"model-stiffness", "ln", 0, -2, 2, false, "assumed over true stiffness", kOurs},
    {"model-mass", "ln", 0, -2, 2, false, "assumed over true mass", kOurs},
    {"hand-mass", "kg", 0, 0, 1000, false, "mass of the hand in the criterion [the arm's]", "the arm's"},
    {"time-sd", "1", 0.07, 0, 0.3, true, "SD of the movement time, as a part of it", "the paper: 0.09 s of 1.35 s"},
    {"reaction", "s", 0.2, 0, 5, false, "from go to the first movement", kOurs},
    {"noise", "1", 1, 0, 10, false, "scales every draw; 0: the mean reach", kOurs},
};

constexpr SubjectParameter kPlan[] = {
    {"hand-mass", "kg", 0, 0, 1000, false, "mass of the hand in the criterion [the experiment's]", "the experiment's"},
    {"time-sd", "1", 0.07, 0, 0.3, true, "SD of the movement time, as a part of it", "the paper: 0.09 s of 1.35 s"},
    {"speed-sd", "1", 0.07, 0, 1, false, "smooth noise in proportion to the speed, along the way and across", kOurs},
    {"reaction", "s", 0.2, 0, 5, false, "from go to the first movement, 15 % SD", kOurs},
    {"noise", "1", 1, 0, 10, false, "scales every draw; 0: the plan itself", kOurs},
};

}  // namespace

std::span<const SubjectParameter> feedbackParameters() { return kFeedback; }
std::span<const SubjectParameter> impedanceParameters() { return kImpedance; }
std::span<const SubjectParameter> planParameters() { return kPlan; }

double SubjectOptions::number(std::string_view key, std::optional<double> otherwise) {
  const auto p = std::find_if(parameters_.begin(), parameters_.end(), [&](const SubjectParameter& each) { return each.key == key; });
  return DeviceOptions::number(std::string(key), otherwise.value_or(p->usual), p->least, p->most);
}

void SubjectOptions::done() const {
  DeviceOptions::done();
  if (!plain().empty()) throw FaultError(Fault{"device", "simulated: " + plain(), "KEY=VALUE"});
}

}  // namespace reachlab::subjects
