#pragma once
#include <cmath>

#include "base/math/elementary.h"
#include "constraints/formula/program.h"
#include "constraints/formula/sincos.h"

namespace reachlab::constraints {

/// The result of an operation on its operands and its number, for both interpreters and for single numbers.
template <Code code>
[[gnu::always_inline]] inline double resultOf(double a, double b, double c, double number) noexcept {
  switch (code) {
    case Code::Load: return number;
    case Code::Add: return a + b;
    case Code::AddC: return a + number;
    case Code::Sub: return a - b;
    case Code::RSubC: return number - a;
    case Code::Mul: return a * b;
    case Code::MulC: return number * a;
    case Code::MulMulC: return number * (a * b);
    case Code::NegMul: return -(a * b);
    case Code::MulAdd: return a * b + c;
    case Code::MulSub: return a * b - c;
    case Code::RMulSub: return c - a * b;
    case Code::Div: return a / b;
    case Code::RDivC: return number / a;
    case Code::Neg: return -a;
    case Code::Square: return a * a;
    case Code::Pow: return elementary::pow(a, b);
    case Code::Tan: return elementary::tan(a);
    case Code::Asin: return elementary::asin(a);
    case Code::Acos: return elementary::acos(a);
    case Code::Atan: return elementary::atan(a);
    case Code::Atan2: return elementary::atan2(a, b);
    case Code::Sinh: return elementary::sinh(a);
    case Code::Cosh: return elementary::cosh(a);
    case Code::Tanh: return elementary::tanh(a);
    case Code::Exp: return elementary::exp(a);
    case Code::Log: return elementary::log(a);
    case Code::Sqrt: return std::sqrt(a);
    case Code::Abs: return std::abs(a);
    case Code::Sign: return signOf(a);
    case Code::SinCos:
    case Code::Return: break;  // no single result
  }
  return 0;
}

}  // namespace reachlab::constraints
