#!/usr/bin/env python3
"""Lets every n-th write, read, fsync, rename, open, mmap and malloc of `reach` fail: the first --first of each, then --seeded at random.

    tests/long/injected_faults.py build/dev                      # 2000 and 500, as long as it takes
    tests/long/injected_faults.py build/dev --first 60 --seeded 10

Commands: a run of three trials, its resumption, export, analyze, recover. What must hold: no trial that was announced is lost; a command
that ends with 0 has done all of its work; no command dies of a signal, and each that fails says why. SQLite tests its own code in this way.
"""
import argparse
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

KINDS = ["write", "read", "fsync", "rename", "open", "mmap", "malloc"]


class Bench:
    def __init__(self, build, scratch):
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
                               text=True, errors="replace", timeout=300)
        return ended, int(count.read_text()) if count.exists() and count.read_text().strip() else 0

    def trials(self, data):
        """The recorded trials, from the logs, without a fault."""
        out = self.scratch / "csv"
        shutil.rmtree(out, ignore_errors=True)
        if not list(pathlib.Path(data).glob("sourcedata/*.reach")):
            return []
        ended, _ = self.run(["export", data, "--format", "csv", "--out", out])
        if ended.returncode != 0 or not (out / "trials.csv").exists():
            return []
        rows = (out / "trials.csv").read_text().splitlines()[1:]
        return [row.split(",")[2:10] for row in rows]


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
        kept = [row for row in bench.trials(folder) if row[5] != "interrupted"]
        if len(kept) < len(announced):
            return f"{len(announced)} trials announced, {len(kept)} kept"
        if ended.returncode == 0 and len(kept) < 3:
            return f"exit 0 and {len(kept)} of 3 trials"
        return ""

    run = ["run", "dingwell", "--device", "simulated", "--trials", "3", "--seed", "1", "--fast", "--disk-reserve", "0", "--data"]
    resume = ["run", "dingwell", "--device", "simulated", "--fast", "--resume", "--disk-reserve", "0", "--data"]
    yield "run", fresh, lambda f: [*run, f], announced_are_kept
    yield "resume", lambda: copy_of(bench.half), lambda f: [*resume, f], lambda f, e: "" if e.returncode != 0 or len(
        [r for r in bench.trials(f) if r[5] != "interrupted"]) >= 3 else "exit 0 and a trial is missing"

    expected = {}
    for name, source, command in (("export", bench.whole, ["export", "F", "--format", "csv", "--out", "F/out"]),
                                  ("analyze", bench.whole, ["analyze", "F", "--out", "F/out"])):
        folder = copy_of(source)
        bench.run([c.replace("F", str(folder)) if c.startswith("F") else c for c in command])
        expected[name] = files_of(folder / "out")

        def check(folder, ended, name=name):
            if ended.returncode != 0:
                return ""
            return "" if files_of(folder / "out") == expected[name] else "exit 0 and its tables are not what they are without the fault"

        yield (name, lambda source=source: copy_of(source), lambda f, command=command: [c.replace("F", str(f)) if c.startswith("F") else c for c in command],
               check)

    def recovered(folder, ended):
        kept = bench.trials(folder)
        return "" if kept and kept[0][5] != "interrupted" else "the first trial is lost"

    yield ("recover", lambda: copy_of(bench.half), lambda f: ["recover", *sorted((f / "sourcedata").glob("*.reach"))], recovered)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--first", type=int, default=2000)
    parser.add_argument("--seeded", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--scenarios", default="run,resume,export,analyze,recover")
    wishes = parser.parse_args()
    chance = random.Random(wishes.seed)
    findings = faults = 0
    with tempfile.TemporaryDirectory(prefix="reach-faults-") as scratch:
        bench = Bench(wishes.build, pathlib.Path(scratch))
        for name, prepare, command, check in scenarios(bench):
            if name not in wishes.scenarios.split(","):
                continue
            for kind in wishes.kinds.split(","):
                _, total = bench.run(command(prepare()), kind)
                beyond = range(wishes.first + 1, total + 1)
                points = [*range(1, min(total, wishes.first) + 1), *sorted(chance.sample(beyond, min(wishes.seeded, len(beyond))))]
                before = findings
                for at in points:
                    folder = prepare()
                    ended, count = bench.run(command(folder), kind, at)
                    faults += 1
                    why = check(folder, ended)
                    if ended.returncode < 0:
                        why = f"died of signal {-ended.returncode}" + (f"; {why}" if why else "")
                    elif ended.returncode not in (0, 2, 3, 4):
                        why = f"exit code {ended.returncode}" + (f"; {why}" if why else "")
                    elif ended.returncode != 0 and not ended.stderr.strip():
                        why = f"exit {ended.returncode} without a word"
                    if why:
                        findings += 1
                        if findings - before <= 12:
                            print(f"{name}: {kind} {at} of {total}: {why}: {ended.stderr.strip().splitlines()[-1:]}", flush=True)
                print(f"{name}: {len(points)} of {total} {kind}: {findings - before} findings", flush=True)
    print(f"injected faults: {faults}, findings: {findings}")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
