#!/usr/bin/env python3
"""The least hand jerk along every curve and surface of the catalogue by another formulation than the program's: the necessary conditions.

    /usr/bin/python3 tests/predict/path_reference.py constraints/definitions [NAME ...] > tests/predict/path_reference.tsv

A hand moves in 1 s from a definition's start to its target, at rest with r'' = 0 at both ends, the integral of |r'''|^2 least. The program
minimises that integral over polynomials. Here Pontryagin's conditions are solved as a boundary value problem: with q the parameters,
w = q''' and H = |r'''|^2 + p1 q' + p2 q'' + p3 w, dH/dw = 0 gives w, and q, q', q'', p1, p2, p3 follow q' ..., p1' = -dH/dq, p2' = -dH/dq',
p3' = -dH/dq'', q given at both ends. Derivatives of r by SymPy to order four, Newton with the Jacobian by complex steps, collocation at Legendre's
points with six conditions an unknown, on elements that are doubled until two solutions agree. The guess comes from a minimum over few Chebyshev
polynomials, from a straight and from bent starts; the lowest counts.

Columns: name, cost [m^2/s^5], how far the two last speeds differ (of the peak), then the speed |r'| [m/s] at i/40 s.
"""
import itertools
import json
import math
import pathlib
import sys

import numpy as np
import sympy as sp
from scipy.optimize import least_squares
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import splu

SAMPLES = 41


class Place:
    """r and its partial derivatives to order four, as arrays over many points."""

    def __init__(self, definition):
        names = ["phi"] if definition["kind"] == "curve" else ["u", "v"]
        symbols = sp.symbols(names, real=True)
        self.d = len(names)
        known = dict(zip(names, symbols), pi=sp.pi, e=sp.E)
        known.update({key: sp.Float(value["default"], 40) for key, value in definition.get("shape", {}).items()})
        parse = lambda text: sp.sympify(str(text).replace("^", "**"), locals=known)
        r = [parse(text) for text in definition[definition["kind"]]]
        self.start = [float(parse(x)) for x in definition["start"]]
        self.target = [float(parse(x)) for x in definition["target"]]
        self.index = [m for order in range(5) for m in itertools.combinations_with_replacement(range(self.d), order)]
        expressions = []
        for m in self.index:
            for k in range(3):
                e = r[k]
                for i in m:
                    e = sp.diff(e, symbols[i])
                expressions.append(e)
        self.function = sp.lambdify(symbols, expressions, "numpy", cse=True)

    def at(self, q):
        """Dictionary from a sorted tuple of parameter indices to an array (3, points)."""
        values = self.function(*q)
        full = [np.broadcast_to(np.asarray(v, dtype=q.dtype), q.shape[1:]) for v in values]
        return {m: np.array(full[3 * i:3 * i + 3]) for i, m in enumerate(self.index)}


def contract(D, order, vectors, d, free=False):
    """Sum over indices of D_{i j ...} a_i b_j ...; `free`: the last index stays, as a first axis."""
    given = len(vectors)
    out = 0 if not free else [0] * d
    for m in itertools.product(range(d), repeat=given):
        factor = 1
        for k in range(given):
            factor = factor * vectors[k][m[k]]
        if free:
            for j in range(d):
                out[j] = out[j] + D[tuple(sorted(m + (j,)))] * factor
        else:
            out = out + D[tuple(sorted(m))] * factor
    assert given + free == order
    return out


def jerk(D, a, b, w, d):
    return contract(D, 3, [a, a, a], d) + 3 * contract(D, 2, [a, b], d) + contract(D, 1, [w], d)


def jerk_by(D, a, b, w, d):
    """Its derivatives by q, q', q'': lists over the parameters."""
    x, y, z = (contract(D, 4, [a, a, a], d, True), contract(D, 3, [a, b], d, True), contract(D, 2, [w], d, True))
    by_q = [x[j] + 3 * y[j] + z[j] for j in range(d)]
    x, y = contract(D, 3, [a, a], d, True), contract(D, 2, [b], d, True)
    by_a = [3 * x[j] + 3 * y[j] for j in range(d)]
    x = contract(D, 2, [a], d, True)
    return by_q, by_a, [3 * x[j] for j in range(d)]


def dot(a, b):
    return (a * b).sum(axis=0)


def control(D, a, b, p3, d):
    """w from dH/dw = 0: J^T J w = -J^T c - p3/2, c the jerk without w."""
    J = [D[(i,)] for i in range(d)]
    c = contract(D, 3, [a, a, a], d) + 3 * contract(D, 2, [a, b], d)
    right = [-dot(J[i], c) - p3[i] / 2 for i in range(d)]
    if d == 1:
        return np.array([right[0] / dot(J[0], J[0])])
    e, f, g = dot(J[0], J[0]), dot(J[0], J[1]), dot(J[1], J[1])
    det = e * g - f * f
    return np.array([(g * right[0] - f * right[1]) / det, (e * right[1] - f * right[0]) / det])


def rate(place, y):
    d = place.d
    q, a, b, p1, p2, p3 = (y[k * d:(k + 1) * d] for k in range(6))
    D = place.at(q)
    w = control(D, a, b, p3, d)
    R = jerk(D, a, b, w, d)
    by_q, by_a, by_b = jerk_by(D, a, b, w, d)
    f = [np.array([2 * dot(R, by[j]) for j in range(d)]) for by in (by_q, by_a, by_b)]
    return np.concatenate([a, b, w, -f[0], -p1 - f[1], -p2 - f[2]])


def lobatto(n):
    """Legendre-Gauss-Lobatto points of n + 1 and the matrix of derivatives."""
    inner = np.polynomial.legendre.Legendre.basis(n).deriv().roots().real
    x = np.concatenate([[-1], np.sort(inner), [1]])
    P = np.polynomial.legendre.Legendre.basis(n)
    p, dp, ddp = P(x), P.deriv()(x), P.deriv(2)(x)
    for _ in range(3):  # the points to the last digit
        step = np.where(np.abs(x) < 1, dp / np.where(ddp == 0, 1, ddp), 0)
        step[0] = step[-1] = 0
        x = x - step
        p, dp, ddp = P(x), P.deriv()(x), P.deriv(2)(x)
    diff = x[:, None] - x[None, :]
    np.fill_diagonal(diff, 1)
    M = p[:, None] / (p[None, :] * diff)
    np.fill_diagonal(M, 0)
    np.fill_diagonal(M, -M.sum(axis=1))
    return x, M


def interpolate(x, values, at):
    """Barycentric, from one element's points; `values` (numbers, points)."""
    weight = np.array([1 / np.prod(2 * (x[i] - np.delete(x, i))) for i in range(len(x))])
    out = np.empty((values.shape[0], len(at)))
    for k, t in enumerate(at):
        apart = t - x
        hit = np.abs(apart) < 1e-15
        if hit.any():
            out[:, k] = values[:, hit.argmax()]
        else:
            c = weight / apart
            out[:, k] = values @ c / c.sum()
    return out


class Solution:
    def __init__(self, edges, x, y):
        self.edges, self.x, self.y = edges, x, y  # y: numbers, elements, points

    def at(self, times):
        out = np.empty((self.y.shape[0], len(times)))
        element = np.clip(np.searchsorted(self.edges, times, side="right") - 1, 0, len(self.edges) - 2)
        for k in np.unique(element):
            which = element == k
            local = 2 * (times[which] - self.edges[k]) / (self.edges[k + 1] - self.edges[k]) - 1
            out[:, which] = interpolate(self.x, self.y[:, k], local)
        return out


def collocate(place, guess, elements, degree, tell):
    d, n = place.d, 6 * place.d
    edges = np.linspace(0, 1, elements + 1)
    x, M = lobatto(degree)
    h = 1.0 / elements
    times = (edges[:-1, None] + (x[None, :] + 1) / 2 * h)
    y = guess(times.ravel()).reshape(n, elements, degree + 1)
    points = degree + 1
    size = n * elements * points
    index = np.arange(size).reshape(n, elements, points)
    ends = np.concatenate([place.start, np.zeros(2 * d)]), np.concatenate([place.target, np.zeros(2 * d)])
    # Numbers of one kind are measured in their own size, so that the elimination's pivots mean something.
    last = np.inf
    for iteration in range(60):
        flat = y.reshape(n, -1)
        F = rate(place, flat).reshape(n, elements, points)
        step = 1e-30
        jacobian = np.empty((n, n, elements, points))
        for j in range(n):
            moved = flat.astype(complex)
            moved[j] += 1j * step
            jacobian[:, j] = (rate(place, moved).imag / step).reshape(n, elements, points)
        size_of = np.maximum(np.abs(y).max(axis=(1, 2)), 1e-12)
        rows, columns, values, right = [], [], [], []
        count = 0

        def add(row, column, value):
            rows.append(row), columns.append(column), values.append(value)

        # derivatives at all points but the first of each element
        residual = np.einsum("ij,nej->nei", M, y) - h / 2 * F
        for i in range(n):
            for e in range(elements):
                base = count
                for p in range(1, points):
                    add(np.full(points, base), index[i, e], M[p] * size_of[i] / size_of[i])
                    add(np.full(n, base), index[:, e, p], -h / 2 * jacobian[i, :, e, p] * size_of / size_of[i])
                    right.append(-residual[i, e, p] / size_of[i])
                    base += 1
                count = base
        for i in range(n):
            for e in range(elements - 1):
                add([count, count], [index[i, e, -1], index[i, e + 1, 0]], [1.0, -1.0])
                right.append(-(y[i, e, -1] - y[i, e + 1, 0]) / size_of[i])
                count += 1
        for i in range(3 * d):
            for e, p, end in ((0, 0, ends[0]), (elements - 1, -1, ends[1])):
                add([count], [index[i, e, p]], [1.0])
                right.append(-(y[i, e, p] - end[i]) / size_of[i])
                count += 1
        assert count == size
        A = csc_matrix(coo_matrix((np.concatenate([np.asarray(v, float) for v in values]),
                                   (np.concatenate([np.asarray(r) for r in rows]), np.concatenate([np.asarray(c) for c in columns]))),
                                  shape=(size, size)))
        right = np.array(right)
        change = splu(A).solve(right).reshape(n, elements, points)
        largest = np.abs(change).max()
        if not np.isfinite(largest):
            raise ArithmeticError("Newton left the finite numbers")
        y = y + min(1.0, 0.5 / largest) * change * size_of[:, None, None]
        tell(f"    {elements} elements, round {iteration}: change {largest:.1e}")
        if largest < 1e-13 or (largest < 1e-9 and largest > 0.3 * last):
            return Solution(edges, x, y)
        last = largest
    raise ArithmeticError("no solution within 60 rounds")


def basis(count, t):
    """[t(1-t)]^3 T_k and three derivatives: (4, count, times)."""
    out = np.empty((4, count, len(t)))
    shape = (np.polynomial.Polynomial([0, 1]) * np.polynomial.Polynomial([1, -1])) ** 3
    s = [shape] + [shape.deriv(k) for k in (1, 2, 3)]
    for k in range(count):
        T = np.polynomial.Chebyshev.basis(k)
        c = [T] + [T.deriv(j) for j in (1, 2, 3)]
        v = [c[j](2 * t - 1) * 2.0**j for j in range(4)]
        for order in range(4):
            out[order, k] = sum(math.comb(order, j) * s[j](t) * v[order - j] for j in range(order + 1))
    return out.astype(float)


def direct(place, count, start):
    """A minimum over `count` polynomials a parameter; returns the cost and q with three derivatives as a function of t."""
    d = place.d
    t, weight = np.polynomial.legendre.leggauss(4 * count)
    t, weight = (t + 1) / 2, weight / 2
    law = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
    B = basis(count, t)
    way = np.array(place.target) - np.array(place.start)

    def motion(c, t, B):
        q = [np.array([place.start[i] * (k == 0) + way[i] * law.deriv(k)(t) if k else place.start[i] + way[i] * law(t) for i in range(d)])
             for k in range(4)]
        return [q[k] + np.array([c[i * count:(i + 1) * count] @ B[k] for i in range(d)]) for k in range(4)]

    root = np.sqrt(weight)

    def residual(c):
        q, a, b, w = motion(c, t, B)
        return (jerk(place.at(q), a, b, w, d) * root).ravel()

    def jacobian(c):
        q, a, b, w = motion(c, t, B)
        D = place.at(q)
        by_q, by_a, by_b = jerk_by(D, a, b, w, d)
        columns = []
        for i in range(d):
            J = D[(i,)]
            for k in range(count):
                columns.append(((by_q[i] * B[0, k] + by_a[i] * B[1, k] + by_b[i] * B[2, k] + J * B[3, k]) * root).ravel())
        return np.array(columns).T

    found = least_squares(residual, start, jacobian, method="trf", x_scale="jac", xtol=1e-15, ftol=1e-15, gtol=1e-15, max_nfev=400)

    def at(times):
        return motion(found.x, times, basis(count, times))

    return 2 * found.cost, at, found.x


def guess_of(place, at):
    """State and costates from a motion; the costates' derivatives by fine differences of what they are made of."""
    d = place.d

    def costates(times):
        q, a, b, w = at(times)
        D = place.at(q)
        R = jerk(D, a, b, w, d)
        _, by_a, by_b = jerk_by(D, a, b, w, d)
        p3 = np.array([-2 * dot(D[(i,)], R) for i in range(d)])
        return q, a, b, p3, np.array([2 * dot(R, by_a[j]) for j in range(d)]), np.array([2 * dot(R, by_b[j]) for j in range(d)])

    n = 400
    nodes = (1 - np.cos(np.pi * np.arange(n + 1) / n)) / 2
    q, a, b, p3, fa, fb = costates(nodes)
    fit = lambda v: np.polynomial.Chebyshev.fit(nodes, v, 60, domain=[0, 1])

    def state(times):
        q, a, b, p3, fa, fb = costates(times)
        p1, p2 = np.empty_like(q), np.empty_like(q)
        for j in range(d):
            third = fit(costates(nodes)[3][j])
            second = -third.deriv() - fit(costates(nodes)[5][j])
            p2[j] = second(times)
            p1[j] = (-second.deriv() - fit(costates(nodes)[4][j]))(times)
        return np.concatenate([q, a, b, p1, p2, p3])

    return state


def speeds(place, y):
    d = place.d
    D = place.at(y[:d])
    return np.sqrt((contract(D, 1, [y[d:2 * d]], d) ** 2).sum(axis=0))


def cost_of(place, solution, elements):
    t, weight = np.polynomial.legendre.leggauss(16)
    d, total = place.d, 0.0
    for e in range(elements):
        y = solution.at((e + (t + 1) / 2) / elements)
        D = place.at(y[:d])
        R = jerk(D, y[d:2 * d], y[2 * d:3 * d], control(D, y[d:2 * d], y[2 * d:3 * d], y[5 * d:], d), d)
        total += (weight / 2 / elements) @ dot(R, R)
    return total


def solve(definition, tell):
    place = Place(definition)
    d = place.d
    best = None
    few = 14 if d == 2 else 24
    way = np.array(place.target) - np.array(place.start)
    starts = [np.zeros(few * d)]
    for i in range(d):
        for sign in (-1, 1):
            bent = np.zeros(few * d)
            bent[i * few] = sign * 64 * 0.2 * max(np.abs(way).max(), 1e-3)
            starts.append(bent)
    for start in starts if d == 2 else starts[:1]:
        try:
            found = direct(place, few, start)
        except (ValueError, np.linalg.LinAlgError):
            continue
        tell(f"  direct: cost {found[0]:.12g}")
        if np.isfinite(found[0]) and (best is None or found[0] < best[0] * (1 - 1e-6)):
            best = found
    more = 2 * few if d == 2 else 3 * few
    start = np.concatenate([np.pad(best[2][i * few:(i + 1) * few], (0, more - few)) for i in range(d)])
    best = direct(place, more, start)
    tell(f"  direct, more: cost {best[0]:.15g}")
    guess, last, times = guess_of(place, best[1]), None, np.linspace(0, 1, SAMPLES)
    elements = 8
    while True:
        solution = collocate(place, guess, elements, 16, tell)
        v = speeds(place, solution.at(times))
        if last is not None:
            differ = np.abs(v - last).max() / v.max()
            tell(f"  {elements} elements: speeds differ by {differ:.1e}")
            if differ < 2e-12 or elements >= 256:
                return cost_of(place, solution, elements), differ, v
        last, elements = v, 2 * elements
        guess = solution.at


def main():
    folder = pathlib.Path(sys.argv[1])
    wanted = sys.argv[2:]
    tell = (lambda text: print(text, file=sys.stderr)) if wanted else (lambda text: None)
    for path in sorted(folder.glob("*.json")):
        definition = json.loads(path.read_text())
        if wanted and definition["name"] not in wanted:
            continue
        try:
            with np.errstate(all="ignore"):
                cost, differ, v = solve(definition, tell)
        except Exception as failure:  # a cusp on the way, say: the program has to refuse it as well, or the test tells
            print(f"{definition['name']}: {failure}", file=sys.stderr)
            continue
        print(definition["name"], f"{cost:.16g}", f"{differ:.1e}", *(f"{x:.16g}" for x in v), sep="\t", flush=True)


if __name__ == "__main__":
    main()
