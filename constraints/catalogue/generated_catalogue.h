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
/// The definition's generated code if it is of the catalogue; all null otherwise.
struct GeneratedFunctions {
  CurveFunction curve = nullptr;
  CurveBatchFunction curveBatch = nullptr;
  SurfaceFunction surface = nullptr;
};
GeneratedFunctions generatedFunctions(const Definition& definition);

/// Defined by the generated file in the build folder; by name.
std::span<const GeneratedEntry> generatedEntries();

}  // namespace reachlab::constraints
