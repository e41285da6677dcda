#pragma once
#include <stop_token>
#include <string>

#include "network/coupled_copy.h"

/// Before a block: does this very object come to rest over the links as they are, when all let go of it?
namespace reachlab::network {

/// A link as it is measured (LinkStatus).
struct MeasuredLink {
  double roundTrip = 0;  // [s]
  double jitter = 0;     // [s] standard deviation of the round trip
  double loss = 0;       // share
  /// The worse of the two in everything.
  static MeasuredLink worse(const MeasuredLink& a, const MeasuredLink& b);
};

struct LinkCheck {
  bool stable = false;
  double frequency = 0;  // [rad/s] omega_o with which it comes to rest; not stable: the last that was tried
  double growth = 0;     // speed after some seconds over that at first; infinite: a hand was thrown, or the check was ended
  std::string sentence;  // what was found, with the numbers
};

/// Limp hands (1 kg on 20 N/m and 5 N s/m), pushed apart at the start, over links all as bad as `link`. Where the motion grows omega_o is
/// raised from `settings`' by steps of 0.5 rad/s, as far as the round trip allows. Takes a tenth of a second or several seconds; a function
/// of its arguments alone, but that a requested `stop` ends it at once: not stable, as far as is known. Throws as CoupledCopy.
LinkCheck checkLink(const experiment::Experiment& experiment, const constraints::Constraint& constraint, const MeasuredLink& link,
                    const CopySettings& settings, const std::stop_token& stop = {});
/// With the settings of the experiment's object.
LinkCheck checkLink(const experiment::Experiment& experiment, const MeasuredLink& link, const std::stop_token& stop = {});

}  // namespace reachlab::network
