#!/usr/bin/env python3
"""Lets every n-th write, read, fsync, rename, open, flock, mmap and malloc of `reach` fail: the first --first of each, then --seeded at random.

    tests/long/injected_faults.py build/dev                      # 2000 and 500, about 13,000 commands: half an hour
    tests/long/injected_faults.py build/dev --first 60 --seeded 10

Commands: a run of three trials, its resumption, export, analyze, recover. What must hold: no trial that was announced is lost; a command
that ends with 0 has done all of its work; each ends, none dies of a signal, and each that fails says why. SQLite tests its own code in this way.
"""
import argparse
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

from station_log import records

KINDS = ["write", "read", "fsync", "rename", "open", "lock", "mmap", "malloc"]
TRIAL, INTERRUPTED = 5, 4  # docs/recording.md: type of a trial's record, and its outcome


def trials_in(log):
    """Outcome by number of the trials of a log."""
    trials = (struct.unpack_from("<iiiBB", payload) for kind, payload, _ in records(log.read_bytes()) if kind == TRIAL)
    return {trial: outcome for trial, _, _, _, outcome in trials}


class Bench:
    """Where commands run, one after another, each with at most one fault."""

    def __init__(self, build, scratch):
        scratch.mkdir()
        self.reach = str((build / "cli" / "reach").resolve())
        self.scratch = scratch
        self.shim = scratch / "shim.so"
        source = pathlib.Path(__file__).with_name("fault_shim.c")
        subprocess.run(["cc", "-shared", "-fPIC", "-O2", "-fno-builtin", "-o", self.shim, source, "-ldl"], check=True)
        self.half = scratch / "half"  # a session that broke off in its second trial
        self.whole = scratch / "whole"
        for data in (self.half, self.whole):
            self.run(["run", "dingwell", "--device", "simulated", "--trials", "3", "--seed", "1", "--fast", "--disk-reserve", "0", "--data", data])
        log = next((self.half / "sourcedata").glob("*.reach"))
        log.write_bytes(log.read_bytes()[:log.stat().st_size * 55 // 100])

    def run(self, command, kind=None, at=0):
        environment = dict(os.environ, OMP_NUM_THREADS="1")
        count = self.scratch / "count"
        count.unlink(missing_ok=True)
        if kind:
            environment.update(LD_PRELOAD=str(self.shim), FAULT_KIND=kind, FAULT_AT=str(at), FAULT_COUNT=str(count))
        ended = subprocess.run([self.reach, *map(str, command)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, env=environment,
                               text=True, errors="replace", timeout=120)
        return ended, int(count.read_text()) if count.exists() and count.read_text().strip() else 0

    @staticmethod
    def kept(data):
        """How many trials are recorded that were not broken off."""
        return sum(outcome != INTERRUPTED for log in pathlib.Path(data).glob("sourcedata/*.reach") for outcome in trials_in(log).values())


def files_of(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file() and p.suffix in (".csv", ".tsv")}


def scenarios(bench):
    """name, prepare() -> folder, command(folder), check(folder, ended) -> what is wrong, or ''."""

    def fresh():
        folder = bench.scratch / "work"
        shutil.rmtree(folder, ignore_errors=True)
        return folder

    def copy_of(source):
        folder = fresh()
        shutil.copytree(source, folder)
        return folder

    def announced_are_kept(folder, ended):
        announced = [line for line in ended.stdout.splitlines() if line.startswith("trial=")]
        kept = bench.kept(folder)
        if kept < len(announced):
            return f"{len(announced)} trials announced, {kept} kept"
        if ended.returncode == 0 and kept < 3:
            return f"exit 0 and {kept} of 3 trials"
        return ""

    run = ["run", "dingwell", "--device", "simulated", "--trials", "3", "--seed", "1", "--fast", "--disk-reserve", "0", "--data"]
    resume = ["run", "dingwell", "--device", "simulated", "--fast", "--resume", "--disk-reserve", "0", "--data"]
    yield "run", fresh, lambda f: [*run, f], announced_are_kept
    yield "resume", lambda: copy_of(bench.half), lambda f: [*resume, f], lambda f, e: "" if (
        bench.kept(f) >= (3 if e.returncode == 0 else 1)) else f"exit {e.returncode} and {bench.kept(f)} trials are left"

    for name, options in (("export", ["--format", "csv"]), ("analyze", [])):
        command = lambda f, name=name, options=options: [name, f, *options, "--out", f / "out"]
        folder = copy_of(bench.whole)
        bench.run(command(folder))

        def check(folder, ended, expected=files_of(folder / "out")):
            same = ended.returncode != 0 or files_of(folder / "out") == expected
            return "" if same else "exit 0 and its tables are not what they are without the fault"

        yield name, lambda: copy_of(bench.whole), command, check

    yield ("recover", lambda: copy_of(bench.half), lambda f: ["recover", *sorted((f / "sourcedata").glob("*.reach"))],
           lambda f, _: "" if bench.kept(f) >= 1 else "the first trial is lost")


def try_faults(bench, scenario, kind, points):
    """What is wrong after each of these faults: [(at, what)]."""
    prepare, command, check = scenario
    findings = []
    for at in points:
        folder = prepare()
        try:
            ended, _ = bench.run(command(folder), kind, at)
        except subprocess.TimeoutExpired as late:
            findings.append((at, f"has not ended after {late.timeout} s"))
            continue
        why = check(folder, ended)
        if ended.returncode < 0:
            why = f"died of signal {-ended.returncode}" + (f"; {why}" if why else "")
        elif ended.returncode not in (0, 2, 3, 4):
            why = f"exit code {ended.returncode}" + (f"; {why}" if why else "")
        elif ended.returncode != 0 and not ended.stderr.strip():
            why = f"exit {ended.returncode} without a word"
        if why:
            findings.append((at, f"{why}: {ended.stderr.strip().splitlines()[-1:]}"))
    return findings


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=2000)
    parser.add_argument("--seeded", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--scenarios", default="run,resume,export,analyze,recover")
    parser.add_argument("--at", type=int, help="only this call")
    parser.add_argument("--jobs", type=int, default=1)
    wishes = parser.parse_args()
    chance = random.Random(wishes.seed)
    findings = faults = 0
    with tempfile.TemporaryDirectory(prefix="reach-faults-") as scratch, ThreadPoolExecutor(wishes.jobs) as workers:
        benches = [Bench(wishes.build, pathlib.Path(scratch) / str(job)) for job in range(wishes.jobs)]
        of_bench = [{name: rest for name, *rest in scenarios(bench)} for bench in benches]
        for name in wishes.scenarios.split(","):
            for kind in wishes.kinds.split(","):
                prepare, command, _ = of_bench[0][name]
                _, total = benches[0].run(command(prepare()), kind)
                beyond = range(wishes.first + 1, total + 1)
                points = [*range(1, min(total, wishes.first) + 1), *sorted(chance.sample(beyond, min(wishes.seeded, len(beyond))))]
                if wishes.at:
                    points = [wishes.at]
                parts = [workers.submit(try_faults, benches[job], of_bench[job][name], kind, points[job::wishes.jobs]) for job in range(wishes.jobs)]
                found = sorted(finding for part in parts for finding in part.result())
                for at, why in found[:20]:
                    print(f"{name}: {kind} {at} of {total}: {why}", flush=True)
                print(f"{name}: {len(points)} of {total} {kind}: {len(found)} findings", flush=True)
                faults += len(points)
                findings += len(found)
    print(f"injected faults: {faults}, findings: {findings}")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
