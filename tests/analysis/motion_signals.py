"""What the oracles of an analysis share: the program, its files, and the filter and derivative of docs/analysis.md."""
import subprocess, sys

import numpy as np
import pandas as pd
from scipy import signal

REACH, RATE, CUTOFF = sys.argv[1], 100.0, 10.0


def reach(*arguments):
    done = subprocess.run([REACH, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"reach {' '.join(map(str, arguments))}: exit {done.returncode}: {done.stderr}")
    return done.stdout


def lowPass(x, rate=RATE):
    b, a = signal.butter(2, CUTOFF, fs=rate)
    return signal.filtfilt(b, a, x, axis=0, padtype="odd", padlen=9)


def differentiate(x):
    v = np.empty_like(x)
    v[1:-1] = (x[2:] - x[:-2]) * RATE / 2
    v[2:-2] = (8 * (x[3:-1] - x[1:-3]) - (x[4:] - x[:-4])) * RATE / 12
    v[0] = (4 * x[1] - 3 * x[0] - x[2]) * RATE / 2
    v[-1] = (3 * x[-1] - 4 * x[-2] + x[-3]) * RATE / 2
    return v


def sampled(x, rate, times):
    """Catmull and Rom's cubic, linear in the first and the last interval, held beyond."""
    at = np.clip(np.asarray(times) * rate, 0, len(x) - 1)
    i = np.minimum(np.floor(at).astype(int), len(x) - 2)
    s, inner = at - i, (np.asarray(times) * rate >= 1) & (np.asarray(times) * rate < len(x) - 2)
    linear = (1 - s) * x[i] + s * x[i + 1]
    p0, p1, p2, p3 = x[np.maximum(i - 1, 0)], x[i], x[i + 1], x[np.minimum(i + 2, len(x) - 1)]
    cubic = p1 + 0.5 * s * (p2 - p0 + s * (2 * p0 - 5 * p1 + 4 * p2 - p3 + s * (3 * (p1 - p2) + p3 - p0)))
    return np.where(inner, cubic, linear)


def readRun(motion):
    name = str(motion)[: -len("motion.tsv")]
    columns = pd.read_csv(name + "channels.tsv", sep="\t")["name"]
    rows = pd.read_csv(motion, sep="\t", header=None, names=list(columns))
    return rows, pd.read_csv(name + "events.tsv", sep="\t", keep_default_na=False, na_values=["n/a"])


def readTable(file):
    return pd.read_csv(file, dtype={"subject": str, "session": str}, float_precision="round_trip")
