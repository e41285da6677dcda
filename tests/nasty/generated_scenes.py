#!/usr/bin/env python3
"""Random scenes of a fixed seed, each beside an independent solution: kinks, bends, needles, steps, ripples, combs, poles, ends, jumps,
cusps, seams, apexes and windings, in all scales of metres and of the parameters.

    python3 tests/nasty/generated_scenes.py build/dev/cli/reach [--count 240] [--seed 1] [--only NAME,…] [--show] > generated.tsv

A mass of 1 kg is let go without a hand, on a curve with or without gravity, or on a surface without forces. The reference never uses the
program or its equations. On a curve it is the time along the arc, dt = ds/v with v^2 = v0^2 - 2 g (y - y0). A surface is a cylinder over
such a curve or a cone, which are unfolded, a plane in polar parameters, or a surface of revolution by Clairaut's integrals. line_features.py
has the lines and the sums.

Verdicts: right (within 1e-9 m, relative to the largest coordinate or the length of the way above 1 m), stopped or refused where the reference has to stop, needless
(stopped or refused, although the reference goes on), WRONG (everything else). Ends with 1 if a scene is WRONG, or a stop's time or place
is not the reference's, or more than 15 % are needless. Needs numpy and mpmath."""
import argparse
import csv
import math
import pathlib
import random
import re
import sys
import tempfile

import numpy as np

from let_go import let_go
from line_features import Arc, COMMON, Feature, LD, RARE, RULES, number, pick, place

RIGHT, NEEDLESS = 1e-9, 0.15


class Scene:
    """kind, three lines, start, rates, gravity along y, seconds, and the reference: a place, or the time and place of a stop."""

    def __init__(self, **given):
        self.gravity, self.place, self.stop = 0.0, None, None
        self.__dict__.update(given)


# --- scenes --------------------------------------------------------------------------------------------------------------------------

def line_of(text, slope):
    return Feature(text, lambda p: LD(slope) * p, lambda p: LD(slope) + 0 * p)


def scaled(f, unit, size):
    """The feature of p = unit phi, times size."""
    text = f.text if unit == 1 else f.text.replace("phi", f"({number(unit)}*phi)")
    return f"{number(size)}*({text})" if size != 1 else text


def compose(r, rare=0.25):
    """x, y, z as lists of features, in p."""
    features = [r.choice(COMMON)(r) for _ in range(r.choice([1, 1, 2, 2, 3]))]
    if r.random() < rare:
        features.append(r.choice(RARE)(r))
    x = [line_of("0.1*phi", 0.1)]
    y, z = [], []
    for f in features:
        r.choice([y, y, z])
        (y if f is features[0] or r.random() < 0.6 else z).append(f)
    if r.random() < 0.15 and features[0].stop is None:
        x.append(Feature("1e-6*tanh(1e5*(phi - 0.1))", lambda p: LD(1e-6) * np.tanh(LD(1e5) * (p - LD(0.1))),
                         lambda p: LD(0.1) / np.cosh(np.minimum(abs(LD(1e5) * (p - LD(0.1))), LD(5000))) ** 2, spots=[(LD(0.1), 1e-5)]))
    return [x, y, z]


def texts(lines, unit, size, shift=0.0):
    out = []
    for k, line in enumerate(lines):
        text = " + ".join(scaled(f, unit, size) for f in line) or "0"
        out.append(f"{number(shift)} + {text}" if shift and k == 2 else text)
    return out


def curve_scene(r):
    lines = compose(r)
    unit = r.choice([1, 1, 1, 1e-3, 1e3, 1e-6, 10])
    size = r.choice([1, 1, 1, 1e-3, 10])
    shift = r.choice([0, 0, 0, 0, 100.0])
    up = r.choice([1, 1, -1])
    stopping = [f.stop for f in lines[1] + lines[2] if f.stop is not None]
    p0 = -1.0 if up > 0 or stopping else 1.0
    up = 1 if stopping else up
    rate = up * pick(r, 0.5, 4)
    T = r.choice([0.8, 1.2, 2.0])
    gravity = r.choice([0, 0, 9.81]) if size == 1 else 0
    arc = Arc(lines, p0, rate, gravity / size)
    p, time, stopped = arc.solve(T, -16, 16)
    where = [size * c for c in arc.at(p - up * LD(1e-12) if stopped else p)]
    where[2] = where[2] + LD(shift)
    scene = Scene(kind="curve", lines=texts(lines, unit, size, shift), at=[p0 / unit], rate=[rate / unit], gravity=-gravity, seconds=T)
    scene.way = float(size * arc.speed0 * LD(T)) + abs(shift)
    if stopped:
        scene.stop, scene.place = float(time), where
    else:
        scene.place = where
    return scene


def cylinder_scene(r):
    """r = (X(w), Y(w), h) with w and h linear in u and v: unfolded it is a plane."""
    lines = compose(r, 0.1)
    unit = [r.choice([1, 1, 1e3, 1e-3]) for _ in range(2)]
    slant = r.choice([0, 0, 0.3, -0.7])
    p0, rate, along, T = -1.0, pick(r, 0.5, 3), place(r, -0.3, 0.3), r.choice([0.8, 1.5])
    arc = Arc([lines[0], lines[1] + lines[2]], p0, rate)
    p, time, stopped = arc.solve(T, -12, 12)
    x, y = arc.at(p - LD(1e-12) if stopped else p)
    w = f"({number(unit[0])}*u + {slant}*({number(unit[1])}*v))"
    text = [" + ".join(f.text.replace("phi", w) for f in line) or "0" for line in [lines[0], lines[1] + lines[2]]]
    scene = Scene(kind="surface", lines=[*text, f"{number(unit[1])}*v"], at=[p0 / unit[0], 0.0],
                  rate=[(rate - slant * along) / unit[0], along / unit[1]], seconds=T)
    scene.place, scene.way = [x, y, LD(along) * time], 1.0
    if stopped:
        scene.stop = float(time)
    return scene


def polar_scene(r):
    """A plane in polar parameters of any winding, by its pole or beside it."""
    k = r.choice([1, 2, 3, 4, 5, 7, 0.5, 1.5, 2.25])
    offset = r.choice([0, 1e-9, 1e-8, 1e-7, 1e-5, 1e-3, 0.05])
    u0, T = place(r, -2, 2), r.choice([1.5, 2.0])
    radius = r.choice(["v", "v", "sinh(v)", "2*v"])
    f, d = {"v": (lambda v: v, lambda v: LD(1)), "sinh(v)": (np.sinh, np.cosh), "2*v": (lambda v: 2 * v, lambda v: LD(2))}[radius]
    v0, rv = LD(1), LD(-1)
    angle = LD(k) * LD(u0)
    R, R1 = f(v0), d(v0) * rv
    pos = np.array([R * np.cos(angle), R * np.sin(angle)]) / 10
    turn = LD(k) * LD(offset)
    vel = np.array([R1 * np.cos(angle) - R * np.sin(angle) * turn, R1 * np.sin(angle) + R * np.cos(angle) * turn]) / 10
    now = pos + vel * LD(T)
    swap = r.random() < 0.5
    a, b = ("v", "u") if swap else ("u", "v")
    rad = radius.replace("v", b)
    scene = Scene(kind="surface", lines=[f"0.1*{rad}*cos({number(k)}*{a})", f"0.1*{rad}*sin({number(k)}*{a})", "0"],
                  at=[1.0, u0] if swap else [u0, 1.0], rate=[-1.0, offset] if swap else [offset, -1.0], seconds=T)
    scene.place, scene.way = [now[0], now[1], LD(0)], 1.0
    return scene


def cone_scene(r):
    """A cone unfolded, by its apex (stopped there) or beside it."""
    slope, k = r.choice([1.0, 0.3, 3.0, 10.0]), r.choice([1, 1, 2, 3])
    offset, T = r.choice([0, 1e-6, 1e-5, 1e-4, 1e-3, 0.03]), r.choice([0.7, 1.6])
    u0 = place(r, -1, 1)
    scene = Scene(kind="surface", lines=[f"0.1*v*cos({k}*u)", f"0.1*v*sin({k}*u)", f"{0.1 * slope}*v"], at=[u0, 1.0], rate=[offset, -1.0], seconds=T)
    slope_exact = LD(0.1 * slope) * 10
    slant = np.sqrt(1 + slope_exact ** 2)
    radius, fall, turn = slant / 10, -slant / 10, LD(offset) / slant * k  # in the unfolded plane: angle = k u / slant
    pos, vel = np.array([radius, LD(0)]), np.array([fall, radius * turn])
    scene.way = 1.0
    if offset == 0 and T > 1:
        scene.stop, scene.place = 1.0, [LD(0)] * 3
        return scene
    now = pos + vel * LD(T)
    rho, phi = np.sqrt(now[0] ** 2 + now[1] ** 2), np.arctan2(now[1], now[0])
    angle = LD(k) * LD(u0) + phi * slant
    v = rho / (slant / 10)
    scene.place = [v / 10 * np.cos(angle), v / 10 * np.sin(angle), LD(0.1 * slope) * v]
    return scene


def revolution_scene(r):
    """f(v) = 0.1 v, height z(v): Clairaut. From v = 1 inwards, past its smallest radius, and out again."""
    a, n = pick(r, 0.01, 0.3), r.choice([2, 3, 4])
    offset = r.choice([1e-6, 1e-4, 1e-2, 0.1])
    T, u0 = r.choice([1.2, 1.7]), place(r, -1, 1)
    A = LD(a)
    F = lambda v: v / 10
    S = lambda v: np.sqrt(LD("0.01") + (A * n * v ** (n - 1)) ** 2)  # ds/dv
    vr, ur = LD(-1), LD(offset)
    V = np.sqrt((S(LD(1)) * vr) ** 2 + (F(LD(1)) * ur) ** 2)
    c = F(LD(1)) ** 2 * ur
    turn = 10 * c / V  # where F = c / V
    # v = sqrt(turn^2 + q^2), signed q from -q0 to q: dt = S dv / sqrt(V^2 - c^2/F^2) = S v dv / (V sqrt(v^2 - turn^2)) = S dq / V
    q0 = np.sqrt(1 - turn ** 2)
    slow = lambda q: S(np.sqrt(turn ** 2 + q * q)) / V
    spin = lambda q: c / F(np.sqrt(turn ** 2 + q * q)) ** 2 * slow(q)
    grid = [LD(0)]
    d = turn / 8
    while d < 4:
        grid += [d, -d]
        d *= LD(1.3)
    grid = np.unique(np.clip(np.array(grid + [-q0, LD(4)]), -q0, LD(4)))
    parts = [grid[:1]]
    for lo, hi in zip(grid[:-1], grid[1:]):
        m = max(1, int(math.ceil(float(hi - lo) / 0.1)))
        parts.append(lo + (hi - lo) * np.arange(1, m + 1, dtype=LD) / m)
    grid = np.concatenate(parts)
    x, w = RULES[1]

    def over(f, lo, hi):
        half = (hi - lo) / 2
        return np.sum(f((lo + hi)[:, None] / 2 + half[:, None] * x[None, :]) * w[None, :], axis=1) * half
    t = np.cumsum(over(slow, grid[:-1], grid[1:]))
    i = int(np.searchsorted(t, LD(T)))
    if i >= len(t):
        raise ArithmeticError("the range is too short")
    before = t[i - 1] if i else LD(0)
    q = grid[i]
    for _ in range(60):
        q -= (over(slow, np.array([grid[i]]), np.array([q]))[0] + before - LD(T)) / slow(q)
    angle = LD(u0) + np.sum(over(spin, grid[:i], grid[1:i + 1])) + over(spin, np.array([grid[i]]), np.array([q]))[0]
    v = np.sqrt(turn ** 2 + q * q)
    scene = Scene(kind="surface", lines=["0.1*v*cos(u)", "0.1*v*sin(u)", f"{a}*v^{n}"], at=[u0, 1.0], rate=[offset, -1.0], seconds=T)
    scene.place, scene.way = [F(v) * np.cos(angle), F(v) * np.sin(angle), A * v ** n], 1.0
    return scene


def cusp_scene(r):
    """Cusps, folds and standstills, passed in arc length."""
    a, n, m = pick(r, 0.02, 0.2), *r.choice([(2, 3), (2, 4), (3, 3), (3, 5), (2, 5)])
    b, rate, T = pick(r, 0.02, 0.2), pick(r, 0.3, 1), r.choice([0.7, 1.5])
    f = Feature(f"{a}*phi^{n}", lambda p: LD(a) * p ** n, lambda p: LD(a) * n * p ** (n - 1), cuts=[0], spots=[(0, 0)])
    g = Feature(f"{b}*phi^{m}", lambda p: LD(b) * p ** m, lambda p: LD(b) * m * p ** (m - 1), cuts=[0], spots=[(0, 0)])
    arc = Arc([[f], [g], []], -1.0, rate)
    p, _, _ = arc.solve(T, -16, 16)
    scene = Scene(kind="curve", lines=[f.text, g.text, "0"], at=[-1.0], rate=[rate], seconds=T)
    scene.place, scene.way = [*arc.at(p)[:2], LD(0)], 1.0
    return scene


MAKERS = [curve_scene] * 8 + [cylinder_scene] * 5 + [polar_scene] * 2 + [cone_scene] * 2 + [revolution_scene] + [cusp_scene]


def scenes(seed, count, only):
    """One after the other, so that each is judged as soon as it is made."""
    made, number_ = 0, 0
    while made < count:
        number_ += 1
        if only and f"{seed}/{number_}" not in only:
            made += number_ >= 4 * count
            continue
        r = random.Random(f"{seed}/{number_}")
        try:
            with np.errstate(all="ignore"):
                maker = r.choice(MAKERS)
                scene = maker(r)
                scene.maker = maker.__name__.removesuffix("_scene")
        except ArithmeticError:
            continue
        if not all(np.isfinite(c) for c in scene.place):
            continue
        scene.name = f"{seed}/{number_}"
        made += 1
        yield scene


# --- the program ---------------------------------------------------------------------------------------------------------------------

def run(program, scene, folder):
    """(verdict, place or None, time or None, words)"""
    code, words, last = let_go(program, folder, scene.kind, scene.lines, scene.gravity, ",".join(map(number, scene.at)),
                               ",".join(map(number, scene.rate)), number(scene.seconds))
    words = words.replace("\n", " ")
    if code not in (0, 2, 4):
        return "crashed", None, None, f"exit {code}: {words}"
    if code:
        return "refused", None, None, words
    return "stopped" if words else "right", [float(last[f"mass1_{a}_m"]) for a in "xyz"], float(last["time_s"]), words


def judge(scene, verdict, where, time, words):
    """(verdict, detail)"""
    slack = max(1.0, scene.way, *[abs(float(c)) for c in scene.place])
    away = None if where is None else float(sum((LD(a) - b) ** 2 for a, b in zip(where, scene.place)) ** LD(0.5))
    if verdict == "right":
        if scene.stop is not None:
            return "WRONG", f"goes on past a stop at {scene.stop}"
        return ("right" if away <= RIGHT * slack else "WRONG"), f"{away:.1e}"
    if verdict == "refused":
        return ("refused" if scene.stop is not None else "needless"), words
    if verdict == "stopped":
        if scene.stop is None:
            return "needless", words
        if time < scene.stop - 5e-3:
            return "needless", words
        if abs(time - scene.stop) > 5e-3 or away > 1e-2 * slack:
            return "WRONG", f"stops at {time} s, {away:.1e} m from the reference's {scene.stop} s: {words}"
        return "stopped", words
    return "WRONG", words


PAGE = """# Generated scenes

<!-- not run: some minutes of processor time; writes this page -->

    python3 tests/nasty/generated_scenes.py build/dev/cli/reach --page docs/benchmarks/generated-scenes.md > generated.tsv

A generator of a fixed seed composes {count} hard scenes from kinks, bends, needles, steps, rounded corners, ripples, combs, poles, ends, jumps, cusps, seams, apexes
and windings, in all scales of metres and of the parameters. A mass of 1 kg is let go without a hand. An independent reference gives its place or its stop.
It has 64 bits of mantissa and uses neither the program nor its equations.

- *right*: the place differs by less than 1e-9 m from the reference, relative to the largest coordinate or the length of the way above 1 m.
- *stopped*, *refused*: so does the reference. Time and place of a stop are right to 5 ms and 1 cm.
- *needless*: the program stops or refuses with a message, although the reference goes on.
- *WRONG*: everything else, without a message.

{table}

{needless:.0f} % of the scenes were stopped or refused needlessly. These are the messages:

{messages}
"""


def write_page(path, rows):
    verdicts = ["right", "stopped", "refused", "needless", "WRONG"]
    kinds = sorted({row[0] for row in rows})
    lines = ["| kind of scene | " + " | ".join(verdicts) + " |", "|---" * (len(verdicts) + 1) + "|"]
    for kind in [*kinds, "all"]:
        mine = [verdict for name, verdict, _ in rows if kind in ("all", name)]
        lines.append(f"| {kind} | " + " | ".join(str(mine.count(v)) for v in verdicts) + " |")
    told = {}
    for _, verdict, words in rows:
        if verdict == "needless":
            words = re.sub(r"^(stopped at|error:( at)?) ?[-\d.e+]* ?s?:? ?", "", words).split(" help:")[0]
            words = re.sub(r"-?\d[\d.]*(e[-+]?\d+)?", "#", words).split(": ")[0][:120]
            told[words] = told.get(words, 0) + 1
    messages = "\n".join(f"- {n} times: {words}" for words, n in sorted(told.items(), key=lambda item: -item[1]))
    share = 100 * sum(verdict == "needless" for _, verdict, _ in rows) / max(1, len(rows))
    pathlib.Path(path).write_text(PAGE.format(count=len(rows), table="\n".join(lines), needless=share, messages=messages))


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("program")
    options.add_argument("--count", type=int, default=240)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--only", default="", help="names of scenes, such as 1/3,1/29")
    options.add_argument("--page", help="file for a page about all scenes")
    options.add_argument("--show", action="store_true", help="only print the scenes and their references")
    given = options.parse_args()
    counts, rows, out = {}, [], csv.writer(sys.stdout, delimiter="\t", lineterminator="\n")
    out.writerow(["scene", "kind", "x", "y", "z", "at", "rate", "gravity_y", "seconds", "x_m", "y_m", "z_m", "stop_s", "verdict", "detail"])
    with tempfile.TemporaryDirectory() as folder:
        for scene in scenes(given.seed, given.count, [name for name in given.only.split(",") if name]):
            verdict, detail = ("", "") if given.show else judge(scene, *run(given.program, scene, folder))
            counts[verdict] = counts.get(verdict, 0) + 1
            rows.append((scene.maker, verdict, detail))
            out.writerow([scene.name, scene.kind, *scene.lines, ",".join(map(number, scene.at)), ",".join(map(number, scene.rate)), scene.gravity,
                          scene.seconds, *[np.format_float_positional(c, 18) for c in scene.place], scene.stop or "", verdict, detail])
            sys.stdout.flush()
    if given.page:
        write_page(given.page, rows)
    print(", ".join(f"{n} {verdict}" for verdict, n in sorted(counts.items())), file=sys.stderr)
    return counts.get("WRONG", 0) > 0 or counts.get("needless", 0) > NEEDLESS * given.count


if __name__ == "__main__":
    sys.exit(main())
