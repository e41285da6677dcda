#!/usr/bin/env python3
"""Virtual subjects beside the recorded reaches of a person, where they can be compared: one mass in free space.

    tests/long/subjects_beside_people.py build/release --figure docs/images/subjects-beside-people.svg

Each does 19 reaches of free-point, which is analysed. A profile of the hand's speed is divided by its peak, and its time, from the peak, by the
time that it is above half of the peak: people's recordings end in a slow drift, so that a whole duration says little of them. Prints a table.
"""
import argparse
import csv
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
WHO = {"a person": f"replay:{ROOT}/resources/reaches", "plan": "simulated", "impedance": "simulated:kind=impedance", "ofc": "simulated:kind=ofc"}
COLOURS = {"a person": "#333333", "plan": "#1f77b4", "impedance": "#2ca02c", "ofc": "#d62728"}
AT = [i / 20 for i in range(-24, 25)]  # times above half of the peak, from the peak


def run(*command):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.stderr}")


def between(x, xs, ys):
    """Linear; nothing beyond the ends."""
    for a, b, u, v in zip(xs, xs[1:], ys, ys[1:]):
        if a <= x <= b:
            return u + (v - u) * (x - a) / (b - a) if b > a else u
    return None


def shape(times, speeds):
    """Speed over its peak at AT, and the width above half of the peak [s]."""
    top = max(range(len(speeds)), key=speeds.__getitem__)
    peak, first, last = speeds[top], top, top
    while first > 0 and speeds[first] > peak / 2:
        first -= 1
    while last + 1 < len(speeds) and speeds[last] > peak / 2:
        last += 1
    rise = times[first] + (peak / 2 - speeds[first]) / (speeds[first + 1] - speeds[first]) * (times[first + 1] - times[first])
    fall = times[last] - (peak / 2 - speeds[last]) / (speeds[last - 1] - speeds[last]) * (times[last] - times[last - 1])
    width = fall - rise
    return [between(a, [(t - times[top]) / width for t in times], [v / peak for v in speeds]) for a in AT], width, (times[top] - rise) / width


def shapes(folder):
    trials = {}
    with open(folder / "profiles.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            trials.setdefault((row["run"], row["trial"]), []).append((float(row["time_s"]), float(row["hand_m_per_s"])))
    return [shape(*zip(*points)) for points in trials.values()]


def column(values):
    present = [v for v in values if v is not None]
    return (statistics.mean(present), statistics.stdev(present)) if len(present) > 4 else (None, None)


def figure(file, curves):
    left, top, width, height = 60, 30, 420, 220
    x, y = lambda a: left + width * (a + 1.2) / 2.4, lambda v: top + height * (1 - v / 1.1)
    svg = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 620 310" font-family="DejaVu Sans, sans-serif" font-size="12">',
           '<rect width="620" height="310" fill="white"/>', f'<path d="M{left} {top}V{top + height}H{left + width}" fill="none" stroke="black"/>']
    for i, (name, points) in enumerate(curves.items()):
        there = [(a, mean, sd) for a, (mean, sd) in zip(AT, points) if mean is not None]
        band = [(a, m + s) for a, m, s in there] + [(a, max(0, m - s)) for a, m, s in reversed(there)]
        svg.append(f'<polygon fill="{COLOURS[name]}" fill-opacity="0.15" points="' + " ".join(f"{x(a):.1f},{y(v):.1f}" for a, v in band) + '"/>')
        svg.append(f'<polyline fill="none" stroke="{COLOURS[name]}" stroke-width="2" points="' +
                   " ".join(f"{x(a):.1f},{y(m):.1f}" for a, m, _ in there) + '"/>')
        svg.append(f'<path d="M500 {50 + 22 * i}h24" stroke="{COLOURS[name]}" stroke-width="3"/><text x="530" y="{54 + 22 * i}">{name}</text>')
    for a in (-1, -0.5, 0, 0.5, 1):
        svg.append(f'<text x="{x(a):.0f}" y="{top + height + 18}" text-anchor="middle">{a:g}</text>')
    for v in (0, 0.5, 1):
        svg.append(f'<text x="{left - 8}" y="{y(v) + 4:.0f}" text-anchor="end">{v:g}</text>')
    svg += [f'<text x="{left + width / 2:.0f}" y="{top + height + 40}" text-anchor="middle">time from the peak, in times above half of it</text>',
            f'<text x="18" y="{top + height / 2:.0f}" text-anchor="middle" transform="rotate(-90 18 {top + height / 2:.0f})">hand speed over its peak</text>', "</svg>"]
    pathlib.Path(file).write_text("\n".join(svg) + "\n", encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--figure")
    wishes = parser.parse_args()
    reach, curves, rows = wishes.build / "cli" / "reach", {}, []
    with tempfile.TemporaryDirectory(prefix="reach-people-") as work:
        for i, (name, device) in enumerate(WHO.items()):
            data, out = pathlib.Path(work) / f"data{i}", pathlib.Path(work) / f"out{i}"
            run(reach, "run", "free-point", "--device", device, "--trials", 19, "--seed", 1, "--fast", "--data", data)
            run(reach, "analyze", data, "--out", out, "--criterion", "min-hand-jerk")
            found = shapes(out)
            curves[name] = [column([s[0][k] for s in found]) for k in range(len(AT))]
            with open(out / "trials.csv", encoding="utf-8") as file:
                good = [row for row in csv.DictReader(file) if row["outcome"] == "success"]
            of = lambda key: [float(row[key]) for row in good]
            both = lambda values, digits: f"{statistics.mean(values):.{digits}f} ± {statistics.stdev(values):.{digits}f}"
            spread = lambda values: 100 * statistics.stdev(values) / statistics.mean(values)
            off = [abs(mine[0] - theirs[0]) for mine, theirs in zip(curves[name], curves["a person"]) if mine[0] is not None and theirs[0] is not None]
            flank = [sd for a, (_, sd) in zip(AT, curves[name]) if sd is not None and 0.3 <= abs(a) <= 0.8]
            rows.append((name, len(good), spread(of("peak_speed_m_per_s")), spread([s[1] for s in found]), both([s[2] for s in found], 2),
                         statistics.mean(flank), (sum(v * v for v in off) / len(off)) ** 0.5, both(of("speed_peaks"), 1)))
    print("| | successes of 19 | peak speed, SD % | time above half, SD % | of it before the peak | SD of the scaled profile | RMS to the person's mean | peaks |")
    print("|---|---|---|---|---|---|---|---|")
    for name, good, peak, width, before, scatter, off, peaks in rows:
        print(f"| {name} | {good} | {peak:.0f} | {width:.0f} | {before} | {scatter:.3f} | {off:.3f} | {peaks} |")
    if wishes.figure:
        figure(wishes.figure, curves)


if __name__ == "__main__":
    main()
