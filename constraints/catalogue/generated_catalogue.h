#pragma once
#include <span>

#include "constraints/constraint.h"

namespace reachlab::constraints {

/// One shipped definition: its file's text, and the functions generated from it (those of the other kind null).
struct GeneratedEntry {
  const char* text;
  CurveFunction curve;
  CurveBatchFunction curveBatch;
  SurfaceFunction surface;
};
/// Defined by the generated file in the build folder; by name.
std::span<const GeneratedEntry> generatedEntries();

}  // namespace reachlab::constraints
