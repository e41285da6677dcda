#!/usr/bin/python3
"""`reach adaptation` against SciPy's bounded least squares on twenty noisy series. $1 is the program `reach`.

The cost has one minimum for the data and several for the optimiser, so what must agree is the least mean square. The parameters must agree
where the series determines them: both optimisers stop at 1e-12 of the cost, so 1e-5 of a parameter is asked for.
"""
import json, pathlib, sys, tempfile

import numpy as np
from scipy.optimize import least_squares

from motion_signals import reach


def simulate(af, bf, as_, bs, perturbation):
    f = s = 0.0
    x = []
    for p in perturbation:
        x.append(f + s)
        e = 0.0 if np.isnan(p) else p - f - s
        f, s = af * f + bf * e, as_ * s + bs * e
    return np.array(x)


def best(perturbation, response):
    """Parameters as fractions of the one that bounds them, each from 0 to 1: A_s, A_f / A_s, B_f, B_s / B_f."""
    states = lambda q: (q[1] * q[0], q[2], q[0], q[3] * q[2])
    residual = lambda q: simulate(*states(q), perturbation) - response
    found = []
    for slow in (0.95, 0.995):
        for fast in (0.3, 0.8):
            for rate in (0.1, 0.4):
                for share in (0.05, 0.3):
                    found.append(least_squares(residual, [slow, fast, rate, share], bounds=(0, 1), xtol=1e-14, ftol=1e-14, gtol=1e-14))
    least = min(found, key=lambda r: r.cost)
    return states(least.x), 2 * least.cost / len(response)


rng = np.random.default_rng(11)
worst = {"mse": 0.0, "parameters": 0.0}
with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder) / "series.csv"
    for number in range(20):
        truth = (rng.uniform(0.4, 0.85), rng.uniform(0.08, 0.3), rng.uniform(0.98, 0.998), rng.uniform(0.01, 0.05))
        perturbation = np.concatenate([np.zeros(20), np.ones(150), -np.ones(15), np.full(60, np.nan)])
        perturbation[30:170:8] = np.nan  # channel trials among those in the field
        response = simulate(*truth, perturbation) + rng.normal(0, 0.05, len(perturbation))
        file.write_text("perturbation,response\n" + "".join(f"{'' if np.isnan(p) else repr(float(p))},{float(r)!r}\n" for p, r in zip(perturbation, response)))
        ours = json.loads(reach("adaptation", file, "--json", "--resamples", "100"))["two_state"]
        theirs, mse = best(perturbation, response)
        worst["mse"] = max(worst["mse"], abs(ours["mse"] / mse - 1))
        worst["parameters"] = max(worst["parameters"], max(abs(ours[k] - v) for k, v in zip(("a_f", "b_f", "a_s", "b_s"), theirs)))
print("largest differences of 20 series: " + ", ".join(f"{k} {v:.1e}" for k, v in worst.items()))
if worst["mse"] > 1e-8 or worst["parameters"] > 1e-5:
    sys.exit("the fits do not agree")
