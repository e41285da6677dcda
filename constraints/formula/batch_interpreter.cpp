#include <cmath>
#include <cstring>

#include "base/math/elementary.h"
#include "constraints/curve_batch.h"
#include "constraints/formula/program.h"
#include "constraints/formula/sincos.h"

// The interpreter for eight parameter values: each instruction's jump is paid once for eight results.
namespace reachlab::constraints {
namespace {

using Register = double[kBatchLanes];

template <class Operation>
[[gnu::always_inline]] inline void inLanes(Register& out, const Operation& operation) noexcept {
  Register result;
#pragma GCC unroll 1  // unrolled, g++ 12 would not put it in lanes
  for (int lane = 0; lane < kBatchLanes; ++lane) result[lane] = operation(lane);
  std::memcpy(out, result, sizeof(Register));
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
    const Register &a = r[i->a], &b = r[i->b], &c = r[i->c];
    Register& out = r[i->out];
    const double number = i->number;
    const auto put = [&out](const auto& operation) { inLanes(out, operation); };
    switch (code) {
      case Code::Load: put([&](int) { return number; }); break;
      case Code::Add: put([&](int k) { return a[k] + b[k]; }); break;
      case Code::AddC: put([&](int k) { return a[k] + number; }); break;
      case Code::Sub: put([&](int k) { return a[k] - b[k]; }); break;
      case Code::RSubC: put([&](int k) { return number - a[k]; }); break;
      case Code::Mul:
      case Code::TwoMul: put([&](int k) { return a[k] * b[k]; }); break;
      case Code::MulC: put([&](int k) { return number * a[k]; }); break;
      case Code::MulMulC:
      case Code::TwoMulMulC: put([&](int k) { return number * (a[k] * b[k]); }); break;
      case Code::NegMul:
      case Code::TwoNegMul: put([&](int k) { return -(a[k] * b[k]); }); break;
      case Code::MulAdd: put([&](int k) { return a[k] * b[k] + c[k]; }); break;
      case Code::MulSub: put([&](int k) { return a[k] * b[k] - c[k]; }); break;
      case Code::RMulSub: put([&](int k) { return c[k] - a[k] * b[k]; }); break;
      case Code::Div: put([&](int k) { return a[k] / b[k]; }); break;
      case Code::RDivC: put([&](int k) { return number / a[k]; }); break;
      case Code::Neg:
      case Code::TwoNeg: put([&](int k) { return -a[k]; }); break;
      case Code::Square:
      case Code::TwoSquare: put([&](int k) { return a[k] * a[k]; }); break;
      case Code::SinCos: sinCosInLanes(a, r[i->b], r[i->c]); break;
      case Code::Pow: put([&](int k) { return elementary::pow(a[k], b[k]); }); break;
      case Code::Tan: put([&](int k) { return elementary::tan(a[k]); }); break;
      case Code::Asin: put([&](int k) { return elementary::asin(a[k]); }); break;
      case Code::Acos: put([&](int k) { return elementary::acos(a[k]); }); break;
      case Code::Atan: put([&](int k) { return elementary::atan(a[k]); }); break;
      case Code::Atan2: put([&](int k) { return elementary::atan2(a[k], b[k]); }); break;
      case Code::Sinh: put([&](int k) { return elementary::sinh(a[k]); }); break;
      case Code::Cosh: put([&](int k) { return elementary::cosh(a[k]); }); break;
      case Code::Tanh: put([&](int k) { return elementary::tanh(a[k]); }); break;
      case Code::Exp: put([&](int k) { return elementary::exp(a[k]); }); break;
      case Code::Log: put([&](int k) { return elementary::log(a[k]); }); break;
      case Code::Sqrt: put([&](int k) { return std::sqrt(a[k]); }); break;
      case Code::Abs: put([&](int k) { return std::abs(a[k]); }); break;
      case Code::Sign: put([&](int k) { return signOf(a[k]); }); break;
      case Code::Return: return;
    }
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
