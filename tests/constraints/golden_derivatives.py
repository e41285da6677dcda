#!/usr/bin/python3
"""Derivatives of every definition by SymPy, an independent way: symbolic differentiation of the definition's text, evaluated with 40
digits by mpmath at seeded random points, default shape. Writes tests/constraints/golden_derivatives.csv:
name, parameters, then for each derivative and coordinate the value and the sum of its absolute terms (the scale of its rounding).

    python3 tests/constraints/golden_derivatives.py constraints/definitions > tests/constraints/golden_derivatives.csv
"""
import json, pathlib, random, re, sys
import sympy as sp

POINTS = 3
DIGITS = 40


def parse(text, names):
    text = text.replace("^", "**")
    return sp.sympify(re.sub(r"(?<![\w.])(\d+(\.\d+)?)(?![\w.])", r"Rational('\1')", text), locals=names | {"e": sp.E, "Rational": sp.Rational})


def absolute_terms(expression, values):
    """Sum of the absolute values of the terms after expansion: what rounding is relative to. A sine or cosine counts with its
    amplitude 1, for the rounding of its argument moves it even where it vanishes."""
    waves = lambda term: term.replace(lambda x: isinstance(x, (sp.sin, sp.cos)), lambda x: sp.Integer(1))
    def scale(term):
        sizes = [abs(sp.N(t.subs(values), DIGITS)) for t in (term, waves(term))]
        return max(size for size in sizes if size.is_finite)
    return sum(scale(term) for term in sp.Add.make_args(sp.expand(expression)))


def main(folder):
    rng = random.Random(20140603)
    for path in sorted(pathlib.Path(folder).glob("*.json")):
        d = json.loads(path.read_text())
        curve = d["kind"] == "curve"
        variables = sp.symbols("phi" if curve else "u v", real=True)
        variables = [variables] if curve else list(variables)
        shape = {k: sp.Symbol(k, positive=True) for k in d["shape"]}
        names = {str(s): s for s in variables} | shape
        r = [parse(t, names) for t in d[d["kind"]]]
        orders = [()] + ([(0,), (0, 0)] if curve else [(0,), (1,), (0, 0), (0, 1), (1, 1)])
        defaults = {shape[k]: sp.Rational(repr(p["default"])) for k, p in d["shape"].items()}
        exact = {shape[k]: sp.Float(p["default"], DIGITS) for k, p in d["shape"].items()}  # the double itself
        domain = [d["domain"]] if curve else (d["domain"] or [None, None])
        for _ in range(POINTS):
            at = []
            for k, _v in enumerate(variables):
                lo, hi = domain[k] if domain[k] else (None, None)
                value = lambda t, other: float(parse(str(t), names).subs(defaults)) if t is not None else other
                lo, hi = value(lo, -3.0), value(hi, 3.0)
                at.append(rng.uniform(lo + 0.01 * (hi - lo), hi - 0.01 * (hi - lo)))
            values = {v: sp.Float(a, DIGITS) for v, a in zip(variables, at)} | exact
            row = [d["name"]] + [repr(a) for a in at]
            for order in orders:
                for coordinate in r:
                    derivative = coordinate
                    for k in order:
                        derivative = sp.diff(derivative, variables[k])
                    row += [sp.N(derivative.subs(values), 20), sp.N(absolute_terms(derivative, values), 6)]
            print(",".join(str(x) for x in row))
            sys.stdout.flush()


main(sys.argv[1])
