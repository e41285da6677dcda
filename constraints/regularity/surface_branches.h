#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "constraints/formula/program.h"
#include "constraints/regularity/places.h"

namespace reachlab::constraints {

/// The result of interval analysis of a surface's formula graph: the lines across which it is not smooth, and its branches between them. A
/// typed surface has no ends. Where its formula cannot be proved smooth everywhere, the lines are watched while a mass moves.
struct SurfaceBranches {
  static constexpr int kMaxGuards = 6;
  static constexpr int kMaxBranching = 4;  // more lines that can be passed than that are stopped at

  struct Line {
    std::string because;               // the operation: "abs(u + v)"
    bool passable = false;             // a branching operation (abs, sign, atan2): another smooth formula lies behind
    PlaceKind kind = PlaceKind::Kink;  // what it is where it was looked at; a jump and a kink are told apart again where a mass meets it
    int bit = -1;                      // of the branch's index; passable ones only
    double level = 0;                  // the line is argument = level
  };
  std::vector<Line> lines;        // empty: smooth
  std::vector<Place> places;      // what a person is told
  std::vector<Surface> branches;  // by index: bit set where argument > level. One when there is no passable line
  std::shared_ptr<const void> owner;

  bool smooth() const { return lines.empty(); }
  /// argument - level of each line, and its derivatives by u and v. Never allocates.
  struct Guarded {
    double value = 0, u = 0, v = 0;
  };
  std::array<Guarded, kMaxGuards> at(double u, double v) const noexcept;

  const Program* program = nullptr;  // of `at`
  std::array<double, kMaxShapeParameters> shape{};
};

/// Interval arithmetic shows that r is analytic, and r_u x r_v not 0, wherever u and v are in the range. False says nothing.
bool isProvedRegular(const Constraint& surface, const std::array<Domain, 2>& range);

/// Throws FaultError where the formula has more than kMaxGuards such lines.
std::shared_ptr<const SurfaceBranches> computeBranches(const Constraint& surface);

}  // namespace reachlab::constraints
