#pragma once
#include <span>

#include "constraints/catalogue/definition.h"
#include "constraints/constraint.h"

namespace reachlab::constraints {

/// One shipped definition: its file's text, and the functions generated from it (those of the other kind null).
struct GeneratedEntry {
  const char* text;
  CurveFunction curve;
  CurveBatchFunction curveBatch;
  SurfaceFunction surface;
};
/// The generated code of a definition of the catalogue. All three are null for any other definition.
struct GeneratedFunctions {
  CurveFunction curve = nullptr;
  CurveBatchFunction curveBatch = nullptr;
  SurfaceFunction surface = nullptr;
};
GeneratedFunctions generatedFunctions(const Definition& definition);

/// The entries ordered by name. The generated file in the build folder defines this function.
std::span<const GeneratedEntry> generatedEntries();

}  // namespace reachlab::constraints
