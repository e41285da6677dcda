#pragma once
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/conclusions/movement_fit.h"
#include "analysis/conclusions/profile_family.h"

namespace reachlab::analysis {

/// How a person plans trials of different durations. `Anew`: the person plans each trial for its duration. `OnePlan`: the person runs one plan
/// faster or slower.
enum class TimeLaw { Anew, OnePlan };
std::string_view nameOf(TimeLaw law);  // "anew" or "one-plan", as in fits.csv

/// All trials fitted with one shape.
struct ShapeFits {
  std::vector<MovementFit> trials;
  std::vector<double> score;  // ln S of each trial
  double plan = 0;            // [s] of the one plan
};

/// The fits of all trials with one family of profiles: with a new plan for each trial, and with one plan of each tried duration.
struct FamilyFits {
  ShapeFits anew;
  std::map<int, ShapeFits> plans;  // by step of ln P
  ShapeFits between;               // at the plan where parabolas through the costs of plans near the best step are least, may be empty
};

/// Fits the trials of one person with one family after another. Every trial is fitted from several starts. One thread.
class ShapeFitter {
 public:
  /// `rest`: the cost of not moving, of each window. Both spans must outlive the fitter.
  ShapeFitter(std::span<const FitWindow> windows, std::span<const double> rest);

  /// The fits are empty if the family has no profile for the duration `typical` [s]. `withPlans` false leaves out the fits with one plan.
  FamilyFits fit(const ProfileFamily& family, double typical, bool withPlans = true) const;
  /// The same for a family that differs little from the family of `similar`: each trial starts from its fit there alone.
  FamilyFits fitNear(const ProfileFamily& family, const FamilyFits& similar) const;
  /// Where the fit of a trial starts: from its fit nearby alone, or from several durations as well.
  enum class Starts { Nearby, Several };
  /// With the plan for `plan` [s]. Empty if it cannot be predicted. `nearby` has a fit for each trial, or is empty.
  ShapeFits fitPlan(const ProfileFamily& family, double plan, std::span<const MovementFit> nearby, Starts starts) const;

 private:
  void fitPlans(const ProfileFamily& family, FamilyFits& fits, Starts starts) const;

  std::span<const FitWindow> windows_;
  std::span<const double> rest_;
  std::vector<ProfileMoments> moments_;
};

/// The law and the plan that fit some of the trials best, and the scores of all trials with them.
struct JudgedShape {
  TimeLaw law = TimeLaw::Anew;
  double plan = 0;  // [s] for OnePlan
  std::vector<double> score;
  double sum = 0;    // of the scores of the trials that chose
  bool any = false;  // false: the family predicts nothing
};
/// The least sum of scores over the trials `by`. A plan counts if it is within 7 % of the median fitted duration.
JudgedShape chooseShape(const FamilyFits& fits, const std::vector<std::size_t>& by);

/// The middle value, or the mean of the two middle values. `values` is not empty.
double medianOf(std::vector<double> values);

}  // namespace reachlab::analysis
