#pragma once
#include <stop_token>
#include <string>

#include "network/coupled_copy.h"

/// The check before a block: does this very object come to rest over the present links after all hands let go of it?
namespace reachlab::network {

/// A link as measured (LinkStatus).
struct MeasuredLink {
  double roundTrip = 0;  // [s]
  double jitter = 0;     // [s] standard deviation of the round trip
  double loss = 0;       // share
  /// The worse of the two values of each number.
  static MeasuredLink worse(const MeasuredLink& a, const MeasuredLink& b);
};

struct LinkCheck {
  bool stable = false;
  double frequency = 0;  // [rad/s] omega_o with which the object comes to rest; not stable: the last value that was tried
  double growth = 0;     // speed after some seconds over the speed at first; infinite: a hand was thrown, or the check was ended
  std::string sentence;  // the finding as a sentence, with the numbers
};

/// Limp hands (1 kg on 20 N/m and 5 N s/m) are pushed apart at the start, over links that are all as bad as `link`. If the motion grows,
/// omega_o is raised from `settings` in steps of 0.5 rad/s, as far as the round trip allows. Takes between a tenth of a second and several
/// seconds. The result is a function of the arguments alone. Only a requested `stop` ends the check at once, with the result not stable as
/// far as known. Throws as CoupledCopy does.
LinkCheck checkLink(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const MeasuredLink& link,
                    const CopySettings& settings, const std::stop_token& stop = {});
/// With the settings of the experiment's object.
LinkCheck checkLink(const experiment::Experiment& experiment, const MeasuredLink& link, const std::stop_token& stop = {});

}  // namespace reachlab::network
