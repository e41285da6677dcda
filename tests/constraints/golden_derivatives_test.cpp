// Derivatives of every definition against values that SymPy and mpmath computed (golden_derivatives.py, committed beside this file).
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "constraints/catalogue/definition.h"
#include "constraints/constraint.h"
#include "constraints/formula/program.h"
#include "constraints/regularity/analysis.h"
#include "test_paths.h"

namespace reachlab::constraints {
namespace {

constexpr double kRelative = 1e-13;  // of the sum of the absolute terms

struct GoldenRow {
  std::string name;
  std::vector<double> numbers;
};

std::vector<GoldenRow> readGolden() {
  std::ifstream in(REACHLAB_SOURCE_DIR "/tests/constraints/golden_derivatives.csv");
  std::vector<GoldenRow> rows;
  for (std::string line; std::getline(in, line);) {
    GoldenRow row;
    std::istringstream fields(line);
    std::getline(fields, row.name, ',');
    for (std::string field; std::getline(fields, field, ',');) {
      double value = 0;
      std::from_chars(field.data(), field.data() + field.size(), value);
      row.numbers.push_back(value);
    }
    rows.push_back(row);
  }
  return rows;
}

// The same definition through the interpreter.
Constraint typedForm(const Definition& d) {
  ConstraintSpec spec;
  spec.name.clear();
  (d.kind == ConstraintKind::Curve ? spec.curve : spec.surface).assign(d.coordinates.begin(), d.coordinates.end());
  for (const ShapeParameter& p : d.shape) spec.shape[p.name] = p.defaultValue;
  spec.inUse = boundedDomain(makeConstraint(d));
  return makeConstraint(spec, "typed");
}

std::vector<double> numbersOf(const Constraint& c, const double* q) {
  std::vector<double> numbers(c.kind == ConstraintKind::Curve ? 9 : 18);
  if (c.kind == ConstraintKind::Curve) {
    const CurvePoint p = evaluate(c.curve, q[0]);
    std::memcpy(numbers.data(), &p, sizeof p);
  } else {
    const SurfacePoint p = evaluate(c.surface, q[0], q[1]);
    std::memcpy(numbers.data(), &p, sizeof p);
  }
  return numbers;
}

TEST(Derivatives, OfEveryDefinitionMatchSymPyInBothForms) {
  std::set<std::string> seen;
  for (const GoldenRow& row : readGolden()) {
    const Definition* d = findInCatalogue(row.name);
    ASSERT_NE(d, nullptr) << row.name;
    seen.insert(row.name);
    const std::size_t dimensions = d->kind == ConstraintKind::Curve ? 1 : 2;
    for (const Constraint& c : {makeConstraint(*d), typedForm(*d)}) {
      const std::vector<double> numbers = numbersOf(c, row.numbers.data());
      ASSERT_EQ(row.numbers.size(), dimensions + 2 * numbers.size());
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double exact = row.numbers[dimensions + 2 * i], terms = row.numbers[dimensions + 2 * i + 1];
        EXPECT_LE(std::abs(numbers[i] - exact), kRelative * terms)
            << row.name << " (" << c.name << ") number " << i << " at " << row.numbers[0];
      }
    }
  }
  EXPECT_EQ(seen.size(), catalogue().size()) << "run golden_derivatives.py for the new definitions";
}

TEST(Derivatives, GeneratedAndTypedFormsAgreeInEveryBit) {
  std::mt19937_64 random(7);
  for (const Definition& d : catalogue()) {
    const Constraint generated = makeConstraint(d), typed = typedForm(d);
    // A formula's own shape is in the order of its names, a definition's as written: the values are the same.
    const std::array<Domain, 2> range = boundedDomain(generated);
    for (int i = 0; i < 200; ++i) {
      double q[2];
      for (std::size_t k = 0; k < 2; ++k) q[k] = std::uniform_real_distribution<>(range[k].lo, range[k].hi)(random);
      const std::vector<double> a = numbersOf(generated, q), b = numbersOf(typed, q);
      for (std::size_t n = 0; n < a.size(); ++n)
        ASSERT_TRUE(a[n] == b[n]) << d.name << " number " << n << " at " << q[0] << ", " << q[1] << ": " << a[n] << " and " << b[n];
    }
  }
}

}  // namespace
}  // namespace reachlab::constraints
