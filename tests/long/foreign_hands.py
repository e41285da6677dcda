#!/usr/bin/python3
"""Does `reach analyze` name the right criterion for hands that Reachlab did not make?

`foreign_hands.py BUILD [--seed S] [--experiments NAME…] [--alone] [--keep FOLDER [--resume]]` plans movements with the optimal control of this file (numpy, nothing of the
program), adds the scatter of a person, and writes the hands as BIDS datasets. `reach analyze` then judges every person alone, and groups of
five. Prints a table of right, undecided and wrong names for each stratum:

  inside    the truth is a candidate, and the hand weighs at most 2 kg
  heavy     the truth is a candidate, and the hand weighs 2.5 to 8 kg
  warp      a listed plan, moved along a warp of time of 2 to 10 % that belongs to the person
  outside   no candidate: the mean of two plans, minimum snap, feedback control of effort, two plans in turn, two sub-movements

A name is right if it is the planner. In `warp` the planner counts as right. In `outside` every name is unfounded. Exit 1 when more than 2 %
of the sets inside or more than 5 % of another stratum are named wrong, or fewer than 65 % of the persons inside are named.
"""
import argparse, csv, json, math, pathlib, shutil, subprocess, sys, tempfile

import numpy as np
from scipy import linalg

LENGTH, RATE, TRIALS = 0.2, 100, 30
EXPERIMENTS = {  # masses [kg], springs of the chain [N/m] or of each mass, coupling [N/m], duration [s]
    "chain-slow": ("chain", [0.6] * 5, [600] * 4, 600, 2.26),
    "chain-moderate": ("chain", [0.6] * 5, [600] * 4, 600, 1.35),
    "dingwell": ("chain", [3.0], [], 120, 1.35),
    "parallel": ("parallel", [3.0, 3.0], [50, 250], 0, 2.5)}
NAMES = {"1": "min-hand-jerk", "3": "min-crackle", "3h": "min-hand-crackle", "4": "min-hand-force", "5": "min-hand-force-change"}
STRATA = {  # kinds of persons and how often each is drawn in a dataset
    "inside": {"1": 7, "3": 7, "3h": 7, "4": 7, "5": 9}, "heavy": {"4": 8, "5": 8},
    "warp": {"1": 3, "3": 3, "3h": 3, "4": 3, "5": 4}, "outside": {"mean": 8, "snap": 4, "effort": 5, "turns": 5, "two": 4}}
GROUPS = {"inside": ["1", "3h", "5"], "heavy": ["5"], "outside": ["mean"]}  # five of a kind are judged together
ALLOWED = {"inside": 0.02, "heavy": 0.05, "warp": 0.05, "outside": 0.05}


class Plant:
    """Object and hand on a line: masses, stiffness matrix with the hand as coordinate 0, and the coupling to the hand."""

    def __init__(self, experiment):
        kind, masses, springs, coupling, self.T = EXPERIMENTS[experiment]
        n = len(masses)
        self.masses = np.array(masses)
        K = np.zeros((n + 1, n + 1))

        def join(a, b, k):
            K[a, a] += k
            K[b, b] += k
            K[a, b] -= k
            K[b, a] -= k

        if kind == "chain":
            join(0, 1, coupling)
            for i, k in enumerate(springs):
                join(i + 1, i + 2, k)
        else:
            for i, k in enumerate(springs):
                join(0, i + 1, k)
        self.K = K
        self.clamped = np.sqrt(linalg.eigh(K[1:, 1:], np.diag(self.masses), eigvals_only=True))

    def free(self, hand):
        values = linalg.eigh(self.K, np.diag([hand, *self.masses]), eigvals_only=True)
        return np.sqrt(np.maximum(values[1:], 0))

    def system(self, hand):
        """x' = A x + b F for positions and velocities of the hand and the masses."""
        m = np.array([hand, *self.masses])
        n = len(m)
        A = np.zeros((2 * n, 2 * n))
        A[:n, n:] = np.eye(n)
        A[n:, :n] = -self.K / m[:, None]
        b = np.zeros(2 * n)
        b[n] = 1 / m[0]
        return A, b


def oscillators(masses, K, push, u, dt):
    """Positions and velocities of masses at rest on the stiffness matrix K, pushed by `push` times u(t): a convolution for each mode."""
    squares, shapes = linalg.eigh(K, np.diag(masses))
    t = dt * np.arange(len(u))
    x, v = np.zeros((len(masses), len(u))), np.zeros((len(masses), len(u)))
    for w, shape in zip(np.sqrt(np.maximum(squares, 0)), shapes.T):
        if w * t[-1] < 1e-4:  # the object as a whole
            rate = cumulative(u, dt)
            place = cumulative(rate, dt)
        else:
            c, s = cumulative(np.cos(w * t) * u, dt), cumulative(np.sin(w * t) * u, dt)
            place, rate = (np.sin(w * t) * c - np.cos(w * t) * s) / w, np.cos(w * t) * c + np.sin(w * t) * s
        share = shape @ push
        x += np.outer(shape, share * place)
        v += np.outer(shape, share * rate)
    return x, v


def leastNorm(t, frequencies, order, moments):
    """The function a(t) with the least integral of its square `order`-th derivative that has the given moments
    (integrals of a, and of a (T - t)), no content at the frequencies, and zero derivatives below `order` at both ends."""
    n, dt = len(t), t[1] - t[0]
    w = np.full(n, dt)
    w[0] = w[-1] = dt / 2
    T = t[-1]
    # a = order-fold integral of u. A functional of a becomes a functional of u by integrating its kernel backwards.
    kernels = [np.ones(n), T - t] + [f(v * t) for v in frequencies for f in (np.cos, np.sin)]
    wanted = list(moments) + [0] * (2 * len(frequencies))
    rows = []
    for k in kernels:
        for _ in range(order):
            whole = cumulative(k, dt)
            k = whole[-1] - whole
        rows.append(k)
    for i in range(order):  # derivative i of a at T
        rows.append((T - t) ** (order - 1 - i) / math.factorial(order - 1 - i))
        wanted.append(0)
    R = np.array(rows)
    scale = np.sqrt(np.sum(R * R * w, axis=1))
    R = R / scale[:, None]
    u = R.T @ np.linalg.lstsq((R * w) @ R.T, np.array(wanted) / scale, rcond=1e-14)[0]
    for _ in range(order):
        u = cumulative(u, dt)
    return u


def cumulative(y, dt):
    return np.concatenate([[0], np.cumsum((y[1:] + y[:-1]) / 2 * dt)])


def crackle(plant, T, t):
    """(3): the last mass moves along the smoothest polynomial, and the hand follows from the object."""
    n = 2 * len(plant.masses) + 2
    s = np.polynomial.Polynomial([0, 1])
    rate = (s * (1 - s)) ** n
    y = rate.integ()
    y = y * (LENGTH / y(1))

    def accelerated(p):
        return p.deriv(2) / T**2

    if plant.K[0, 0] and plant.K[0, -1] == 0 or len(plant.masses) == 1:  # chain, from the last mass towards the hand
        x = [None] * (len(plant.masses) + 1)
        x[-1] = y
        for i in range(len(plant.masses), 0, -1):
            k = -plant.K[i - 1, i]
            above = -plant.K[i, i + 1] * (x[i] - x[i + 1]) if i < len(plant.masses) else 0
            x[i - 1] = x[i] + (plant.masses[i - 1] * accelerated(x[i]) + above) / k
        return x[0].deriv()(t / T) / T
    z = y  # parallel: the flat output moves along the polynomial of the same order
    for w in plant.clamped:
        z = z + accelerated(z) / w**2
    return z.deriv()(t / T) / T


def hand(plant, kind, mass, T):
    """Velocity of the hand [m/s] at 2001 instants of [0, T]."""
    t = np.linspace(0, T, 2001)
    dt = t[1]
    if kind == "1":
        return cumulative(leastNorm(t, plant.clamped, 1, (0, LENGTH)), dt)
    if kind == "3h":  # integrated three times more than (1), so on a finer grid
        fine = np.linspace(0, T, 16001)
        return cumulative(leastNorm(fine, plant.clamped, 3, (0, LENGTH)), fine[1])[::8]
    if kind == "3":
        return crackle(plant, T, t)
    if kind in ("4", "5"):
        M = mass + plant.masses.sum()
        F = leastNorm(t, plant.free(mass), 0 if kind == "4" else 1, (0, M * LENGTH))
        push = np.zeros(len(plant.masses) + 1)
        push[0] = 1
        return oscillators([mass, *plant.masses], plant.K, push, F, dt)[1][0]
    s = t / T
    if kind == "snap":
        return LENGTH / T * 140 * (s * (1 - s)) ** 3
    raise ValueError(kind)


class Effort:
    """Feedback control of effort: a discrete regulator with a filter of the muscle, a hand of 1 kg, and noise of the command."""

    def __init__(self, plant, T, draw):
        dt, mass, muscle = 0.01, 1.0, 0.04
        A, b = plant.system(mass)
        n = len(b)
        big = np.zeros((n + 2, n + 2))
        big[:n, :n], big[:n, n] = A, b
        big[n, n], big[n, n + 1] = -1 / muscle, 1 / muscle
        E = linalg.expm(big * dt)
        self.F, self.g = E[: n + 1, : n + 1], E[: n + 1, n + 1]
        self.steps, half = round(T / dt), n // 2
        Q = np.zeros((n + 1, n + 1))
        Q[:half, :half], Q[half:n, half:n] = np.eye(half) * 1e6, np.eye(half) * 1e5 * T**2 / 4
        P, self.gains = Q.copy(), []
        for _ in range(self.steps):
            S = P @ self.g
            G = S @ self.F / (1 + self.g @ S)
            P = self.F.T @ (P @ self.F - np.outer(S, G))
            self.gains.insert(0, G)
        self.half, self.n, self.dt, self.draw = half, n, dt, draw

    def trial(self, noise):
        x = np.zeros(self.n + 1)
        goal = np.zeros(self.n + 1)
        goal[: self.half] = LENGTH
        v = [0.0]
        for k in range(self.steps + 30):
            u = -self.gains[min(k, self.steps - 1)] @ (x - goal)
            u += noise * (abs(u) + 0.3) * self.draw.standard_normal()
            x = self.F @ x + self.g * u
            v.append(x[self.half])
        return np.array(v)


class Person:
    """Someone with a planner, a mass of the hand, a law of time and a scatter of movements."""

    def __init__(self, label, stratum, kind, plant, draw):
        self.label, self.stratum, self.kind, self.plant, self.draw = label, stratum, kind, plant, draw
        light = draw.uniform(0.5, 2.0) if kind == "4" else draw.uniform(0.0, 2.0)
        self.mass = draw.uniform(2.5, 8.0) if stratum == "heavy" else max(light, 0.02)
        self.anew = draw.random() < 0.5
        self.noise = draw.uniform(0.03, 0.1)
        self.pace = plant.T * math.exp(draw.uniform(-0.08, 0.08))
        self.warp = (draw.uniform(0.02, 0.10) * draw.choice([-1, 1]), draw.choice([1, 2])) if stratum == "warp" else (0, 1)
        self.other = None
        if kind in ("mean", "turns"):
            self.first, self.other = draw.permutation(["1", "3", "3h", "4", "5"])[:2]
            self.mass = draw.uniform(0.5, 2.0)
        if kind == "two":
            self.split, self.gap = draw.uniform(0.55, 0.75), draw.uniform(0.25, 0.4)
        self.plans = {}
        if kind == "effort":
            self.controller = Effort(plant, self.pace, draw)

    def planned(self, kind, T):
        P = round(T, 3) if self.anew else round(self.pace, 3)
        if (kind, P) not in self.plans:
            self.plans[kind, P] = hand(self.plant, kind, self.mass, P) * P
        return self.plans[kind, P] / T

    def profile(self, T):
        """(instants from 0 to 1, velocity of the hand)."""
        s = np.linspace(0, 1, 2001)
        if self.kind == "mean":
            v = (self.planned(self.first, T) + self.planned(self.other, T)) / 2
        elif self.kind == "turns":
            v = self.planned(self.first if self.draw.random() < 0.5 else self.other, T)
        elif self.kind == "two":
            bell = lambda x: np.where((x > 0) & (x < 1), 30 * (x * (1 - x)) ** 2, 0)
            d = 1 - self.gap
            v = LENGTH / T / d * (self.split * bell(s / d) + (1 - self.split) * bell((s - self.gap) / d))
        else:
            v = self.planned(self.kind, T)
        size, waves = self.warp
        if size:  # the path of the plan at a later or earlier phase: the distance stays
            path = cumulative(v, 1)
            moved = np.interp(s + size * np.sin(math.pi * waves * s) / waves, s, path)
            v = np.gradient(moved)
        return v

    def trials(self):
        """Velocity of the hand at 1 kHz for each trial, with rest before and after."""
        slow = 0.0
        for _ in range(TRIALS):
            slow = 0.3 * slow + self.draw.standard_normal()
            T = self.pace * math.exp(0.05 * slow)
            if self.kind == "effort":
                raw = self.controller.trial(0.3 * self.noise)
                v = np.interp(np.arange(0, (len(raw) - 1) * self.controller.dt, 0.001), np.arange(len(raw)) * self.controller.dt, raw)
            else:
                n = round(T * 1000)
                v = np.interp(np.arange(n + 1) / n, np.linspace(0, 1, 2001), self.profile(T))
            v = v * math.exp(0.03 * self.draw.standard_normal())
            s = np.arange(len(v)) / (len(v) - 1)
            wave = sum(self.draw.standard_normal() / k**0.7 * np.sin(math.pi * k * s) for k in range(1, 9))
            v = v + self.noise * np.abs(v).max() * 0.7 * wave * np.sqrt(np.sin(math.pi * s))
            yield np.concatenate([np.zeros(500), v, np.zeros(450)])


def objectOf(plant, h):
    """Position and velocity of the last mass when the hand moves along h (1 kHz)."""
    x, v = oscillators(plant.masses, plant.K[1:, 1:], -plant.K[1:, 0], h - h[0], 0.001)
    return x[-1] + h[0], v[-1]


CHANNELS = {"latency": "s", "hand_pos": "m", "coupling_force": "N", "mass1_pos": "m", "mass1_vel": "m/s"}  # vectors have three rows
EVENTS = ["onset", "duration", "trial_type", "trial", "block", "phase", "condition", "outcome", "reason", "mass", "by", "movement_time", "armed",
          "go", "peak_force", "mean_force", "day"]


def write(folder, experiment, plant, person):
    base = folder / f"sub-{person.label}/ses-01/motion"
    base.mkdir(parents=True)
    name = f"sub-{person.label}_ses-01_task-reach_tracksys-haptic_run-01"
    rows, events, at = [], [], 0.0
    for number, v in enumerate(person.trials(), 1):
        h = -LENGTH / 2 + cumulative(v, 0.001)
        if len(h) % 10 == 0:
            h = h[:-9]
        x, xv = objectOf(plant, h)
        for k in range(0, len(h), 10):
            rows.append(f"{at + k / 1000:.3f}\t{h[k]:.9f}\t0\t0\t0\t0\t0\t{x[k]:.9f}\t0\t0\t{xv[k]:.9f}\t0\t0")
        length = (len(h) - 1) / 1000
        onset = 0.5
        events.append([f"{at + onset:.3f}", f"{length - onset:.3f}", "reach", number, 1, "recorded", experiment, "success", "n/a", "n/a", "n/a",
                       f"{length - onset - 0.45:.3f}", f"{at:.3f}", f"{at:.3f}", "n/a", "n/a", "n/a"])
        at += (len(h) - 1) / 1000 + 0.5
    (base / f"{name}_motion.tsv").write_text("\n".join(rows) + "\n")
    rows = [f"{channel}{axis}\t{unit}" for channel, unit in CHANNELS.items() for axis in ([""] if channel == "latency" else ["_x", "_y", "_z"])]
    (base / f"{name}_channels.tsv").write_text("\n".join(["name\tunits", *rows]) + "\n")
    (base / f"{name}_events.tsv").write_text("\n".join("\t".join(map(str, r)) for r in [EVENTS, *events]) + "\n")
    about = {"TaskDescription": f"Rest-to-rest reaching with the simulated object of experiment {experiment}", "SamplingFrequency": RATE}
    (base / f"{name}_motion.json").write_text(json.dumps(about))


def analyze(reach, data, experiment, resume):
    """The summary of `reach analyze`, kept beside the data. With `resume` the summary that is there counts."""
    kept = data.with_suffix(".json")
    if resume and kept.exists():
        return json.loads(kept.read_text())
    done = subprocess.run([reach, "analyze", data, "--experiment", experiment, "--json"], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"reach analyze {data}: {done.stderr}")
    kept.write_text(done.stdout)
    return json.loads(done.stdout)


def verdict(person, names):
    if not names:
        return "undecided"
    return "right" if person.stratum != "outside" and NAMES[person.kind] in names else "wrong"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--persons", type=float, default=1.0, help="times the usual number of persons")
    parser.add_argument("--experiments", nargs="*", default=list(EXPERIMENTS), choices=EXPERIMENTS, help="[default: all]")
    parser.add_argument("--alone", action="store_true", help="no groups of five")
    parser.add_argument("--keep", type=pathlib.Path, help="folder that keeps datasets and tables")
    parser.add_argument("--resume", action="store_true", help="judge only the datasets of that folder that are not yet judged")
    o = parser.parse_args()
    reach = o.build.resolve() / "cli/reach"
    work = o.keep or pathlib.Path(tempfile.mkdtemp(prefix="foreign_hands"))
    table = {}  # (stratum, kind, "one" or "five"): verdicts
    reasons = {}  # stratum: reason of each person
    masses = []  # is the hand's mass in its interval?
    wrong = []
    everyone = {}  # experiment: persons
    for e, experiment in enumerate(EXPERIMENTS):
        if experiment not in o.experiments:
            continue
        plant, data = Plant(experiment), work / experiment
        persons = everyone[experiment] = []
        for s, (stratum, kinds) in enumerate(STRATA.items()):
            for k, (kind, count) in enumerate(kinds.items()):
                for i in range(max(1, round(count * o.persons))):
                    draw = np.random.default_rng([o.seed, e, s, k, i])
                    persons.append(Person(f"{stratum}{kind}x{i}", stratum, kind, plant, draw))
        if not data.exists():
            part = work / f"{experiment}-part"  # renamed when it is whole
            shutil.rmtree(part, ignore_errors=True)
            for person in persons:
                write(part, experiment, plant, person)
            part.rename(data)
        print(f"{experiment}: {len(persons)} persons written", file=sys.stderr, flush=True)
        study = analyze(reach, data, experiment, o.resume)
        print(f"{experiment}: judged alone", file=sys.stderr, flush=True)
        named = {f["subject"]: [f["criterion"], *f["equivalent"]] for f in study["fits"] if f["decided"]}
        for fit in study["fits"]:
            person = next(p for p in persons if p.label == fit["subject"])
            if fit["criterion"] == "reference":
                reasons.setdefault(person.stratum, []).append(fit["reason"])
            if fit["hand_mass_interval_kg"] and fit["criterion"] == NAMES.get(person.kind) and person.stratum in ("inside", "heavy"):
                low, high = fit["hand_mass_interval_kg"]
                masses.append(low <= person.mass <= high)
        for person in persons:
            v = verdict(person, named.get(person.label, []))
            table.setdefault((person.stratum, person.kind, "one"), []).append(v)
            if v == "wrong":
                wrong.append(f"{experiment} {person.label}: mass {person.mass:.2f} kg, {'anew' if person.anew else 'one plan'}, "
                             f"noise {person.noise:.3f}, warp {person.warp[0]:.3f}, other {person.other}: {named[person.label][0]}")
    for experiment, persons in () if o.alone else everyone.items():
        data = work / experiment
        for stratum, kinds in GROUPS.items():
            for kind in kinds:
                members = [p for p in persons if p.stratum == stratum and p.kind == kind][:5]
                if len(members) < 5:
                    continue
                group = work / f"{experiment}-{stratum}{kind}"
                if not group.exists():
                    for p in members:
                        shutil.copytree(data / f"sub-{p.label}", group / f"sub-{p.label}")
                c = analyze(reach, group, experiment, o.resume)["conclusion"]
                v = verdict(members[0], [c["criterion"], *c["equivalent"]] if c["decided"] else [])
                table.setdefault((stratum, kind, "five"), []).append(v)
                if v == "wrong":
                    wrong.append(f"{experiment}, five of {stratum} {kind}: {c['sentence']}")
    for line in wrong:
        print("WRONG:", line)
    print("\n| stratum | planner | people | sets | right | undecided | wrong |\n|---|---|---|---|---|---|---|")
    bad = False
    for (stratum, kind, people), v in table.items():
        print(f"| {stratum} | {kind} | {people} | {len(v)} | {v.count('right')} | {v.count('undecided')} | {v.count('wrong')} |")
    print("\n| stratum | sets | right | undecided | wrong | wrong, % | allowed, % |\n|---|---|---|---|---|---|---|")
    for stratum in STRATA:
        v = [x for key, values in table.items() if key[0] == stratum for x in values]
        share = v.count("wrong") / len(v)
        bad |= share > ALLOWED[stratum]
        print(f"| {stratum} | {len(v)} | {v.count('right')} | {v.count('undecided')} | {v.count('wrong')} | {100 * share:.1f} | "
              f"{100 * ALLOWED[stratum]:.0f} |")
    kinds = sorted({r for all in reasons.values() for r in all})
    print("\nPersons alone, by the reason why nobody is named:\n\n| stratum | " + " | ".join(k or "named" for k in kinds) + " | lack of fit, % |\n|---|" +
          "---|" * (len(kinds) + 1))
    for stratum, all in reasons.items():
        fitting, poor = all.count(""), all.count("poor")
        print(f"| {stratum} | " + " | ".join(str(all.count(k)) for k in kinds) + f" | {100 * poor / max(1, poor + fitting):.0f} |")
    print(f"\nThe interval of the hand's mass holds the mass for {sum(masses)} of {len(masses)} persons who follow (4) or (5) "
          f"({100 * sum(masses) / max(1, len(masses)):.0f} %)")
    inside = [x for key, values in table.items() if key[0] == "inside" and key[2] == "one" for x in values]
    named = inside.count("right") / len(inside)
    print(f"\nPersons inside: {100 * named:.0f} % named right (at least 65 %)")
    if not o.keep:
        shutil.rmtree(work)
    return 1 if bad or named < 0.65 else 0


if __name__ == "__main__":
    sys.exit(main())
