#!/usr/bin/env python3
"""A reach with the mouse, by real events:
  mouse_reach.py way DATA FILE          the hand's way in the first successful trial of a dataset, from the go signal on: lines of seconds and metres
  mouse_reach.py go DATA NUMBER         waits for so many go signals in the dataset's log; exits 1 when they do not come within 20 s
  mouse_reach.py drag FILE START TARGET  moves the pointer along that way, from START to TARGET in pixels
  mouse_reach.py back START TARGET       and back, by minimum jerk, in a second and a half
The pointer is where it should be by the clock, however late this program is woken up."""
import bisect
import csv
import ctypes
import glob
import sys
import time

from station_log import StationLog

GO = 3  # record::EventKind


def way(data, out):
    events = glob.glob(f"{data}/sub-*/ses-*/motion/*_events.tsv")[0]
    with open(events) as file:
        trial = next(row for row in csv.DictReader(file, delimiter="\t") if row["outcome"] == "success")
    motion = events.replace("_events.tsv", "_motion.tsv")
    with open(motion.replace("_motion.tsv", "_channels.tsv")) as file:
        names = [row["name"] for row in csv.DictReader(file, delimiter="\t")]
    time_at, x_at, trial_at = (names.index(name) for name in ("latency", "hand_pos_x", "trial"))
    with open(motion) as file:
        rows = [[float(row[time_at]), float(row[x_at]), row[trial_at]] for row in csv.reader(file, delimiter="\t")]
    begin = rows[0][0] + float(trial["go"])
    with open(out, "w") as file:
        for t, x, number in rows:
            if number == trial["trial"] and t >= begin:
                file.write(f"{t - begin:.4f} {x:.6f}\n")


def go(data, number):
    until = time.monotonic() + 20
    while time.monotonic() < until:
        for path in glob.glob(f"{data}/sourcedata/*_log.reach"):
            if sum(event[1] == GO for event in StationLog(path).events) >= number:
                return
        time.sleep(0.02)
    sys.exit(1)


class Pointer:
    def __init__(self):
        self.x11, self.xtest = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXtst.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(None))
        self.at = 0

    def move_to(self, x):  # pixels from where it was at first
        if x == self.at:
            return
        self.xtest.XTestFakeRelativeMotionEvent(self.display, x - self.at, 0, ctypes.c_ulong(0))
        self.x11.XFlush(self.display)
        self.at = x

    def follow(self, place, seconds):
        begin = time.monotonic()
        while (t := time.monotonic() - begin) < seconds:
            self.move_to(round(place(t)))
            time.sleep(0.004)
        self.move_to(round(place(seconds)))


def drag(file, start, target):
    with open(file) as lines:
        points = [tuple(map(float, line.split())) for line in lines]
    times, first, last = [t for t, _ in points], points[0][1], points[-1][1]

    def place(t):
        i = min(max(bisect.bisect_right(times, t), 1), len(points) - 1)
        (t0, x0), (t1, x1) = points[i - 1], points[i]
        x = x0 + (x1 - x0) * min(max((t - t0) / (t1 - t0), 0), 1)
        return (target - start) * (x - first) / (last - first)

    Pointer().follow(place, times[-1])


def back(start, target, seconds=1.5):
    def place(t):
        s = min(t / seconds, 1)
        return (start - target) * s**3 * (10 - 15 * s + 6 * s * s)

    Pointer().follow(place, seconds)


what, *words = sys.argv[1:] or [""]
if what == "way":
    way(*words)
elif what == "go":
    go(words[0], int(words[1]))
elif what == "drag":
    drag(words[0], float(words[1]), float(words[2]))
elif what == "back":
    back(float(words[0]), float(words[1]))
else:
    sys.exit(__doc__)
