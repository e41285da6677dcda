#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/fault.h"
#include "constraints/constraint_spec.h"
#include "constraints/formula/formula.h"

namespace reachlab::constraints {

/// One number of a constraint's shape that the experimenter may change, in SI units. Keys of the catalogue end in their unit (`radius_m`).
struct ShapeParameter {
  std::string name;
  double defaultValue = 0, min = 0, max = 0;
  std::string unit;     // "m", "rad", "1" …
  std::string meaning;  // a few words
  bool whole = false;   // whole numbers only (numbers of cusps, turns …)
};

/// The two ends of a parameter, as constant expressions that may name shape parameters ("2*pi", "turns*2*pi"). An empty text means no end.
struct DomainText {
  std::string lo, hi;
  bool periodic = false;
  AtEnd atEnd = AtEnd::Stop;
};

/// One definition file. It gives the curve or surface of a mass in one line per coordinate, with everything that a window or an experiment
/// needs.
struct Definition {
  std::string name;  // lower case, words joined by '-'
  ConstraintKind kind = ConstraintKind::Curve;
  std::array<std::string, 3> coordinates;  // in phi, or in u and v
  std::vector<ShapeParameter> shape;
  std::array<DomainText, 2> domain;
  std::vector<double> start, target;  // a good reach: constraint parameters
  std::string sentence;               // what it is
  std::string source;                 // where the formula is from
};

/// The shipped definitions, curves first, each group by name. Compiled into the library.
const std::vector<Definition>& catalogue();
/// A definition of the catalogue, or null if the catalogue has no such name.
const Definition* findInCatalogue(const std::string& name);
/// A definition of the catalogue, else NAME.json of the user's folder. Throws FaultError that names the nearest known definition.
Definition findDefinition(const std::string& name, const std::string& key);

/// Reads a definition file. Throws FaultError with every fault, one per line, `FILE:LINE:COLUMN: KEY: what is wrong; allowed: …`.
Definition parseDefinition(const std::string& text, const std::string& file);
Definition readDefinition(const std::string& file);
/// Every fault of a definition, each under its key. Empty when the definition is valid.
std::vector<Fault> problems(const Definition& definition);
/// The definition as a file that reads back equal.
std::string toJson(const Definition& definition);

/// A definition that is found by the name of its file. Throws FaultError also when the name in it is another one.
Definition readNamedDefinition(const std::string& file);

/// All definitions (*.json) of a folder, ordered by name. Empty if the folder does not exist. Faulty files are left out, and their faults
/// added to `faults`.
std::vector<Definition> readDefinitionFolder(const std::string& folder, std::vector<Fault>& faults);
/// Where the user's own definitions are saved: $REACHLAB_CONSTRAINTS, else reachlab/constraints in $XDG_DATA_HOME or ~/.local/share.
std::string userDefinitionFolder();

/// The constraint of a definition with some shape values changed from their defaults. Throws FaultError as makeConstraint does.
Constraint makeConstraint(const Definition& definition, const std::map<std::string, double>& shape = {},
                          const std::string& key = "constraint");
/// Parameters in the order of Curve::shape and Surface::shape.
FormulaText formulaOf(const Definition& definition);
/// The shape's values in that order. Throws FaultError on an unknown key or a value out of range.
std::array<double, kMaxShapeParameters> shapeOf(const Definition& definition, const std::map<std::string, double>& shape,
                                                const std::string& key);
/// The shape as it is when nothing is changed, in that order.
std::array<double, kMaxShapeParameters> defaultsOf(const Definition& definition);
/// The domain for a shape. Throws FaultError under `domain`.
std::array<Domain, 2> domainOf(const Definition& definition, const std::array<double, kMaxShapeParameters>& shape);
/// Value of a constant expression that may name the definition's shape parameters. Throws FaultError.
double constantOf(const std::string& expression, const FormulaText& names, const std::array<double, kMaxShapeParameters>& shape,
                  const std::string& key);

}  // namespace reachlab::constraints
