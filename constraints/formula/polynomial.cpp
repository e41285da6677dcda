#include "constraints/formula/polynomial.h"

#include <algorithm>
#include <cmath>

#include "constraints/formula/formula.h"

namespace reachlab::constraints {

Polynomial Polynomial::constant(double value) {
  Polynomial p;
  if (value != 0) p.terms_[{}] = value;
  return p;
}

Polynomial& Polynomial::operator+=(const Polynomial& other) {
  for (const auto& [monomial, coefficient] : other.terms_) terms_[monomial] += coefficient;
  return *this;
}

Polynomial& Polynomial::operator*=(double factor) {
  for (auto& [monomial, coefficient] : terms_) coefficient *= factor;
  return *this;
}

double Polynomial::largest() const {
  double most = 0;
  for (const auto& [monomial, coefficient] : terms_) most = std::max(most, std::abs(coefficient));
  return most;
}

std::optional<Polynomial> Polynomial::times(const Polynomial& other, const ExpressionGraph& graph, const double* shape) const {
  if (terms_.size() * other.terms_.size() > kMaxTerms) return std::nullopt;
  Polynomial product;
  for (const auto& [a, x] : terms_)
    for (const auto& [b, y] : other.terms_) {
      Monomial joined = a;
      for (const auto& [node, exponent] : b) joined[node] += exponent;
      product.terms_[joined] += x * y;
    }
  return product.reduced(graph, shape);
}

std::optional<Polynomial> Polynomial::reduced(const ExpressionGraph& graph, const double* shape) const {
  Polynomial current = *this;
  for (int round = 0; round < 40; ++round) {
    Polynomial next;
    bool changed = false;
    for (const auto& [monomial, coefficient] : current.terms_) {
      // The first indeterminate whose square has another form.
      std::optional<Polynomial> square;
      Monomial rest = monomial;
      for (const auto& [node, exponent] : monomial) {
        if (exponent < 2) continue;
        const ExpressionNode& n = graph.node(node);
        const auto complement = [&](Op op, double sign) -> std::optional<Polynomial> {
          // Only if its partner stands in the graph; by any name it would otherwise be a new indeterminate.
          for (int id = 0; id < graph.size(); ++id)
            if (graph.node(id).op == op && graph.node(id).a == n.a) {
              Polynomial p = constant(op == Op::Cos ? 1 : -1);
              p.terms_[{{id, 2}}] += sign;
              return p;
            }
          return std::nullopt;
        };
        if (n.op == Op::Sin) square = complement(Op::Cos, -1);
        else if (n.op == Op::Sinh) square = complement(Op::Cosh, 1);
        else if (n.op == Op::Sqrt) square = of(graph, n.a, shape);
        else if (n.op == Op::Abs) {
          if (const auto inner = of(graph, n.a, shape)) square = inner->times(*inner, graph, shape);
        }
        if (!square) continue;
        rest[node] -= 2;
        if (rest[node] == 0) rest.erase(node);
        break;
      }
      if (!square) {
        next.terms_[monomial] += coefficient;
        continue;
      }
      changed = true;
      for (const auto& [other, factor] : square->terms_) {
        Monomial joined = rest;
        for (const auto& [node, exponent] : other) joined[node] += exponent;
        next.terms_[joined] += coefficient * factor;
      }
      if (next.terms_.size() > kMaxTerms) return std::nullopt;
    }
    current = std::move(next);
    if (!changed) return current;
  }
  return std::nullopt;
}

std::optional<Polynomial> Polynomial::of(const ExpressionGraph& graph, int id, const double* shape) {
  const ExpressionNode& n = graph.node(id);
  const auto part = [&](int operand) { return of(graph, operand, shape); };
  const auto indeterminate = [&] {
    Polynomial p;
    p.terms_[{{id, 1}}] = 1;
    return std::optional(p);
  };
  switch (n.op) {
    case Op::Constant: return constant(n.value);
    case Op::Parameter: return constant(shape[n.a]);
    case Op::Add:
    case Op::Sub: {
      auto a = part(n.a), b = part(n.b);
      if (!a || !b) return std::nullopt;
      if (n.op == Op::Sub) *b *= -1;
      *a += *b;
      return a;
    }
    case Op::Neg: {
      auto a = part(n.a);
      if (a) *a *= -1;
      return a;
    }
    case Op::Mul: {
      const auto a = part(n.a), b = part(n.b);
      return a && b ? a->times(*b, graph, shape) : std::nullopt;
    }
    case Op::PowInt: {
      const auto a = part(n.a);
      std::optional<Polynomial> power = constant(1);
      for (int k = 0; a && power && k < n.b; ++k) power = power->times(*a, graph, shape);
      return a ? power : std::nullopt;
    }
    case Op::Div: {
      const auto b = part(n.b);
      if (!b || !(b->terms_.empty() || (b->terms_.size() == 1 && b->terms_.begin()->first.empty()))) return indeterminate();
      auto a = part(n.a);
      if (a) *a *= 1 / b->largest() * (b->terms_.empty() || b->terms_.begin()->second > 0 ? 1 : -1);
      return a;
    }
    default: return indeterminate();
  }
}

}  // namespace reachlab::constraints
