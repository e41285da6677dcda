#!/usr/bin/env python3
"""What a trial of a study costs, how it scales over threads, shares and ranks, and what that makes of a thousand processors.

    tests/long/study_speed.py build/release                                          # some minutes
    tests/long/study_speed.py build/release --trials 1000,10000,100000,1000000 --figure docs/images/study-scaling.svg

Processor time is what the process, its threads and its ranks used; ways of dividing the work are timed in turn, rounds of the same study, and
compared within a round. Ranks are timed with their start, which is measured by itself on a study that is done: --ways has to be many times
that long. Exit 1 when two ways give other bytes; no time is judged.
"""
import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

SUBJECT_TRIALS = 100
KINDS = {"plan": {"kind": "plan"}, "impedance": {"kind": "impedance"}, "ofc": {"kind": "ofc"}}


def study(folder, name, trials, subject, chunk=None):
    design = {"schema_version": 1, "name": "speed", "seed": 1, "experiment": "chain-moderate", "subject": subject,
              "subjects": max(1, trials // SUBJECT_TRIALS), "trials": min(trials, SUBJECT_TRIALS)}
    if chunk:
        design["chunk_trials"] = chunk
    file = folder / f"{name}.json"
    file.write_text(json.dumps(design))
    return file


def start(*command):
    return subprocess.Popen([str(part) for part in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def finish(process):
    """Processor seconds, with those of processes that it waited for, and largest memory [kB]."""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{process.args}: {process.stderr.read().decode()}")
    process.stderr.close()
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss


def sizes(out):
    chunks = list((out / "chunks").rglob("*.chunk"))
    return {"chunks": len(chunks), "chunk bytes": sum(f.stat().st_size for f in chunks),
            "csv": (out / "trials.csv.gz").stat().st_size, "h5": (out / "trials.h5").stat().st_size}


def costs(reach, folder, counts, told):
    """One process on one thread: processor time and memory by the number of trials."""
    print("| subjects | trials | processor time a trial [ms] | largest memory [MB] |\n|---|---|---|---|")
    for kind, subject in KINDS.items():
        for count in counts if kind == "plan" else [n for n in counts if n <= (2_000 if kind == "ofc" else 10_000)]:
            out = folder / f"{kind}-{count}"
            used, memory = finish(start(reach, "study", study(folder, f"{kind}-{count}", count, subject), "--out", out, "--jobs", 1))
            told[kind, count] = used
            if kind == "plan":
                told["sizes"] = {key: value if key == "chunks" else value / count for key, value in sizes(out).items()}
            shutil.rmtree(out)
            print(f"| {kind} | {count:,} | {1e3 * used / count:.3f} | {memory / 1000:.0f} |", flush=True)


def ways(reach, folder, trials, rounds, mpiexec):
    """Wall seconds of the same study divided in different ways, round by round."""
    file = study(folder, "ways", trials, KINDS["plan"], chunk=max(100, trials // 100))  # whoever ends last has a hundredth left, no more
    mpi = reach.parent / "reach-mpi"
    out = folder / "ways"

    def ranks(count):
        return [mpiexec, "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n", count, mpi, file, "--out", out]

    def shares(count):
        return [[reach, "study", file, "--out", out, "--jobs", 1, "--shard", f"{i}/{count}", "--resume"] for i in range(1, count + 1)]

    table = {"one process": [[reach, "study", file, "--out", out, "--jobs", 1]], "two threads": [[reach, "study", file, "--out", out, "--jobs", 2]],
             "two independent processes": shares(2)}
    if mpi.exists() and shutil.which(mpiexec):
        table["two ranks"] = [ranks(2)]
    seconds, used, starts, bytes_of = {name: [] for name in table}, {name: [] for name in table}, [], {}
    for _ in range(rounds):
        for name, commands in table.items():
            begin = time.monotonic()
            used[name].append(sum(finish(process)[0] for process in [start(*command) for command in commands]))
            seconds[name].append(time.monotonic() - begin)
            finish(start(reach, "study", file, "--out", out, "--resume"))  # tables, where two ended at once
            if name == "two ranks":
                begin = time.monotonic()
                finish(start(*commands[0], "--resume"))
                starts.append(time.monotonic() - begin)
            bytes_of[name] = (out / "trials.csv.gz").read_bytes() + (out / "trials.h5").read_bytes()
            shutil.rmtree(out)
    if len(set(bytes_of.values())) != 1:
        sys.exit("two ways give other bytes")
    print(f"\n{trials:,} trials, {rounds} rounds on {os.cpu_count()} processors, medians (least to most):\n\n"
          "| way | wall time [s] | processor time [s] | times one process | times two independent processes |\n|---|---|---|---|---|")
    told = lambda values: f"{statistics.median(values):.2f} ({min(values):.2f} to {max(values):.2f})"
    speed = {}
    for name, times in seconds.items():
        ratios, beside = ([a / b for a, b in zip(seconds[other], times)] for other in ("one process", "two independent processes"))
        speed[name] = statistics.median(ratios)
        print(f"| {name} | {statistics.median(times):.1f} | {statistics.median(used[name]):.1f} | {told(ratios)} | {told(beside)} |", flush=True)
    if starts:
        print(f"\nstart and end of two ranks with nothing to do: {statistics.median(starts):.2f} s")
    return speed


def projection(told, counts):
    """A thousand processors, on paper: bytes, files, seconds, from what was measured."""
    most, each = counts[-1], told["plan", counts[-1]] / counts[-1]
    per = told["sizes"]
    print("\n| on 1,000 processors | trials | chunks (files) | longest share [s] | chunks [GB] | CSV, HDF5 [GB] |\n|---|---|---|---|---|---|")
    for trials in (10**6, 10**8, 10**9):
        chunk = min(max(trials // 1000, 2_000), 100_000)
        files = -(-trials // chunk)
        share = -(-files // 1000) * chunk * each
        print(f"| | {trials:,} | {files:,} | {share:,.0f} | {trials * per['chunk bytes'] / 1e9:.3g} | {trials * per['csv'] / 1e9:.3g}, {trials * per['h5'] / 1e9:.3g} |")
    print(f"\nfrom {each * 1e3:.3f} ms, {per['chunk bytes']:.1f} B of chunk, {per['csv']:.1f} B of CSV and {per['h5']:.1f} B of HDF5 a trial at {most:,} trials")


def figure(file, told, counts, speed):
    """Two panels: cost a trial by the number of trials, and speed by the way of dividing."""
    width, height, left, top, plot = 760 if speed else 400, 300, 60, 40, 200
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="DejaVu Sans, sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="white"/>']
    text = lambda x, y, words, anchor="middle", more="": svg.append(f'<text x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}" {more}>{words}</text>')
    each = [1e3 * told["plan", n] / n for n in counts]
    ceiling = max(each) * 1.2
    text(left + 130, 20, "processor time a trial [ms], open-loop hand")
    svg.append(f'<path d="M{left} {top}V{top + plot}H{left + 260}" fill="none" stroke="black"/>')
    for k in range(5):
        y = top + plot - plot * k / 4
        svg.append(f'<path d="M{left} {y:.0f}H{left + 260}" stroke="#ddd"/>')
        text(left - 6, y + 4, f"{ceiling * k / 4:.2f}", "end")
    at = [(left + 30 + 200 * i / max(1, len(counts) - 1), top + plot - plot * value / ceiling) for i, value in enumerate(each)]
    svg.append('<polyline fill="none" stroke="#1f77b4" stroke-width="2" points="' + " ".join(f"{x:.0f},{y:.1f}" for x, y in at) + '"/>')
    for (x, y), n, value in zip(at, counts, each):
        svg.append(f'<circle cx="{x:.0f}" cy="{y:.1f}" r="4" fill="#1f77b4"/>')
        text(x, y - 10, f"{value:.3f}")
        text(x, top + plot + 18, f"{n:,}")
    text(left + 130, top + plot + 38, "trials")
    begin = 430
    if speed:
        text(begin + 160, 20, "speed, one process = 1")
        svg.append(f'<path d="M{begin} {top}V{top + plot}M{begin + 260} {top}V{top + plot}" stroke="#999" stroke-dasharray="3 3"/>')
        text(begin + 260, top + plot + 18, "2")
    for i, (name, value) in enumerate(speed.items()):
        y = top + 10 + 46 * i
        svg.append(f'<rect x="{begin}" y="{y + 16}" width="{130 * value:.0f}" height="18" fill="{"#bbb" if i == 0 else "#1f77b4"}"/>')
        text(begin, y + 11, name, "start")
        text(begin + 130 * value + 6, y + 30, f"{value:.2f}", "start")
    svg.append("</svg>")
    pathlib.Path(file).write_text("\n".join(svg) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--trials", default="1000,10000")
    parser.add_argument("--ways", type=int, default=60_000, help="trials of the study that is divided; 0: none is")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--mpiexec", default="mpirun")
    parser.add_argument("--figure")
    wishes = parser.parse_args()
    counts, told = [int(n) for n in wishes.trials.split(",")], {}
    reach = (wishes.build / "cli" / "reach").resolve()
    with tempfile.TemporaryDirectory(prefix="reach-study-") as folder:
        costs(reach, pathlib.Path(folder), counts, told)
        speed = ways(reach, pathlib.Path(folder), wishes.ways, wishes.rounds, wishes.mpiexec) if wishes.ways else {}
    projection(told, counts)
    if wishes.figure:
        figure(wishes.figure, told, counts, speed)


if __name__ == "__main__":
    main()
