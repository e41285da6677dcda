#pragma once
#include "constraints/formula/formula.h"

namespace reachlab::constraints {

/// From now on `watch` is called with every formula before it is compiled, by the thread that compiles it; null: nobody is.
void watchCompilations(void (*watch)(const FormulaText& text));

}  // namespace reachlab::constraints
