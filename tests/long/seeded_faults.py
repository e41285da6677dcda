#!/usr/bin/env python3
"""Puts single faults into the sources, one at a time, and names those that no test notices.

    tests/long/seeded_faults.py --seed 7 --count 20 sim/trial sim/record
    tests/long/seeded_faults.py --seed 7 --count 300                      # everything but the window
    tests/long/seeded_faults.py --seed 7 --seed 8 --count 300             # two draws in one build
    tests/long/seeded_faults.py --seed 7 --count 20 --only 13 sim/trial   # the 13th of the same draw again
    tests/long/seeded_faults.py --seed 7 --count 20 --programs trial,cli sim/trial  # asks two test programs alone, to have an answer sooner

A fault is a comparison, a sign (or * against /), a constant, or a statement left out. The same seed, folders and sources give the same
faults, and a changed line changes no other. It works on a copy of the sources in build/faults (made anew from the working tree at each
start, its objects kept). All faults of a draw stand in one build, each behind a switch that is read when a program starts (fault_draw.py,
fault_sites.py, fault_switch.h; --check compares what is done behind a switch with the fault written out). Every test is run once without a
fault: it tells how long it takes, which faults it comes by, and is left out when it fails. Then each fault is put in force, and the tests
that come by it are run, the nearest and shortest first, until one fails, twice, and passes without the fault; ten times the usual time is a
failure. A fault that no test comes by lives. What bears no switch (constants that the compiler must know) is built alone. A fault that does
not compile is drawn again; one whose object file is bit for bit the old one changes nothing and is not counted; nor is one listed in
equivalent_faults.txt with the reason why it changes nothing that anybody could see. What was noticed is noted in
build/faults/build/judged.jsonl and not tried again by a later start, as long as the file with the fault is the same. Exit 1 when less than
--least of the rest was noticed.
"""
import argparse
import concurrent.futures
import dataclasses
import hashlib
import itertools
import json
import math
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import fault_check
import fault_sites
from fault_draw import ROOT, blanked, describe, draw, faults_of

FOLDERS = ["base", "constraints", "sim", "analysis", "devices", "network", "bench", "cli", "gui"]
SOURCES = FOLDERS + ["tests", "resources", "cmake", "packaging", "docs"]
COPY = ROOT / "build" / "faults"
BUILD = COPY / "build" / "dev"
BUILDERS = "constraints/generate/"  # run while the program is built, when no switch is set
SCRATCH = pathlib.Path("/dev/shm") if os.access("/dev/shm", os.W_OK) else COPY / "tmp"  # a sync costs nothing in memory, and tests record much


def known_equivalents():
    """Lines `FILE: kind: old -> new in: LINE | why`; without line numbers, so that they outlive edits elsewhere."""
    listed = pathlib.Path(__file__).with_name("equivalent_faults.txt")
    lines = listed.read_text(encoding="utf-8").splitlines() if listed.exists() else []
    return {line.split(" | ")[0] for line in lines if " | " in line and not line.startswith("#")}


def run(command, seconds=None, **options):
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds, text=True, errors="replace", **options)
        done.stdout = re.sub(r"\x1b\[[\d;]*[mK]", "", done.stdout)  # colours
        return done
    except subprocess.TimeoutExpired as late:
        return subprocess.CompletedProcess(command, 124, f"longer than {late.timeout:.0f} s", "")


def ninja(*targets):
    return run(["ninja", "-C", str(BUILD), *JOBS, *targets])


def refresh(changed):
    """The copy becomes what the working tree is, but for `changed`; files that stay as they are keep their times, so that little is built."""
    COPY.mkdir(parents=True, exist_ok=True)
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard"], stdout=subprocess.PIPE, text=True)
    names = set(listed.stdout.splitlines())
    if listed.returncode != 0:
        names = {str(p.relative_to(ROOT)) for s in SOURCES for p in (ROOT / s).rglob("*") if p.is_file()} | {"CMakeLists.txt", "CMakePresets.json"}
    for name in sorted(names):
        old, new = ROOT / name, COPY / name
        if not old.is_file():
            continue
        content = changed[name].encode() if name in changed else old.read_bytes()
        if new.is_file() and new.read_bytes() == content:
            continue
        new.parent.mkdir(parents=True, exist_ok=True)
        new.write_bytes(content)
        shutil.copymode(old, new)
    for file in COPY.rglob("*"):
        name = file.relative_to(COPY)
        if file.is_file() and name.parts[0] not in ("build", "tmp") and str(name) not in names:
            file.unlink()


def targets():
    """Every goal of the build, by its path in the build folder."""
    return [line.split(": ")[0] for line in run(["ninja", "-C", str(BUILD), "-t", "targets", "all"]).stdout.splitlines()]


def objects_of(path):
    """The object files that are made of a file, as the last build found them."""
    objects = []
    for block in run(["ninja", "-C", str(BUILD), "-t", "deps"]).stdout.split("\n\n"):
        lines = block.strip().split("\n")
        if any((BUILD / line.strip()).resolve() == COPY / path for line in lines[1:] if line.endswith(path)):
            objects.append(lines[0].split(": ")[0].strip())
    return objects


def hash_of(file):
    return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else None


def suites_near(path):
    """Suites of the test file that is named after the changed one: those look at it most closely."""
    stem = pathlib.Path(path).stem
    suites = set()
    for file in (COPY / "tests").rglob("*.cpp"):
        if file.stem in (stem + "_test", stem.rstrip("s") + "_test", stem + "s_test"):
            suites |= set(re.findall(r"^TEST(?:_F|_P)?\((\w+),", file.read_text(encoding="utf-8"), re.M))
    return suites


@dataclasses.dataclass
class Test:
    """One test as ctest starts it."""
    name: str
    command: list
    folder: str
    environment: dict
    seconds: float = 0
    reached: frozenset = frozenset()
    key: str = ""

    @property
    def program(self):
        return self.command[0]

    @property
    def suite(self):
        return self.name.split("/")[-2 if "/" in self.name else 0].split(".")[0]

    @property
    def is_gtest(self):
        return any(part.startswith("--gtest_filter=") for part in self.command)


def limits(processor_seconds):
    """Signals as a terminal gives them; and no fault may fill the disk or the memory."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (4 << 30, 4 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (16 << 30, 16 << 30))
    for number in (signal.SIGINT, signal.SIGHUP):  # also where this program runs in the background of a shell that ignores them
        signal.signal(number, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_CPU, (processor_seconds, processor_seconds))


RUNNING = set()


def end_all(number, _):
    """A test that does not end does not outlive this program."""
    for process in list(RUNNING):
        os.killpg(process, signal.SIGKILL)
    os._exit(128 + number)


def start(test, seconds, number=0, command=None, seen=None, processor_seconds=3600):
    """(exit code or None when it did not end, output, seconds)."""
    with tempfile.TemporaryDirectory(prefix="fault-", dir=SCRATCH, ignore_cleanup_errors=True) as scratch:
        environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", TMPDIR=scratch, REACHLAB_FAULT=str(number), **test.environment)
        if seen:
            environment["REACHLAB_FAULTS_SEEN"] = str(seen)
        begin = time.monotonic()
        with open(pathlib.Path(scratch) / "out", "w+", encoding="utf-8", errors="replace") as out:
            process = subprocess.Popen(command or test.command, cwd=test.folder, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT,
                                       env=environment, start_new_session=True, preexec_fn=lambda: limits(processor_seconds))
            RUNNING.add(process.pid)
            try:
                code = process.wait(timeout=seconds)
            except subprocess.TimeoutExpired:
                code = None
            try:
                os.killpg(process.pid, 9)  # what it has left behind too
            except ProcessLookupError:
                pass
            process.wait()
            RUNNING.discard(process.pid)
            out.seek(0)
            return code, out.read(), time.monotonic() - begin


def known_tests():
    """What ctest would run, without what is disabled or looks at the sources only."""
    shown = subprocess.run(["ctest", "--test-dir", str(BUILD), "--show-only=json-v1"], stdout=subprocess.PIPE, text=True)
    tests = []
    for entry in json.loads(shown.stdout)["tests"]:
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        if "command" not in entry or properties.get("DISABLED") or entry["name"].startswith(("house", "manual_reference", "manual_site", "manual_schemas")):
            continue
        environment = dict(pair.split("=", 1) for pair in properties.get("ENVIRONMENT", []))
        tests.append(Test(entry["name"], entry["command"], properties.get("WORKING_DIRECTORY", str(BUILD)), environment))
    return tests


def programs(goals):
    """Test programs of the build."""
    return sorted(goal for goal in goals if re.fullmatch(r"tests/(?:\w+/)*test_\w+", goal))


def programs_behind(program):
    """What a test program, or a script, starts as well."""
    if program is None:
        return ["all"]
    return ["cli/reach", "tests/reach_counting"] if program.endswith(("test_cli", "test_hidraw")) else []


def places_of(program):
    """The source file of each test of a program."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        run([program, "--gtest_list_tests", "--gtest_output=json:" + out.name], 60)
        listed = json.loads(pathlib.Path(out.name).read_text(encoding="utf-8") or "{}")
    return {f"{suite['name']}.{test['name']}": test.get("file", "") for suite in listed.get("testsuites", []) for test in suite["testsuite"]}


class Campaign:
    """All faults of the draw in one build; which tests come by each; and what each test says to each."""

    def __init__(self, faults, gui, asked):
        self.faults = faults  # number: fault
        self.asked = asked    # the test programs that are asked; None: all, and the scripts
        self.single = {n for n, fault in faults.items() if fault[0].startswith(BUILDERS)}  # numbers that cannot stand behind a switch
        self.gui = gui
        self.log = COPY / "build" / "judged.jsonl"
        lines = self.log.read_text(encoding="utf-8").splitlines() if self.log.exists() else []
        self.judged = {(entry["fault"], entry["file"]): entry for entry in map(json.loads, lines)}
        self.lock = threading.Lock()
        self.tests = []
        SCRATCH.mkdir(parents=True, exist_ok=True)

    # --- the build

    def written(self, alone=None):
        """The changed files: all faults behind switches, or for one fault its own file with nothing but it."""
        files = {}
        by_file = {}
        for number, fault in self.faults.items():
            by_file.setdefault(fault[0], []).append((number, *fault[1:]))
        for path, faults in by_file.items():
            text = (ROOT / path).read_text(encoding="utf-8")
            if alone and self.faults[alone][0] == path:
                _, _, begin, end, new = self.faults[alone]
                files[path] = text[:begin] + new + text[end:]
                continue
            chosen = [f for f in faults if f[0] not in self.single]
            if chosen:
                files[path], left_out = fault_sites.switched(text, blanked(text), chosen)
                self.single |= set(left_out)
        return files

    def build(self, goals):
        """Compiles with every fault that bears a switch; what the compiler refuses is taken out and tried alone later."""
        kept = COPY / "build" / "single.json"
        known = json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else {}
        words = {number: describe(fault) for number, fault in self.faults.items()}
        self.single |= {n for n, w in words.items() if w in known}
        while True:
            files = self.written()
            refresh(files)
            if not (BUILD / "build.ninja").exists():
                configured = run(["cmake", "--preset", "dev", f"-DREACHLAB_GUI={'ON' if self.gui else 'OFF'}"], cwd=COPY)
                if configured.returncode != 0:
                    sys.exit(configured.stdout)
            if not goals:  # only so that the build is known
                return
            made = ninja("-k0", *goals)
            if made.returncode == 0:
                break
            blocks = made.stdout.split("FAILED: ")[1:]
            refused = set().union(*(fault_sites.refused(block, files) for block in blocks)) - self.single
            if not refused:
                sys.exit(made.stdout[-6000:])
            print(f"{len(refused)} faults do not bear a switch: {' '.join(map(str, sorted(refused)))}", flush=True)
            self.single |= refused
        kept.write_text(json.dumps(sorted({words[n] for n in self.single} | set(known))), encoding="utf-8")
        self.state = hashlib.sha256(json.dumps(sorted((p, hashlib.sha256(t.encode()).hexdigest()) for p, t in files.items())).encode())
        for folder in SOURCES:
            if folder not in ("tests", "docs", "packaging"):
                for file in sorted((COPY / folder).rglob("*")):
                    if file.suffix in (".h", ".cpp", ".json") and str(file.relative_to(COPY)) not in files:
                        self.state.update(file.read_bytes())
        self.state = self.state.hexdigest()

    # --- the tests

    def comes_by(self, program):
        """Whether a program has any of the files that were changed."""
        return b"seeded_faults" in pathlib.Path(program).read_bytes()

    def leave_out_wide(self, most):
        """Takes the faults in headers of more than so many files out, and gives their numbers."""
        inside = {}  # of each file: what it includes, read from the text, as the first start has no build yet that could be asked
        for folder in [*FOLDERS, "tests"]:
            for file in (ROOT / folder).rglob("*"):
                if file.suffix in (".cpp", ".h") and (self.gui or "gui" not in file.relative_to(ROOT).parts):
                    inside[str(file.relative_to(ROOT))] = set(re.findall(r'^#include "([^"]+)"', file.read_text(encoding="utf-8"), re.M))
        files = {}
        for source in (name for name in inside if name.endswith(".cpp")):
            seen, waiting = set(), {source}
            while waiting:
                seen |= waiting
                waiting = set().union(*(inside.get(name, set()) for name in waiting)) - seen
            for name in seen:
                files[name] = files.get(name, 0) + 1
        wide = [n for n, fault in self.faults.items() if files.get(fault[0], 0) > most]
        for number in wide:
            del self.faults[number]
        return wide

    def baseline(self, program, jobs, longest):
        """The tests of a program (None: those that are scripts), each run once without a fault: how long it takes, what it comes by, and
        whether it passes at all."""
        kept = COPY / "build" / "reached.json"
        known = json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else {}
        if program and not self.comes_by(BUILD / program):
            return []
        tests = [t for t in known_tests() if (t.program == str(BUILD / program) if program else not t.is_gtest)]
        places = places_of(str(BUILD / program)) if program else {}
        behind = "".join(str(hash_of(BUILD / p)) for p in programs_behind(program))
        for test in tests:
            filter_ = next((part.split("=", 1)[1] for part in test.command if part.startswith("--gtest_filter=")), None)
            test.key = f"{test.name} {self.state} {hash_of(BUILD / places.get(filter_, ''))} {behind}"
        before = {name.split(" ")[0]: entry["seconds"] for name, entry in known.items()}
        waiting = sorted((t for t in tests if t.key not in known), key=lambda t: before.get(t.name, 1e9))

        def one(test):
            with tempfile.NamedTemporaryFile(dir=SCRATCH) as seen:
                seen.write(bytes(16384))
                seen.flush()
                code, _, seconds = start(test, 900, seen=seen.name, processor_seconds=math.ceil(min(longest, 3600)))
                marks = pathlib.Path(seen.name).read_bytes()
            with self.lock:
                known[test.key] = {"passes": code == 0, "seconds": seconds, "reached": [n for n, mark in enumerate(marks) if mark]}
                if len(known) % 20 == 0:
                    kept.write_text(json.dumps(known), encoding="utf-8")
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            list(pool.map(one, waiting))
        kept.write_text(json.dumps(known), encoding="utf-8")
        sound = []
        for test in tests:
            entry = known[test.key]
            if entry["passes"]:
                test.seconds, test.reached = entry["seconds"], frozenset(entry["reached"])
                sound.append(test)
        bad = sorted(t.name for t in tests if not known[t.key]["passes"])
        print(f"{program or 'scripts'}: {len(tests)} tests, {sum(t.seconds for t in sound):.0f} s"
              + (f"; left out, fail without a fault: {' '.join(bad)}" if bad else ""), flush=True)
        self.tests += sound
        return sound

    def batches(self, tests, near):
        """Tests shortest first, the nearest before others as long; short ones of a program in one start."""
        ordered = sorted(tests, key=lambda t: (round(math.log2(max(t.seconds, 0.5))) - (4 if t.suite in near else 0), t.program, t.seconds))
        batch = []
        for test in ordered:
            if batch and (test.program != batch[0].program or not test.is_gtest or not batch[0].is_gtest or test.folder != batch[0].folder
                          or sum(t.seconds for t in batch) + test.seconds > 5 or len(batch) == 60):
                yield batch
                batch = []
            batch.append(test)
        if batch:
            yield batch

    def first_failure(self, number, tests, near):
        """Name of a test that fails with the fault, twice, and not without it; None when all pass. Number 0 is a fault that is built in."""
        for batch in self.batches(tests, near):
            for told in self.failures(number, batch):
                return told
        return None

    def failures(self, number, batch):
        usual = sum(t.seconds for t in batch)
        command = None
        if len(batch) > 1:
            filters = ":".join(part.split("=", 1)[1] for t in batch for part in t.command if part.startswith("--gtest_filter="))
            command = [batch[0].program, "--gtest_filter=" + filters, "--gtest_fail_fast"]
        code, out, _ = start(batch[0], max(10, 10 * usual), number, command)
        if code == 0:
            return
        if len(batch) > 1:  # which one, alone
            names = re.findall(r"^\[  FAILED  \] (\w+[./\w]*)", out, re.M) or re.findall(r"^\[ RUN      \] (\S+)", out, re.M)[-1:]
            suspects = [t for t in batch if any("--gtest_filter=" + n in t.command for n in names)] or batch
            for test in suspects + [t for t in batch if t not in suspects]:
                yield from self.failures(number, [test])
            return
        test = batch[0]
        limit = max(10, 10 * test.seconds)
        passes_without = lambda: number == 0 or start(test, limit)[0] == 0
        if code is None:  # twice too: a machine that stood still lets a test be late that ends
            if start(test, limit, number)[0] is None and passes_without():
                yield f"{test.name} (does not end)"
            return
        if start(test, limit, number)[0] != 0 and passes_without():
            yield test.name

    # --- the verdicts

    def known_verdict(self, number):
        fault = self.faults[number]
        known = self.judged.get((describe(fault), hash_of(ROOT / fault[0])))
        return (known["verdict"], known["by"]) if known and known["verdict"] != "alive" else None  # a test may have been added since

    def note(self, number, verdict, by):
        fault = self.faults[number]
        with self.lock, self.log.open("a", encoding="utf-8") as log:
            log.write(json.dumps({"fault": describe(fault), "file": hash_of(ROOT / fault[0]), "verdict": verdict, "by": by}) + "\n")

    def judge(self, jobs, longest, skip):
        """The faults behind switches, program by program, the nearest first: a program that no living fault needs is not even built."""
        verdicts = {n: known for n in self.faults if n not in skip and (known := self.known_verdict(n))}
        living = {n for n in self.faults if n not in verdicts and n not in skip}
        come_by = dict.fromkeys(living, 0)
        self.build([])
        built = (BUILD / "build.ninja").read_text(encoding="utf-8")
        unbuilt = {n for n in living if self.faults[n][0].endswith(".cpp") and self.faults[n][0] not in built}
        verdicts |= {n: ("not built", None) for n in unbuilt}
        living -= unbuilt
        waiting = [p for p in programs(targets()) if self.asked is None or p.split("test_")[-1] in self.asked]
        while living:  # those that are tried alone need to know the tests of every program, too
            if waiting is None or not waiting and self.asked is not None:
                break
            near = {p: sum(p.endswith("test_" + part) for n in living for part in pathlib.Path(self.faults[n][0]).parts[:-1]) for p in waiting}
            program = max(waiting, key=lambda p: (near[p], not programs_behind(p))) if waiting else None
            self.build([program, *programs_behind(program)] if program else programs_behind(None))
            tests = self.baseline(program, jobs, longest)

            def tell(number):
                own = [t for t in tests if number in t.reached]
                by = self.first_failure(number, own, suites_near(self.faults[number][0]))
                come_by[number] += len(own)
                if by:
                    verdicts[number] = ("noticed", by)
                    self.note(number, "noticed", by)
                    print(f"({number}) noticed by {by}: {describe(self.faults[number])}", flush=True)
            with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
                list(pool.map(tell, sorted(living - self.single)))
            living -= set(verdicts)
            print(f"after {program or 'scripts'}: {sum(v[0] == 'noticed' for v in verdicts.values())} noticed, {len(living - self.single)} live", flush=True)
            waiting = [p for p in waiting if p != program] if program else None
        for number in sorted(living - self.single):
            verdicts[number] = ("alive", f"{come_by[number]} tests come by it" if come_by[number] else "no test comes by it")
            self.note(number, *verdicts[number])
        if self.asked is not None:
            verdicts |= {n: ("not tried", None) for n in living & self.single}
        return verdicts

    def judge_alone(self, number):
        """A fault that the compiler must see: built by itself, tried by the tests of the programs that it changes."""
        if known := self.known_verdict(number):
            return known
        path = self.faults[number][0]
        plain = {path: (ROOT / path).read_text(encoding="utf-8")}
        others = {p: t for p, t in self.written().items() if p != path}
        wanted = objects_of(path)
        refresh(others | plain)
        if ninja(*wanted).returncode != 0:
            sys.exit(f"{path} does not compile without a fault")
        before = {g: hash_of(BUILD / g) for g in wanted}
        refresh(self.written(alone=number))
        verdict, by = "alive", None
        if ninja(*wanted).returncode != 0:
            verdict = "does not compile"
        elif wanted and all(hash_of(BUILD / g) == h for g, h in before.items()):
            verdict = "same"
        else:
            reached = {n for n, f in self.faults.items() if f[0] == path}
            near = suites_near(path)
            close = [t for t in self.tests if t.is_gtest and (t.suite in near or t.reached & reached)]
            for program in sorted({t.program for t in close}, key=lambda p: -sum(t.program == p and t.suite in near for t in close)):
                goal = str(pathlib.Path(program).relative_to(BUILD))
                if ninja("-k0", goal, *programs_behind(goal)).returncode != 0:
                    by = "the build"
                    break
                if by := self.first_failure(0, [t for t in close if t.program == program], near):
                    break
            else:
                built = ninja("-k0").returncode == 0
                by = self.first_failure(0, [t for t in self.tests if t not in close], near) if built else "the build"
            if by:
                verdict = "noticed"
        self.note(number, verdict, by)
        return verdict, by


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", help="folders or files; default: all below the window")
    parser.add_argument("--seed", type=int, action="append", help="[1]; several draws share one build")
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--least", type=float, default=0.95, help="share that must be noticed [0.95]")
    parser.add_argument("--only", type=int, help="the N-th fault of the draw alone")
    parser.add_argument("--list", action="store_true", help="the faults, without putting them in")
    parser.add_argument("--longest", type=float, default=1e9, help="leave out tests that need more seconds of processor time than this")
    parser.add_argument("--programs", help="test programs that are asked, as in trial,cli: no others, no scripts, nothing that must be built alone")
    parser.add_argument("--widest", type=int, help="leave out faults in headers that more files than this include (to have an answer sooner)")
    parser.add_argument("--gui", action="store_true", help="the window's tests too")
    parser.add_argument("--check", action="store_true", help="how faults are written behind switches, on examples")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    wishes = parser.parse_args()
    signal.signal(signal.SIGTERM, end_all)
    global JOBS
    JOBS = [f"-j{wishes.jobs}"]
    if wishes.check:
        return fault_check.check(faults_of, blanked)
    folders = wishes.folders or [f for f in FOLDERS if f != "gui" and (ROOT / f).is_dir()]
    seeds = wishes.seed or [1]
    if wishes.list:
        for seed in seeds:
            for _, fault in zip(range(wishes.count), draw(folders, seed)):
                print(describe(fault))
        return 0

    # More than are asked for, as some will not compile or change nothing.
    most = wishes.only or wishes.count + wishes.count // 5 + 5
    draws = {seed: list(itertools.islice(draw(folders, seed), most))[wishes.only - 1 if wishes.only else 0:] for seed in seeds}
    numbers = {}  # of a fault: the same in every draw that has it
    for drawn in draws.values():
        for fault in drawn:
            numbers.setdefault(fault, len(numbers) + 1)
    equivalents = known_equivalents()
    verdicts = {n: ("listed", None) for fault, n in numbers.items() if re.sub(r":\d+: ", ": ", describe(fault), count=1) in equivalents}
    campaign = Campaign({n: fault for fault, n in numbers.items()}, wishes.gui or "gui" in folders,
                        wishes.programs and wishes.programs.split(","))
    if wishes.widest:
        verdicts |= {n: ("wide", None) for n in campaign.leave_out_wide(wishes.widest)}
    verdicts |= campaign.judge(wishes.jobs, wishes.longest, verdicts)
    worst = 1.0
    for seed, drawn in draws.items():
        worst = min(worst, report(seed, [(numbers[fault], fault) for fault in drawn], wishes.count, verdicts, campaign))
    return 0 if worst >= wishes.least else 1


LEFT_OUT = {"wide": "in a header of many files", "not tried": "to be built alone", "not built": "in a file that this build leaves out"}


def report(seed, drawn, count, verdicts, campaign):
    """The verdicts in the order of the draw, until there are enough; the share that was noticed."""
    noticed, alive, nothing, left = 0, [], 0, []
    for place, (number, fault) in enumerate(drawn, 1):
        if noticed + len(alive) == count:
            break
        if number not in verdicts:
            verdicts[number] = campaign.judge_alone(number)
        verdict, by = verdicts[number]
        words = describe(fault)
        if verdict == "noticed":
            noticed += 1
            print(f"{place} noticed by {by}: {words}", flush=True)
        elif verdict in LEFT_OUT:
            left.append(f"{LEFT_OUT[verdict]}: {words}")
        elif verdict in ("listed", "same"):
            nothing += 1
            print(f"{place} changes nothing ({'listed' if verdict == 'listed' else 'same object'}) {words}", flush=True)
        elif verdict == "alive":
            alive.append(words)
            print(f"{place} ALIVE ({by}) {words}", flush=True)
    judged = noticed + len(alive)
    share = noticed / judged if judged else 1.0
    print(f"seed {seed}: {noticed} of {judged} noticed ({100 * share:.1f} %), {nothing} change nothing")
    for words in alive:
        print(f"ALIVE {words}")
    for words in left:
        print(f"not tried, {words}")
    return share


if __name__ == "__main__":
    sys.exit(main())
