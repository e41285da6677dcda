#pragma once
#include <array>
#include <string_view>
#include <vector>

#include "network/coupled_copy.h"
#include "sim/experiment/experiment.h"

/// Two simulated people who move one object over a simulated link, along one axis. It shows the effect of the link on the object and on the
/// people.
namespace reachlab::network {

inline constexpr int kSubsteps = 10;   // of a hand in a tick
inline constexpr double kFarAway = 1;  // [m] a hand at this distance has been thrown

/// A person's hand as a body about its intended position. A limp hand can be moved easily.
struct SimulatedArm {
  double mass = 1;                             // [kg]
  double stiffness = 300, damping = 20;        // [N/m], [N s/m]
  double limpStiffness = 20, limpDamping = 5;  // [N/m], [N s/m]
};

/// The held object, the two arms and the link.
struct TwoHandsSetup {
  experiment::Experiment experiment;  // two hands, a line along x
  SimulatedArm arm;                   // for both arms
  double roundTrip = 0;               // [s]
  double jitterShare = 0.1;           // as a share of the one-way delay, plus half a millisecond
  double loss = 0.05;                 // in each direction
  std::uint64_t seed = 1;
};

/// The outcome. Errors are over the time before the hands go limp.
struct TwoHandsOutcome {
  bool stable = false;
  double apart = 0;           // [m] RMS over masses and time: the two copies at the same moment
  double forceError = 0;      // [N] RMS difference of the two rendered forces from the forces without a link
  double force = 0;           // [N] RMS without a link
  double given = 0;           // [J] the largest energy that the stations have given to the two hands at any time
  double growth = 0;          // speed in the last second over that after going limp
  double ledgerWorst = 0;     // [J] the largest excess of a copy's energy over the energy that both hands had put in by then
  double ledgerDuration = 0;  // [s] the longest time in a row with an excess above kLedgerAmount
};
inline constexpr double kMostGiven = 0.3;      // [J]
inline constexpr double kLedgerAmount = 0.05;  // [J]

/// The same two people on one simulation, without a link.
struct TwoHandsReference {
  std::array<std::vector<double>, 2> force;  // [N] on each hand, tick by tick
  double rms = 0;                            // [N] of both, before the hands go limp
  double growth = 0;
};
TwoHandsReference makeReference(const TwoHandsSetup& setup);

/// 13 s long: together out and back, against each other, then limp from 6.5 s on.
TwoHandsOutcome runTwoHands(const TwoHandsSetup& setup, const CopySettings& settings, const TwoHandsReference& reference);

/// An object that two hands hold: a chain of five at both ends, or two parallel masses.
enum class SharedObject { Chain, Parallel };
inline constexpr std::array kSharedObjects{SharedObject::Chain, SharedObject::Parallel};
std::string_view nameOf(SharedObject object);
experiment::Experiment makeSharedExperiment(SharedObject object, double handStiffness = 600, double handDamping = 0,
                                            double chainDamping = 0);

/// The i-th random set-up: arms, coupling, damping. Depends on (object, seed, i) alone. A chain's coupling is 200 to 600 N/m, and up to 5 N
/// s/m in every other set-up (parallel springs: up to half of that).
TwoHandsSetup makeRandomSetup(SharedObject object, std::uint64_t seed, int index);

}  // namespace reachlab::network
