#!/usr/bin/python3
"""Minimax coefficients of constraints/formula/sincos.h: Remez exchange in 60 digits, relative weight, then rounded one by one to doubles
(each later coefficient refitted to what the rounding of the earlier ones left).

sin y = y + y^3 P(y^2),  cos y = 1 - y^2/2 + y^4 Q(y^2),  |y| <= pi/4 (a little more for the rounding of the quadrant)."""
from mpmath import mp, mpf, sin, cos, sqrt, matrix, lu_solve, pi, chop

mp.dps = 60
HI = (pi / 4 * (1 + mpf(2) ** -20)) ** 2


def p_exact(z):
    if z < mpf(10) ** -12:
        return -mpf(1) / 6 + z / 120 - z * z / 5040
    y = sqrt(z)
    return (sin(y) - y) / y ** 3


def q_exact(z):
    if z < mpf(10) ** -12:
        return mpf(1) / 24 - z / 720 + z * z / 40320
    return (cos(sqrt(z)) - 1 + z / 2) / z ** 2


def remez(f, weight, free):
    """Best c with max |weight(z) (sum c_k z^k - f(z))| over the powers `free`; f already lacks the fixed ones."""
    n = len(free)
    nodes = [HI * (1 - mp.cos(pi * (2 * k + 1) / (2 * n + 2))) / 2 for k in range(n + 1)]
    for _ in range(12):
        a, b = matrix(n + 1, n + 1), matrix(n + 1, 1)
        for i, z in enumerate(nodes):
            for j, power in enumerate(free):
                a[i, j] = z ** power
            a[i, n] = (-1) ** i / weight(z)
            b[i] = f(z)
        c = lu_solve(a, b)
        error = lambda z: weight(z) * (sum(c[j] * z ** p for j, p in enumerate(free)) - f(z))
        grid = [HI * mpf(k) / 1200 for k in range(1, 1201)]
        values = [error(z) for z in grid]
        extrema, best = [], 0
        for k in range(1, len(grid)):
            if (values[k] > 0) != (values[best] > 0):
                extrema.append(best)
                best = k
            elif abs(values[k]) > abs(values[best]):
                best = k
        extrema.append(best)
        if len(extrema) < n + 1:
            break
        nodes = [grid[k] for k in extrema[: n + 1]]
    return c


def rounded(exact, weight, degree):
    fixed = []
    for k in range(degree + 1):
        rest = lambda z: exact(z) - sum(mpf(c) * z ** i for i, c in enumerate(fixed))
        fixed.append(float(remez(rest, weight, list(range(k, degree + 1)))[0]))
    return fixed


print("kSin", ", ".join(c.hex() for c in rounded(p_exact, lambda z: z, 5)))
print("kCos", ", ".join(c.hex() for c in rounded(q_exact, lambda z: z * z, 5)))
