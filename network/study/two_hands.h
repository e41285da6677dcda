#pragma once
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "network/coupled_copy.h"
#include "network/simulated_line.h"
#include "sim/experiment/experiment.h"

/// Two simulated people who move one object over a simulated line, along one axis: what a way of coupling their stations does to the object
/// and to them. The numeric study that the design was chosen by.
namespace reachlab::network {

/// A person's hand as a body about where it means to be; from `relaxAt` on it means to be at the start, limp.
struct StudyHand {
  double mass = 1;                             // [kg]
  double stiffness = 300, damping = 20;        // [N/m], [N s/m]
  double limpStiffness = 20, limpDamping = 5;  // [N/m], [N s/m]
};

/// What is held, by whom, over what line.
struct StudySetup {
  experiment::Experiment experiment;  // two hands, a line along x
  StudyHand hand;
  double roundTrip = 0;      // [s]
  double jitterShare = 0.1;  // of the one-way delay, and half a millisecond
  double loss = 0.05;        // each way
  std::uint64_t seed = 1;
};

/// Ways of coupling the two stations.
enum class Coupling {
  ServerForce,    // station 1 simulates, the force of hand 2 is computed there and sent back
  ServerPlace,    // station 1 simulates, the masses' places are sent back, and hand 2's coupling is computed at station 2
  CopiesHeld,     // a copy at each station, the other hand where it was last heard
  CopiesGuessed,  // the same, dead-reckoned
  Design,         // CoupledCopy as it is
  HalfDelayed,    // copies of half the mass, own hands only, joined by a spring and damper over the line
  HalfProjected,  // the same, the spring's set place moved only as far as energy allows (PSPM)
  HalfWaves,      // the same, by wave variables
};
inline constexpr std::array kCouplings{Coupling::ServerForce, Coupling::ServerPlace, Coupling::CopiesHeld,    Coupling::CopiesGuessed,
                                       Coupling::Design,      Coupling::HalfDelayed, Coupling::HalfProjected, Coupling::HalfWaves};
std::string_view nameOf(Coupling coupling);    // "design", "server-force", …
std::string_view describe(Coupling coupling);  // a phrase for tables

/// What became of it. Errors are over the time before the hands go limp.
struct StudyOutcome {
  bool stable = false;
  double apart = 0;           // [m] RMS over masses and time: the two copies at the same moment
  double forceError = 0;      // [N] RMS of the two rendered forces against no line
  double force = 0;           // [N] RMS without a line
  double given = 0;           // [J] the most that the stations have given the two hands at any time
  double growth = 0;          // speed in the last second over that after going limp
  double ledgerWorst = 0;     // [J] the most that a copy held above what both hands had put in by then
  double ledgerDuration = 0;  // [s] the longest time in a row that it held more than kLedgerAmount above it
};
inline constexpr double kMostGiven = 0.3;      // [J]
inline constexpr double kLedgerAmount = 0.05;  // [J]

/// The same two people on one simulation, without a line: what every coupling is held against.
struct StudyReference {
  std::array<std::vector<double>, 2> force;  // [N] on each hand, tick by tick
  double rms = 0;                            // [N] of both, before the hands go limp
  double growth = 0;
};
StudyReference makeReference(const StudySetup& setup);

/// 13 s: together out and back, against each other, then limp from 6.5 s on. `settings`: of the design's copies.
StudyOutcome runTwoHands(const StudySetup& setup, Coupling coupling, const CopySettings& settings, const StudyReference& reference);

/// The study's objects, held by two hands.
enum class StudyObject { Chain, Parallel };
experiment::Experiment makeStudyExperiment(StudyObject object, double handStiffness = 600, double handDamping = 0, double chainDamping = 0);

/// The i-th of the study's random set-ups: hands, arms, coupling, damping. Depends on (object, seed, i) alone. A chain's coupling: 200 to
/// 600 N/m, and in every other set-up up to 5 N s/m (parallel springs: up to half of that).
StudySetup makeRandomSetup(StudyObject object, std::uint64_t seed, int index);

}  // namespace reachlab::network
