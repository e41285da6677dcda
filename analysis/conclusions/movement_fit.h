#pragma once
#include <array>
#include <vector>

#include "analysis/conclusions/profile_family.h"

namespace reachlab::analysis {

/// The part of a trial that everything is compared with: evenly sampled hand velocity, and how much each sample counts.
struct FitWindow {
  double rate = 100;             // [Hz]
  double begin = 0;              // [s] of sample 0, on the trial's clock
  std::vector<double> velocity;  // [m/s] along the path
  std::vector<double> weight;    // w^2 of each sample, > 0
};

/// v(t) = amplitude * phi((t - onset) / duration): three numbers per trial.
struct MovementFit {
  double onset = 0;      // [s] on the trial's clock
  double duration = 0;   // [s]
  double amplitude = 0;  // [m/s]
  double cost = 0;       // sum of w^2 r^2
  bool found = false;
};

/// Centre and width (SD) of phi^2 over s. A fit is started from them.
struct ProfileMoments {
  double centre = 0, width = 0;
};
ProfileMoments momentsOf(const Profile& profile);
/// The same of a window's v^2 over time [s].
ProfileMoments momentsOf(const FitWindow& window);
/// Onset and duration at which phi has the moments of the window, the duration times `factor`.
MovementFit startFrom(const ProfileMoments& window, const ProfileMoments& profile, double factor = 1);

/// When a fit has arrived: after so many steps, or when one improves the cost by less than that part.
struct FitEffort {
  int steps = 40;
  double improvement = 1e-9;
};
inline constexpr FitEffort kRoughFit{6, 1e-3};

/// A profile's cubic pieces, made once for many fits: phi = c0 + d (c1 + d (c2 + d c3)), d from 0 to 1 in a piece. Pieces without two
/// neighbours on either side are left out: phi is 0 there.
struct ProfilePieces {
  double first = 0, step = 1;  // s of the profile's first sample, spacing; the first piece begins two samples later
  std::vector<std::array<double, 4>> c;
  explicit ProfilePieces(const Profile& profile);
};

/// Least squares over onset, duration and amplitude by damped Newton steps in (onset + duration / 2, ln duration, amplitude),
/// from `start` (its onset and duration). The profile is held.
MovementFit fitMovement(const FitWindow& window, const ProfilePieces& pieces, const MovementFit& start, FitEffort effort = {});
MovementFit fitMovement(const FitWindow& window, const Profile& profile, const MovementFit& start, FitEffort effort = {});
/// Fits a profile that is planned anew for every duration. `found` is false if no profile can be predicted at the start. `scratch`
/// is memory for the profiles, which many fits share.
MovementFit fitMovement(const FitWindow& window, const ProfileFamily& family, const MovementFit& start, Profile& scratch,
                        FitEffort effort = {});

/// v - amplitude * phi at every sample.  [m/s]
std::vector<double> residualsOf(const FitWindow& window, const Profile& profile, const MovementFit& fit);
/// sum of w^2 v^2: the cost of not moving.
double restCost(const FitWindow& window);

}  // namespace reachlab::analysis
