#include <array>
#include <cmath>
#include <utility>

#include "base/math/elementary.h"
#include "constraints/constraint.h"
#include "constraints/formula/program.h"
#include "constraints/formula/sincos.h"

// Direct-threaded: each operation ends with the jump to the next, so that the processor predicts each jump by its own history. Labels as
// values are an extension of g++ and clang.
namespace reachlab::constraints {
namespace {

constexpr int kCodeCount = static_cast<int>(Code::TwoSquare) + 1;
using HandlerTable = std::array<const void*, kCodeCount>;

// With `table` set it only tells its addresses; they exist nowhere else.
[[gnu::noinline]] void execute(const Instruction* i, double* r, HandlerTable* table) noexcept {
  if (table != nullptr) [[unlikely]] {
    *table = {&&load,   &&add,     &&addC,   &&sub,        &&rSubC,     &&mul,    &&mulC,      &&mulMulC, &&negMul, &&mulAdd,
              &&mulSub, &&rMulSub, &&div,    &&rDivC,      &&neg,       &&square, &&sinCosine, &&pow,     &&tan,    &&asin,
              &&acos,   &&atan,    &&atan2,  &&sinh,       &&cosh,      &&tanh,   &&exp,       &&log,     &&sqrt,   &&abs,
              &&sign,   &&stop,    &&twoMul, &&twoMulMulC, &&twoNegMul, &&twoNeg, &&twoSquare};
    return;
  }
#define NEXT \
  ++i;       \
  goto * i->handler
  goto * i->handler;
load:
  r[i->out] = i->number;
  NEXT;
add:
  r[i->out] = r[i->a] + r[i->b];
  NEXT;
addC:
  r[i->out] = r[i->a] + i->number;
  NEXT;
sub:
  r[i->out] = r[i->a] - r[i->b];
  NEXT;
rSubC:
  r[i->out] = i->number - r[i->a];
  NEXT;
mul:
  r[i->out] = r[i->a] * r[i->b];
  NEXT;
mulC:
  r[i->out] = i->number * r[i->a];
  NEXT;
mulMulC:
  r[i->out] = i->number * (r[i->a] * r[i->b]);
  NEXT;
negMul:
  r[i->out] = -(r[i->a] * r[i->b]);
  NEXT;
mulAdd:
  r[i->out] = r[i->a] * r[i->b] + r[i->c];
  NEXT;
mulSub:
  r[i->out] = r[i->a] * r[i->b] - r[i->c];
  NEXT;
rMulSub:
  r[i->out] = r[i->c] - r[i->a] * r[i->b];
  NEXT;
div:
  r[i->out] = r[i->a] / r[i->b];
  NEXT;
rDivC:
  r[i->out] = i->number / r[i->a];
  NEXT;
neg:
  r[i->out] = -r[i->a];
  NEXT;
square:
  r[i->out] = r[i->a] * r[i->a];
  NEXT;
sinCosine:
  sinCos(r[i->a], r[i->b], r[i->c]);
  NEXT;
pow:
  r[i->out] = elementary::pow(r[i->a], r[i->b]);
  NEXT;
tan:
  r[i->out] = elementary::tan(r[i->a]);
  NEXT;
asin:
  r[i->out] = elementary::asin(r[i->a]);
  NEXT;
acos:
  r[i->out] = elementary::acos(r[i->a]);
  NEXT;
atan:
  r[i->out] = elementary::atan(r[i->a]);
  NEXT;
atan2:
  r[i->out] = elementary::atan2(r[i->a], r[i->b]);
  NEXT;
sinh:
  r[i->out] = elementary::sinh(r[i->a]);
  NEXT;
cosh:
  r[i->out] = elementary::cosh(r[i->a]);
  NEXT;
tanh:
  r[i->out] = elementary::tanh(r[i->a]);
  NEXT;
exp:
  r[i->out] = elementary::exp(r[i->a]);
  NEXT;
log:
  r[i->out] = elementary::log(r[i->a]);
  NEXT;
sqrt:
  r[i->out] = std::sqrt(r[i->a]);
  NEXT;
abs:
  r[i->out] = std::abs(r[i->a]);
  NEXT;
sign:
  r[i->out] = signOf(r[i->a]);
  NEXT;
twoMul:
  r[i->out] = r[i->a] * r[i->b];
  ++i;
  r[i->out] = r[i->a] * r[i->b];
  NEXT;
twoMulMulC:
  r[i->out] = i->number * (r[i->a] * r[i->b]);
  ++i;
  r[i->out] = i->number * (r[i->a] * r[i->b]);
  NEXT;
twoNegMul:
  r[i->out] = -(r[i->a] * r[i->b]);
  ++i;
  r[i->out] = -(r[i->a] * r[i->b]);
  NEXT;
twoNeg:
  r[i->out] = -r[i->a];
  ++i;
  r[i->out] = -r[i->a];
  NEXT;
twoSquare:
  r[i->out] = r[i->a] * r[i->a];
  ++i;
  r[i->out] = r[i->a] * r[i->a];
  NEXT;
#undef NEXT
stop:;
}

const HandlerTable& handlers() noexcept {
  static const HandlerTable table = [] {
    HandlerTable t{};
    execute(nullptr, nullptr, &t);
    return t;
  }();
  return table;
}

// Number by number: a vector load of two numbers that were just stored one by one would wait for both to reach the cache.
template <std::size_t... k>
[[gnu::always_inline]] inline void copyOutputs(const double* registers, double* out, std::index_sequence<k...>) noexcept {
  ((out[k] = registers[k]), ...);
}

template <int kVariables, int kOutputs>
[[gnu::always_inline]] inline void evaluateProgram(const Program& p, const double* shape, const double* variables, double* out) noexcept {
  double registers[kMaxRegisters];
  for (int k = 0; k < kOutputs; ++k) registers[k] = p.constants[static_cast<std::size_t>(k)];
  for (int k = 0; k < p.parameterCount; ++k) registers[kOutputs + k] = shape[k];
  for (int k = 0; k < kVariables; ++k) registers[kOutputs + p.parameterCount + k] = variables[k];
  execute(p.instructions.data(), registers, nullptr);
  copyOutputs(registers, out, std::make_index_sequence<kOutputs>());
  for (const Program::Copy& copy : p.copies) out[copy.slot] = registers[copy.from];
}

}  // namespace

const void* handlerOf(Code code) noexcept { return handlers()[static_cast<std::size_t>(code)]; }

static_assert(sizeof(CurvePoint) == 9 * sizeof(double) && sizeof(SurfacePoint) == 18 * sizeof(double));

void evaluateCurveProgram(const void* program, const double* shape, double phi, CurvePoint& out) noexcept {
  evaluateProgram<1, 9>(*static_cast<const Program*>(program), shape, &phi, &out.r.x);
}

void evaluateSurfaceProgram(const void* program, const double* shape, double u, double v, SurfacePoint& out) noexcept {
  const double variables[2] = {u, v};
  evaluateProgram<2, 18>(*static_cast<const Program*>(program), shape, variables, &out.r.x);
}

}  // namespace reachlab::constraints
