#include <array>
#include <utility>

#include "constraints/constraint.h"
#include "constraints/formula/operations.h"

// Direct-threaded: each operation ends with the jump to the next, so that the processor predicts each jump by its own history. Labels as
// values are an extension of g++ and clang.
namespace reachlab::constraints {
namespace {

struct HandlerTable {
  std::array<const void*, static_cast<std::size_t>(Code::Sign) + 1> one{}, two{};
};

template <Code code>
[[gnu::always_inline]] inline void compute(const Instruction& i, double* r) noexcept {
  r[i.out] = resultOf<code>(r[i.a], r[i.b], r[i.c], i.number);
}

// With `table` set it only tells its addresses; they exist nowhere else.
[[gnu::noinline]] void execute(const Instruction* i, double* r, HandlerTable* table) noexcept {
#define ADDRESS(name) &&name,
#define ADDRESS_OF_TWO(name) all.two[static_cast<std::size_t>(Code::name)] = &&Two##name;
  if (table != nullptr) [[unlikely]] {
    HandlerTable all{{&&SinCos, &&Return, REACHLAB_JOINED_OPERATIONS(ADDRESS) REACHLAB_PLAIN_OPERATIONS(ADDRESS)}, {}};
    REACHLAB_PAIRED_OPERATIONS(ADDRESS_OF_TWO)
    *table = all;
    return;
  }
#define NEXT \
  ++i;       \
  goto * i->handler
#define HANDLE(name)          \
  name:                       \
  compute<Code::name>(*i, r); \
  NEXT;
#define HANDLE_TWO(name)                  \
  Two##name : compute<Code::name>(*i, r); \
  ++i;                                    \
  compute<Code::name>(*i, r);             \
  NEXT;
  goto * i->handler;
  REACHLAB_JOINED_OPERATIONS(HANDLE)
  REACHLAB_PLAIN_OPERATIONS(HANDLE)
  REACHLAB_PAIRED_OPERATIONS(HANDLE_TWO)
SinCos:
  sinCos(r[i->a], r[i->b], r[i->c]);
  NEXT;
Return:;
#undef HANDLE_TWO
#undef HANDLE
#undef NEXT
#undef ADDRESS_OF_TWO
#undef ADDRESS
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

const void* handlerOf(Code code) noexcept { return handlers().one[static_cast<std::size_t>(code)]; }
const void* handlerOfTwo(Code code) noexcept { return handlers().two[static_cast<std::size_t>(code)]; }

static_assert(sizeof(CurvePoint) == 9 * sizeof(double) && sizeof(SurfacePoint) == 18 * sizeof(double));

void evaluateCurveProgram(const void* program, const double* shape, double phi, CurvePoint& out) noexcept {
  evaluateProgram<1, 9>(*static_cast<const Program*>(program), shape, &phi, &out.r.x);
}

void evaluateSurfaceProgram(const void* program, const double* shape, double u, double v, SurfacePoint& out) noexcept {
  const double variables[2] = {u, v};
  evaluateProgram<2, 18>(*static_cast<const Program*>(program), shape, variables, &out.r.x);
}

}  // namespace reachlab::constraints
