"""Lines with hard features, each with its value and slope, and the time along a curve of three of them.

All are sums of Gauss-Legendre panels in numbers of 64 bits mantissa (numpy.longdouble), graded towards every feature, and each is summed by
two rules."""
import math

import mpmath
import numpy as np

LD = np.longdouble
PI = LD("3.14159265358979323846264338327950288")
INF = math.inf


def rule(count):
    mpmath.mp.dps = 30
    nodes, weights = [], []
    for k in range(1, count + 1):
        x = mpmath.cos(mpmath.pi * (k - mpmath.mpf("0.25")) / (count + mpmath.mpf("0.5")))
        for _ in range(60):
            a, b = mpmath.mpf(1), x
            for n in range(2, count + 1):
                a, b = b, ((2 * n - 1) * x * b - (n - 1) * a) / n
            slope = count * (x * b - a) / (x * x - 1)
            step = b / slope
            x -= step
            if abs(step) < mpmath.mpf(10) ** -28:
                break
        nodes.append(LD(mpmath.nstr(x, 25)))
        weights.append(LD(mpmath.nstr(2 / ((1 - x * x) * slope ** 2), 25)))
    return np.array(nodes), np.array(weights)


RULES = [rule(20), rule(26)]


# --- features of a line f(p): its text, value, slope, and where panels must end or become small -------------------------------------

class Feature:
    def __init__(self, text, value, slope, cuts=(), spots=(), wave=INF, stop=None, repeats=None):
        self.text, self.value, self.slope = text, value, slope
        self.cuts, self.spots, self.wave, self.stop, self.repeats = list(cuts), list(spots), wave, stop, repeats


def number(x):
    return repr(float(x))


def pick(r, lo, hi):
    """A number of four digits, evenly by its logarithm."""
    return float(f"{math.exp(r.uniform(math.log(lo), math.log(hi))):.4g}")


def place(r, lo=-0.7, hi=0.7):
    return float(f"{r.uniform(lo, hi):.5g}")


def kink(r):
    a, c = pick(r, 0.01, 0.2), place(r)
    return Feature(f"{a}*abs(phi - {c})".replace("- -", "+ "), lambda p: LD(a) * abs(p - LD(c)), lambda p: LD(a) * np.sign(p - LD(c)), cuts=[c])


def notch(r):
    a, c, d = pick(r, 0.01, 0.2), place(r), pick(r, 1e-7, 0.1)
    return Feature(f"{a}*abs(abs(phi + {c}) - {d})", lambda p: LD(a) * abs(abs(p + LD(c)) - LD(d)),
                   lambda p: LD(a) * np.sign(abs(p + LD(c)) - LD(d)) * np.sign(p + LD(c)), cuts=[LD(-c), -LD(c) - LD(d), -LD(c) + LD(d)])


def arcade(r):
    a, k = pick(r, 0.005, 0.05), r.randint(1, 9)
    return Feature(f"{a}*abs(sin({k}*phi))", lambda p: LD(a) * abs(np.sin(k * p)), lambda p: LD(a) * k * np.cos(k * p) * np.sign(np.sin(k * p)),
                   cuts=[n * PI / k for n in range(-80 * k, 80 * k)], wave=2 * math.pi / k)


def bend(r):
    a, c = pick(r, 0.01, 0.2), place(r)
    return Feature(f"{a}*(phi + {c})*abs(phi + {c})", lambda p: LD(a) * (p + LD(c)) * abs(p + LD(c)), lambda p: LD(2 * a) * abs(p + LD(c)), cuts=[-c])


def power_bend(r):
    a = pick(r, 0.01, 0.2)
    return Feature(f"{a}*(phi + abs(phi))^3", lambda p: LD(a) * (p + abs(p)) ** 3, lambda p: LD(3 * a) * (p + abs(p)) ** 2 * (1 + np.sign(p)), cuts=[0])


def gauss(r):
    a, c, w = pick(r, 1e-5, 0.03), place(r), pick(r, 1e-7, 0.05)
    a = min(a, 1e4 * w)
    n = 1 / w
    return Feature(f"{a}*exp(-({n}*(phi + {c}))^2)", lambda p: LD(a) * np.exp(-(LD(n) * (p + LD(c))) ** 2),
                   lambda p: LD(a) * np.exp(-(LD(n) * (p + LD(c))) ** 2) * -2 * LD(n) ** 2 * (p + LD(c)), spots=[(-LD(c), w)])


def witch(r):
    a, c, w = pick(r, 1e-5, 0.03), place(r), pick(r, 1e-6, 0.05)
    a = min(a, 1e3 * w)
    n = float(f"{1 / w ** 2:.5g}")
    return Feature(f"{a}/(1 + {n}*(phi + {c})^2)", lambda p: LD(a) / (1 + LD(n) * (p + LD(c)) ** 2),
                   lambda p: -2 * LD(a) * LD(n) * (p + LD(c)) / (1 + LD(n) * (p + LD(c)) ** 2) ** 2, spots=[(-LD(c), w)])


def around(c, w):
    return [(s * LD(c) + 2 * PI * n, w) for s in (-1, 1) for n in range(-20, 21)]


def needle_in_cosine(r):
    a, c, w = pick(r, 1e-5, 0.01), place(r, 0.2, 1.2), pick(r, 1e-6, 0.03)
    a = min(a, 1e3 * w)
    n, m = float(f"{1 / w ** 2:.5g}"), math.cos(c)
    return Feature(f"{a}/(1 + {n}*(cos(phi) - {m})^2)", lambda p: LD(a) / (1 + LD(n) * (np.cos(p) - LD(m)) ** 2),
                   lambda p: 2 * LD(a) * LD(n) * (np.cos(p) - LD(m)) * np.sin(p) / (1 + LD(n) * (np.cos(p) - LD(m)) ** 2) ** 2,
                   spots=around(np.arccos(LD(m)), w))


def step(r):
    a, c, w = pick(r, 1e-5, 0.05), place(r), pick(r, 1e-8, 0.05)
    n = 1 / w
    return Feature(f"{a}*tanh({n}*(phi + {c}))", lambda p: LD(a) * np.tanh(LD(n) * (p + LD(c))),
                   lambda p: LD(a * 1.0) * LD(n) / np.cosh(np.minimum(abs(LD(n) * (p + LD(c))), LD(5000))) ** 2, spots=[(-LD(c), w)])


def rounded(r):
    a, c, w = pick(r, 0.01, 0.2), place(r), pick(r, 1e-8, 0.1)
    s = float(f"{w * w:.5g}")
    return Feature(f"{a}*sqrt((phi + {c})^2 + {s})", lambda p: LD(a) * np.sqrt((p + LD(c)) ** 2 + LD(s)),
                   lambda p: LD(a) * (p + LD(c)) / np.sqrt((p + LD(c)) ** 2 + LD(s)), spots=[(-LD(c), w)])


def comb(r):
    a, k, w = pick(r, 0.002, 0.03), r.randint(2, 40), pick(r, 1e-6, 0.1)
    s = float(f"{w * w:.5g}")
    return Feature(f"{a}*sqrt(sin({k}*phi)^2 + {s})", lambda p: LD(a) * np.sqrt(np.sin(k * p) ** 2 + LD(s)),
                   lambda p: LD(a) * k * np.sin(k * p) * np.cos(k * p) / np.sqrt(np.sin(k * p) ** 2 + LD(s)),
                   spots=[(n * PI / k, w / k) for n in range(-40 * k, 40 * k)], wave=2 * math.pi / k)


def ripple(r):
    k = pick(r, 3, 2e5)
    a = float(f"{r.uniform(0.02, 1) * 0.1 / k:.4g}")
    return Feature(f"{a}*sin({k}*phi)", lambda p: LD(a) * np.sin(LD(k) * p), lambda p: LD(a) * LD(k) * np.cos(LD(k) * p), wave=2 * math.pi / k)


def smooth(r):
    a, k = pick(r, 0.01, 0.1), r.randint(1, 4)
    return Feature(f"{a}*cos({k}*phi)", lambda p: LD(a) * np.cos(k * p), lambda p: -LD(a) * k * np.sin(k * p), wave=2 * math.pi / k)


def seam(r):  # atan2 runs on across its cut
    a, b = pick(r, 0.01, 0.1), pick(r, 0.2, 3)
    return Feature(f"{a}*cos(atan2({b}*sin(phi), {b}*cos(phi)))", lambda p: LD(a) * np.cos(p), lambda p: -LD(a) * np.sin(p), wave=6.3)


def sawtooth(r):  # kinks of asin
    a = pick(r, 0.01, 0.1)
    return Feature(f"{a}*asin(sin(phi))", lambda p: LD(a) * np.arcsin(np.sin(p)), lambda p: LD(a) * np.sign(np.cos(p)),
                   cuts=[PI / 2 + n * PI for n in range(-40, 40)])


def sinc(r):
    a, k = pick(r, 0.01, 0.1), r.randint(1, 5)
    def value(p):
        x = np.where(abs(p) < 1e-5, LD(1), p)
        return LD(a) * np.where(abs(p) < 1e-5, k - LD(k) ** 3 * p * p / 6, np.sin(k * x) / x)
    def slope(p):
        x = np.where(abs(p) < 1e-3, LD(1), p)
        q = k * p
        near = LD(k) ** 2 * (-q / 3 + q ** 3 / 30 - q ** 5 / 840)
        return LD(a) * np.where(abs(p) < 1e-3, near, (k * x * np.cos(k * x) - np.sin(k * x)) / (x * x))
    return Feature(f"{a}*sin({k}*phi)/phi", value, slope, wave=2 * math.pi / k)


def logistic(r):
    a, k = pick(r, 0.01, 0.1), pick(r, 1, 1e5)
    safe = lambda p: np.clip(LD(k) * p, -5000, 5000)
    return Feature(f"{a}/(1 + exp(-{k}*phi))", lambda p: LD(a) / (1 + np.exp(-safe(p))),
                   lambda p: LD(a) * LD(k) / (2 * np.cosh(safe(p) / 2)) ** 2, spots=[(0, 1 / k)])


def jump(r):
    a, c = pick(r, 0.001, 0.1), place(r, -0.3, 0.6)
    return Feature(f"{a}*sign(phi - {c})".replace("- -", "+ "), lambda p: LD(a) * np.sign(p - LD(c)), lambda p: 0 * p, cuts=[c], stop=c)


def end(r):
    a, c = pick(r, 0.01, 0.2), place(r, -0.2, 0.7)
    return Feature(f"{a}*sqrt({c} - phi)", lambda p: LD(a) * np.sqrt(np.maximum(LD(c) - p, 0)), lambda p: -LD(a) / (2 * np.sqrt(np.maximum(LD(c) - p, LD(1e-40)))),
                   cuts=[c], spots=[(c, 0)], stop=c)


def pole(r):
    a, c = pick(r, 1e-4, 0.02), place(r, 0.0, 0.9)
    return Feature(f"{a}/({c} - phi)", lambda p: LD(a) / (LD(c) - p), lambda p: LD(a) / (LD(c) - p) ** 2, cuts=[c], spots=[(c, 0)], stop=c)


COMMON = [kink, notch, arcade, bend, power_bend, gauss, witch, needle_in_cosine, step, rounded, comb, ripple, smooth, seam, sawtooth, sinc, logistic]
RARE = [jump, end, pole]


# --- the arc -------------------------------------------------------------------------------------------------------------------------

def panels(lo, hi, features, p0):
    """Bounds of panels from lo to hi (lo < hi), graded towards every feature."""
    cuts = sorted({LD(c) for f in features for c in f.cuts if lo < c < hi})
    spots = [(LD(c), LD(w)) for f in features for c, w in f.spots if lo - 1 < c < hi + 1]
    wave = min([f.wave for f in features] + [1.0])
    bounds = [LD(lo), *cuts, LD(hi)]
    for c, w in spots:
        d = max(w / 8, LD(1e-13))
        while d < 1:
            bounds += [c - d, c + d]
            d *= LD(1.5)
        bounds.append(c)
    bounds = np.unique(np.clip(np.array(bounds, dtype=LD), LD(lo), LD(hi)))
    parts = [bounds[:1]]
    for a, b in zip(bounds[:-1], bounds[1:]):
        n = max(1, int(math.ceil(float(b - a) / (0.2 * wave))))
        parts.append(a + (b - a) * (np.arange(1, n + 1, dtype=LD) / n))
    return np.concatenate(parts)


class Arc:
    """Time along a line from p0 in one direction: dp/dt = v / |r'|, v^2 = v0^2 - 2 g (y - y0)."""

    def __init__(self, lines, p0, rate, gravity=0.0):
        self.lines, self.p0, self.up = lines, LD(p0), 1 if rate > 0 else -1
        self.features = [f for line in lines for f in line]
        self.y0 = self.at(self.p0)[1]
        self.speed0 = self.speed(self.p0) * abs(LD(rate))
        self.gravity = LD(gravity)

    def at(self, p):
        return [sum((f.value(p) for f in line), 0 * p) for line in self.lines]

    def speed(self, p):
        return np.sqrt(sum(sum((f.slope(p) for f in line), 0 * p) ** 2 for line in self.lines))

    def slowness(self, p):
        if self.gravity == 0:
            return self.speed(p) / self.speed0
        square = self.speed0 ** 2 - 2 * self.gravity * (self.at(p)[1] - self.y0)
        if np.any(square < (0.2 * self.speed0) ** 2):
            raise ArithmeticError("turns round")
        return self.speed(p) / np.sqrt(square)

    def times(self, a, b, which):
        x, w = RULES[which]
        half, middle = (b - a) / 2, (a + b) / 2
        return np.sum(self.slowness(middle[:, None] + half[:, None] * x[None, :]) * w[None, :], axis=1) * half

    def solve(self, T, lo, hi):
        """Parameter after T, and whether it was stopped before at a feature's `stop`: (p, time, stopped)."""
        T = LD(T)
        stops = [LD(f.stop) for f in self.features if f.stop is not None and (LD(f.stop) - self.p0) * self.up > 0]
        end = (min(stops) if self.up > 0 else max(stops)) if stops else LD(hi if self.up > 0 else lo)
        far = end - self.up * (LD(1e-13) if stops else 0)
        bounds = panels(min(self.p0, far), max(self.p0, far), self.features, self.p0)
        if self.up < 0:
            bounds = bounds[::-1]
        a, b = bounds[:-1], bounds[1:]
        t, check = abs(self.times(a, b, 1)), abs(self.times(a, b, 0))
        total = np.cumsum(t)
        i = int(np.searchsorted(total, T))
        # The last panels before a stop may hold an endless slope: only those that are used are held against the second rule.
        used = slice(0, min(i + 1, len(t)))
        if np.any(abs(t[used] - check[used]) > 1e-15 * max(total[min(i, len(total) - 1)], T)):
            raise ArithmeticError("the panels do not resolve it")
        if i >= len(t):
            if stops:
                return end, total[-1], True
            raise ArithmeticError("the range is too short")
        left = T - (total[i - 1] if i > 0 else 0)
        low, high = a[i], b[i]
        p = low + (high - low) * left / t[i]
        for _ in range(100):
            miss = abs(self.times(np.array([a[i]]), np.array([p]), 1)[0]) - left
            better = p - self.up * miss / self.slowness(p)
            if abs(better - p) <= 4e-19 * abs(p) + LD(1e-22):
                break
            p = min(max(better, min(a[i], b[i])), max(a[i], b[i]))
        return p, T, False
