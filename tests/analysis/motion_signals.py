"""What the oracles of an analysis share: the program, and the filter and derivative of docs/analysis.md."""
import subprocess, sys

import numpy as np
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
