#include <cstring>

#include "constraints/curve_batch.h"
#include "constraints/formula/operations.h"

// The interpreter for eight parameter values: each instruction's jump is paid once for eight results.
namespace reachlab::constraints {
namespace {

using Register = double[kBatchLanes];

template <Code code>
[[gnu::always_inline]] inline void computeInLanes(const Instruction& i, Register* r) noexcept {
  const Register &a = r[i.a], &b = r[i.b], &c = r[i.c];
  const double number = i.number;
  Register result;
#pragma GCC unroll 1  // unrolled, g++ 12 would not put it in lanes
  for (int lane = 0; lane < kBatchLanes; ++lane) result[lane] = resultOf<code>(a[lane], b[lane], c[lane], number);
  std::memcpy(r[i.out], result, sizeof(Register));
}

void sinCosInLanes(const Register& x, Register& sine, Register& cosine) noexcept {
  Register s, c;
  std::uint64_t far = 0;
#pragma GCC unroll 1
  for (int lane = 0; lane < kBatchLanes; ++lane) far |= sinCosNear(x[lane], s[lane], c[lane]);
  if (far != 0)
    for (int lane = 0; lane < kBatchLanes; ++lane) sinCos(x[lane], s[lane], c[lane]);
  std::memcpy(sine, s, sizeof(Register));
  std::memcpy(cosine, c, sizeof(Register));
}

void execute(const Program& program, Register* r) noexcept {
  const Instruction* i = program.instructions.data();
  for (const Code code : program.codes) {
#define CASE(name) \
  case Code::name: computeInLanes<Code::name>(*i, r); break;
    switch (code) {
      REACHLAB_JOINED_OPERATIONS(CASE)
      REACHLAB_PLAIN_OPERATIONS(CASE)
      case Code::SinCos: sinCosInLanes(r[i->a], r[i->b], r[i->c]); break;
      case Code::Return: return;
    }
#undef CASE
    ++i;
  }
}

}  // namespace

void evaluateCurveBatchProgram(const void* program, const double* shape, const double* phi, CurveBatch& out) noexcept {
  constexpr int kOutputs = 9;
  static_assert(sizeof(CurveBatch) == kOutputs * sizeof(Register));
  const Program& p = *static_cast<const Program*>(program);
  alignas(64) Register registers[kMaxRegisters];
  const auto fill = [&](int k, double value) {
    for (double& lane : registers[k]) lane = value;
  };
  for (int k = 0; k < kOutputs; ++k) fill(k, p.constants[k]);
  for (int k = 0; k < p.parameterCount; ++k) fill(kOutputs + k, shape[k]);
  std::memcpy(registers[kOutputs + p.parameterCount], phi, sizeof(Register));
  execute(p, registers);
  std::memcpy(&out, registers, sizeof(CurveBatch));
  for (const Program::Copy& copy : p.copies) std::memcpy(&out.r[0][0] + kBatchLanes * copy.slot, registers[copy.from], sizeof(Register));
}

}  // namespace reachlab::constraints
