#pragma once
#include <optional>

#include "constraints/constraint_spec.h"

namespace reachlab::constraints {

/// Where a surface bends much more than elsewhere within less than a tick's way: about u = `at` (parameter 0) or v = `at` (1).
struct NarrowBand {
  int parameter = 0;
  double at = 0, width = 0;
};
/// The first on the two parameter lines through `start`, eight units either way, by interval arithmetic over second derivatives. A bump
/// that neither line meets is not found. Nothing for definitions of the catalogue, whose shapes are known. Allocates.
std::optional<NarrowBand> findNarrowBand(const Constraint& surface, const std::array<double, 2>& start);

}  // namespace reachlab::constraints
