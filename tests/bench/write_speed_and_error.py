#!/usr/bin/env python3
"""Writes docs/benchmarks/speed-and-error.md and docs/images/work-precision.svg from one run of the bench.

    cmake --preset release -DREACHLAB_BENCH_PEERS=ON && ninja -C build/release reach
    tests/bench/write_speed_and_error.py build/release

Every number of the page comes from the programs' output; the text around them stands here.
"""
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PEERS = ("odeint-", "cvode-")
# scene: (smallest ratio to the best peer at a state error of 1e-6, at 1e-10); None: no bound at that error.
GOALS = {
    "S1": (2, 3), "S1b50": (None, 4), "S1b500": (None, 6), "S2a": (None, 2.5), "S2b": (None, 2.5), "S3": (None, 2.5), "S4": (None, 2.5),
    "S6": (1, 1), "S7a": (None, 20), "S7b": (None, 20), "S7d": (None, 6), "S7e": (None, 6), "S8": (None, 2.5),
}
HARD = ("S5", "S5h", "S7c")
HARD_TICKS = 1350


def run(*command):
    print("+", " ".join(map(str, command)), file=sys.stderr, flush=True)
    return subprocess.run([str(c) for c in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def price(row):
    if row is None:
        return "–"
    setting = f"tol {row['tolerance']:.0e}" if row["tolerance"] else f"{row['step_s'] * 1e3:g} ms"
    return f"{row['ns_per_ms']:.0f} ({row['method']}, {setting})"


def cheapest(rows, scene, bound, wanted):
    fit = [r for r in rows if r["scene"] == scene and wanted(r["method"]) and r["ns_per_ms"] and r["state_error"] is not None
           and r["state_error"] <= bound]
    return min(fit, key=lambda r: r["ns_per_ms"], default=None)


def is_peer(method):
    return method.startswith(PEERS)


def met(yes):
    return "met" if yes else "**missed**"


def hard_table(text, rows):
    """Near-cusps: the most right-hand sides in one millisecond, at the scene's median price of one."""
    lines = ["| scene | position error m | right-hand sides of the worst tick, ≤ 1000 | ns for one, median | product µs, ≤ 100 | |", "|---|---|---|---|---|---|"]
    for scene in HARD:
        row = next(r for r in rows if r["scene"] == scene and r["method"] == "auto")
        columns = next(line for line in text.splitlines() if re.match(rf"{scene} +auto ", line)).split()
        worst = int(columns[12])  # after scene, method, 1 ms, errors, price, its quartiles, steps and right-hand sides
        one = row["ns_per_ms"] * HARD_TICKS / row["rhs_evaluations"]
        good = row["position_error_m"] <= 1e-10 and worst <= 1000 and worst * one <= 1e5
        lines.append(f"| {scene} | {row['position_error_m']:.1e} | {worst} | {one:.0f} | {worst * one * 1e-3:.0f} | {met(good)} |")
    return "\n".join(lines)


def ratio_table(rows):
    lines = ["| scene | error ≤ | `auto` ns/ms | best peer ns/ms | ratio | wanted | |", "|---|---|---|---|---|---|---|"]
    for scene in dict.fromkeys(r["scene"] for r in rows):
        for i, bound in enumerate((1e-6, 1e-10)):
            own = cheapest(rows, scene, bound, lambda m: m == "auto")
            peer = cheapest(rows, scene, bound, is_peer)
            ratio = f"{peer['ns_per_ms'] / own['ns_per_ms']:.1f}" if own and peer else "–"
            goal = GOALS.get(scene, (None, None))[i]
            verdict = "" if goal is None or ratio == "–" else met(peer["ns_per_ms"] / own["ns_per_ms"] >= goal)
            lines.append(f"| {scene} | {bound:.0e} | {price(own)} | {price(peer)} | {ratio} | {'≥ %g' % goal if goal else ''} | {verdict} |")
    return "\n".join(lines)


def own_table(rows):
    lines = ["| scene | method | step ms | tolerance | state error | position error m | ns/ms | right-hand sides |", "|---|---|---|---|---|---|---|---|"]
    for r in rows:
        if is_peer(r["method"]):
            continue
        error = ["failed" if r[k] is None else f"{r[k]:.1e}" for k in ("state_error", "position_error_m")]
        cost = "–" if r["ns_per_ms"] is None else f"{r['ns_per_ms']:.0f}"
        tolerance = f"{r['tolerance']:.0e}" if r["tolerance"] else ""
        lines.append(f"| {r['scene']} | {r['method']} | {r['step_s'] * 1e3:g} | {tolerance} | {error[0]} | {error[1]} | {cost} | {r['rhs_evaluations']} |")
    return "\n".join(lines)


def processor():
    try:
        return next(line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name"))
    except (OSError, StopIteration):
        return "an unknown processor"


def write_page(name, texts):
    """docs/benchmarks/NAME.md from NAME.md.in beside this file, with each text in place of its @KEY@."""
    page = pathlib.Path(__file__).with_name(f"{name}.md.in").read_text()
    for key, text in texts.items():
        page = page.replace(f"@{key}@", text)
    (ROOT / f"docs/benchmarks/{name}.md").write_text(page)


def main():
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release").resolve()
    images = ROOT / "docs" / "images"
    images.mkdir(parents=True, exist_ok=True)
    rows_file = build / "bench-rows.json"
    reach = build / "cli" / "reach"
    table = run(reach, "bench", "--json", rows_file, "--svg", images / "work-precision.svg")
    rows = json.loads(rows_file.read_text())
    sampled = run(reach, "bench", "--sampled")
    tick = run(reach, "bench", "--tick")
    write_page("speed-and-error", {"PROCESSOR": processor(), "RATIOS": ratio_table(rows), "OWN": own_table(rows), "HARD": hard_table(table, rows),
                                   "SAMPLED": sampled.rstrip(), "TICK": tick.rstrip()})


if __name__ == "__main__":
    main()
