#pragma once
#include "constraints/formula/formula.h"

namespace reachlab::constraints {

/// From now on `watch` is called with every formula before it is compiled, in the thread that compiles it. Null ends the watch.
void watchCompilations(void (*watch)(const FormulaText& text));

}  // namespace reachlab::constraints
