#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "constraints/constraint_spec.h"
#include "constraints/formula/expression.h"

namespace reachlab::constraints {

/// Operations with one result, see resultOf. Those of a formula itself, and those in which several of a formula are joined. R: register, C:
/// number kept in the instruction.
#define REACHLAB_PLAIN_OPERATIONS(X) \
  X(Add)                             \
  X(Sub) X(Mul) X(Div) X(Neg) X(Pow) X(Tan) X(Asin) X(Acos) X(Atan) X(Atan2) X(Sinh) X(Cosh) X(Tanh) X(Exp) X(Log) X(Sqrt) X(Abs) X(Sign)
#define REACHLAB_JOINED_OPERATIONS(X) \
  X(Load) X(AddC) X(RSubC) X(MulC) X(MulMulC) X(NegMul) X(MulAdd) X(MulSub) X(RMulSub) X(RDivC) X(Square)
/// Two of these in a row, of the same kind, have one jump.
#define REACHLAB_PAIRED_OPERATIONS(X) X(Mul) X(MulMulC) X(NegMul) X(Neg) X(Square)

#define REACHLAB_CODE(name) name,
enum class Code : std::uint16_t { SinCos, Return, REACHLAB_JOINED_OPERATIONS(REACHLAB_CODE) REACHLAB_PLAIN_OPERATIONS(REACHLAB_CODE) };
#undef REACHLAB_CODE

struct Instruction {
  const void* handler = nullptr;  // where the interpreter jumps for it
  double number = 0;
  std::uint16_t a = 0, b = 0, c = 0;  // operand registers; SinCos: b receives the sine, c the cosine
  std::uint16_t out = 0;
};

inline constexpr int kMaxOutputs = 18;
inline constexpr int kMaxRegisters = 1024 + kMaxOutputs;

/// A formula with its derivatives as a list of operations on registers. The results come first: 9 or 18, in the order of CurvePoint's or
/// SurfacePoint's members, each computed in its register. Then come the shape, the variables, and the intermediate values. Immutable once
/// made. Any thread evaluates it, without allocation, recursion or loops.
struct Program {
  std::vector<Instruction> instructions;
  std::vector<Code> codes;  // of the instructions, before pairs were made
  std::uint16_t parameterCount = 0;
  std::array<double, kMaxOutputs> constants{};  // results that never change
  // Results that equal another result, a parameter or a variable.
  struct Copy {
    std::uint16_t slot, from;
  };
  std::vector<Copy> copies;
};

/// Compiles roots (x, y, z of r, then of each derivative, in the order of the point's members). Throws FaultError when it needs more
/// than kMaxRegisters.
Program compileProgram(ExpressionGraph& graph, std::span<const int> roots, int parameterCount, int variableCount);

/// The interpreter, in the form of the functions of constraint.h. `program` points to a Program.
void evaluateCurveProgram(const void* program, const double* shape, double phi, CurvePoint& out) noexcept;
void evaluateCurveBatchProgram(const void* program, const double* shape, const double* phi, CurveBatch& out) noexcept;
void evaluateSurfaceProgram(const void* program, const double* shape, double u, double v, SurfacePoint& out) noexcept;

/// Address that the interpreter jumps to for an operation.
const void* handlerOf(Code code) noexcept;
/// The same for two instructions of one operation in a row, or null.
const void* handlerOfTwo(Code code) noexcept;

}  // namespace reachlab::constraints
