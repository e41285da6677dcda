#!/usr/bin/env python3
"""Puts single faults into the sources, one at a time, and names those that no test notices.

    tests/long/seeded_faults.py --seed 7 --count 20 sim/trial sim/record
    tests/long/seeded_faults.py --seed 7 --count 300                      # everything but the window
    tests/long/seeded_faults.py --seed 7 --count 20 --only 13 sim/trial   # the 13th of the same draw again

A fault is a comparison, a sign (or * against /), a constant, or a statement left out. The same seed, folders and sources give the same
faults. It works on a copy of the sources in build/faults (made anew from the working tree at each start, its objects kept), builds the test
programs that the changed file goes into, the nearest first, and runs those whose bytes the fault has changed until one fails: the tests of
the file's own test file first, then all of the program. Which tests fail without a fault is found out when a program is first needed. A
fault that does not compile is drawn again; one whose object file is bit for bit the old one changes nothing and is not counted; nor is
one listed in equivalent_faults.txt with the reason why it changes nothing that anybody could see. What was noticed is noted in
build/faults/build/judged.jsonl and not tried again by a later start, as long as the file with the fault is the same. Exit 1 when less than
--least of the rest was noticed.
"""
import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["base", "constraints", "sim", "devices", "network", "cli", "gui"]
SOURCES = FOLDERS + ["tests", "resources", "cmake", "packaging", "docs"]
COPY = ROOT / "build" / "faults"
BUILD = COPY / "build" / "dev"

COMPARISONS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"}
SIGNS = {"+": "-", "-": "+", "+=": "-=", "-=": "+=", "*": "/", "/": "*", "*=": "/=", "/=": "*="}
OPERATOR = re.compile(r"(?<= )(<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|<|>|\+|-|\*|/)(?= )")
UNARY = re.compile(r"(?:(?<=[(\[])|(?<=[,=?:] )|(?<=return ))[-!](?=[\w(])")
CONSTANT = re.compile(r"(?<![\w.'])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+|\d+|true|false)(?![\w.'])")
STATEMENT = re.compile(r"^(?:(?:if|for|while) \(.*\) )?(?:else )?((?:return|break|continue)|[\w:.\->\[\]()*]+ (?:[-+*/|&]?=) .*|(?:\+\+|--)[\w.\->]+|[\w:.\->]+\(.*\));$")


def blanked(text):
    """The text with comments, strings and preprocessor lines as spaces: places stay what they were."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|^[ \t]*#[^\n]*', re.S | re.M)
    return pattern.sub(lambda m: re.sub(r"[^\n]", " ", m.group()), text)


def faults_of(path, text):
    """Every single fault of one file: (kind, begin, end, replacement)."""
    bare = blanked(text)
    found = []
    for m in OPERATOR.finditer(bare):
        sign = m.group()
        line = bare[bare.rfind("\n", 0, m.start()) + 1:m.start()]
        if sign in COMPARISONS and not ("template" in line):
            found.append(("comparison", m.start(), m.end(), COMPARISONS[sign]))
        elif sign in SIGNS:
            found.append(("sign", m.start(), m.end(), SIGNS[sign]))
    for m in UNARY.finditer(bare):
        found.append(("sign" if m.group() == "-" else "comparison", m.start(), m.end(), ""))
    for m in CONSTANT.finditer(bare):
        number = m.group()
        if number in ("true", "false"):
            new = "false" if number == "true" else "true"
        elif number.isdigit():
            new = str(int(number) + 1)
        else:
            new = repr(float(number) * 1.5) if float(number) else "1.0"
        found.append(("constant", m.start(), m.end(), new))
    at = 0
    for line in bare.split("\n"):
        begin = at + len(line) - len(line.lstrip())
        at += len(line) + 1
        m = STATEMENT.match(line.strip())
        if m and not m.group(1).startswith(("static_assert", "using", "namespace")):
            found.append(("statement", begin + m.start(1), begin + len(line.strip()), ";"))
    return [(path, *fault) for fault in found]


def draw(folders, seed):
    """All faults of the folders in an order that the seed gives, the four kinds in turn."""
    kinds = {"comparison": [], "sign": [], "constant": [], "statement": []}
    for folder in folders:
        place = ROOT / folder
        files = [place] if place.is_file() else sorted(p for p in place.rglob("*") if p.suffix in (".cpp", ".h"))
        for file in files:
            name = str(file.relative_to(ROOT))
            for fault in faults_of(name, file.read_text(encoding="utf-8")):
                kinds[fault[1]].append(fault)
    chance = random.Random(seed)
    for faults in kinds.values():
        chance.shuffle(faults)
    queues = [q for q in kinds.values()]
    while any(queues):
        for queue in queues:
            if queue:
                yield queue.pop()


def describe(fault):
    path, kind, begin, end, new = fault
    text = (ROOT / path).read_text(encoding="utf-8")
    line = text.count("\n", 0, begin) + 1
    whole = text.split("\n")[line - 1].strip()
    old = " ".join(text[begin:end].split())
    return f"{path}:{line}: {kind}: {old} -> {new or 'nothing'} in: {whole}"


def known_equivalents():
    """Lines `FILE: kind: old -> new in: LINE | why`; without line numbers, so that they outlive edits elsewhere."""
    listed = pathlib.Path(__file__).with_name("equivalent_faults.txt")
    lines = listed.read_text(encoding="utf-8").splitlines() if listed.exists() else []
    return {line.split(" | ")[0] for line in lines if " | " in line and not line.startswith("#")}


def run(command, seconds=None, **options):
    try:
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=seconds, text=True, errors="replace", **options)
    except subprocess.TimeoutExpired as late:
        return subprocess.CompletedProcess(command, 124, f"longer than {late.timeout:.0f} s", "")


def ninja(*targets):
    return run(["ninja", "-C", str(BUILD), *JOBS, *targets])


def refresh():
    """The copy becomes what the working tree is; files that did not change keep their times, so that little is built again."""
    COPY.mkdir(parents=True, exist_ok=True)
    listed = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard"], stdout=subprocess.PIPE, text=True)
    names = set(listed.stdout.splitlines())
    if listed.returncode != 0:
        names = {str(p.relative_to(ROOT)) for s in SOURCES for p in (ROOT / s).rglob("*") if p.is_file()} | {"CMakeLists.txt", "CMakePresets.json"}
    for name in sorted(names):
        old, new = ROOT / name, COPY / name
        if not old.is_file():
            continue
        if new.is_file() and new.read_bytes() == old.read_bytes():
            continue
        new.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(old, new)
        shutil.copymode(old, new)
    for file in COPY.rglob("*"):
        name = file.relative_to(COPY)
        if file.is_file() and name.parts[0] != "build" and str(name) not in names:
            file.unlink()


def programs(goals, gui):
    names = sorted(goal for goal in goals if re.fullmatch(r"tests/(?:\w+/)?test_\w+", goal))
    return [n for n in names if gui or "gui" not in n]


def nearest_first(path, names):
    parts = pathlib.Path(path).parts[:-1]
    return sorted(names, key=lambda n: -max([i + 1 for i, p in enumerate(parts) if n.endswith("test_" + p)], default=0))


def targets():
    """Every goal of the build, by its path in the build folder."""
    return [line.split(": ")[0] for line in run(["ninja", "-C", str(BUILD), "-t", "targets", "all"]).stdout.splitlines()]


def object_of(path, goals):
    """The object file of a .cpp; None for a header."""
    for goal in goals:
        if re.sub(r"CMakeFiles/[^/]+\.dir/", "", goal) == path + ".o":
            return BUILD / goal
    return None


def hash_of(file):
    return hashlib.sha256(file.read_bytes()).hexdigest() if file and file.exists() else None


def suites_near(path):
    """Suites of the test file that is named after the changed one: those look at it most closely."""
    stem = pathlib.Path(path).stem
    suites = set()
    for file in (COPY / "tests").rglob("*.cpp"):
        if file.stem in (stem + "_test", stem.rstrip("s") + "_test", stem + "s_test"):
            suites |= set(re.findall(r"^TEST(?:_F|_P)?\((\w+),", file.read_text(encoding="utf-8"), re.M))
    return sorted(suites)


def programs_behind(program):
    """What a test program starts as well."""
    return ["cli/reach", "tests/reach_counting"] if program.endswith("test_cli") else []


def bytes_of(program):
    """A hash of the program with all that it starts."""
    return hashlib.sha256("".join(str(hash_of(BUILD / p)) for p in [program, *programs_behind(program)]).encode()).hexdigest()


def first_failure(program, known_bad, seconds, near=(), only=None):
    """Name of a test that fails, or None. The tests of a program are shared out over the processors."""
    shards = max(1, int(JOBS[0][2:]))
    skip = only or ":".join(f"{suite}.*:*/{suite}.*" for suite in near) or "*"
    if known_bad:
        skip += "-" + ":".join(known_bad)
    running = []
    for shard in range(shards):
        environment = dict(os.environ, GTEST_TOTAL_SHARDS=str(shards), GTEST_SHARD_INDEX=str(shard), QT_QPA_PLATFORM="offscreen")
        running.append(subprocess.Popen([str(BUILD / program), "--gtest_fail_fast", "--gtest_filter=" + skip], cwd=BUILD / "tests",
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", env=environment,
                                        start_new_session=True))
    failure, end = None, time.monotonic() + seconds
    for process in running:
        try:
            out, _ = process.communicate(timeout=max(1, end - time.monotonic()))
            if process.returncode != 0 and failure is None:
                names = re.findall(r"^\[  FAILED  \] (\w+[./\w]*)", out, re.M)
                last = re.findall(r"^\[ RUN      \] (\S+)", out, re.M)
                failure = names[0] if names else (last[-1] if last else "?") + " (died)"
        except subprocess.TimeoutExpired:
            failure = failure or "does not end"
    for process in running:
        if process.poll() is None:
            os.killpg(process.pid, 9)
            process.wait()
    return failure


class Campaign:
    """Puts faults in, one at a time, and remembers what came of each."""

    def __init__(self, gui):
        self.goals = targets()
        self.tests = programs(self.goals, gui)
        self.sound = {}  # program: (bytes, tests that fail without a fault, seconds)
        self.log = COPY / "build" / "judged.jsonl"
        lines = self.log.read_text(encoding="utf-8").splitlines() if self.log.exists() else []
        self.judged = {(entry["fault"], entry["file"]): entry for entry in map(json.loads, lines)}

    def judge(self, fault, words):
        path, _, begin, end, new = fault
        known = self.judged.get((words, hash_of(ROOT / path)))
        if known and known["verdict"] != "alive":  # a test may have been added since
            return known["verdict"], known["by"]
        file = COPY / path
        text = file.read_text(encoding="utf-8")
        faulty = text[:begin] + new + text[end:]
        try:
            verdict, by = self.put_in(path, file, text, faulty)
        finally:
            file.write_text(text, encoding="utf-8")
        with self.log.open("a", encoding="utf-8") as log:
            log.write(json.dumps({"fault": words, "file": hash_of(ROOT / path), "verdict": verdict, "by": by}) + "\n")
        return verdict, by

    def put_in(self, path, file, text, faulty):
        object_file = object_of(path, self.goals) if path.endswith(".cpp") else None
        if object_file:
            goal = str(object_file.relative_to(BUILD))
            if ninja(goal).returncode != 0:
                sys.exit(f"{path} does not compile without a fault")
            before = hash_of(object_file)
            file.write_text(faulty, encoding="utf-8")
            if ninja(goal).returncode != 0:
                return "does not compile", None
            if hash_of(object_file) == before:
                return "same", None
        near = suites_near(path)
        for program in self.candidates(path, object_file):
            if program not in self.sound:
                file.write_text(text, encoding="utf-8")
                self.build(program)
                self.sound[program] = (bytes_of(program), *self.baseline(program))
            file.write_text(faulty, encoding="utf-8")
            if self.build(program, may_fail=True) != 0:
                return "does not compile", None
            sound, bad, seconds = self.sound[program]
            if bytes_of(program) == sound:
                continue
            told = (near and self.fails_twice(program, bad, seconds, near)) or self.fails_twice(program, bad, seconds)
            if told:
                return "noticed", told
        return "alive", None

    def fails_twice(self, program, bad, seconds, near=()):
        """Name of a test that fails each time: on a busy machine one may fail for another reason than the fault."""
        bad = list(bad)
        while told := first_failure(program, bad, 30 + 5 * seconds, near):
            name = told.split(" ")[0]
            if "." not in name or first_failure(program, [], 30 + 5 * seconds, only=name):
                return told
            bad.append(name)
        return None

    def candidates(self, path, object_file):
        """Programs that the file goes into, the nearest first; a header may go into any."""
        ordered = nearest_first(path, self.tests)
        if not object_file:
            return ordered
        goal = str(object_file.relative_to(BUILD))
        return [p for p in ordered if goal in run(["ninja", "-C", str(BUILD), "-t", "inputs", p]).stdout]

    def build(self, program, may_fail=False):
        made = ninja(program, *programs_behind(program))
        if made.returncode != 0 and not may_fail:
            sys.exit(made.stdout[-4000:])
        return made.returncode

    def baseline(self, program):
        """Tests that fail without a fault say nothing, and how long all of them take. Kept for as long as the program is the same."""
        kept = COPY / "build" / "sound.json"
        known = json.loads(kept.read_text(encoding="utf-8")) if kept.exists() else {}
        key = bytes_of(program)
        if key not in known:
            begin = time.monotonic()
            out = run([str(BUILD / program), "--gtest_brief=1"], 3600, cwd=BUILD / "tests", env=dict(os.environ, QT_QPA_PLATFORM="offscreen"))
            bad = sorted(set(re.findall(r"^\[  FAILED  \] (\w+\.[/\w]+)", out.stdout, re.M)))
            known[key] = [bad, time.monotonic() - begin]
            kept.write_text(json.dumps(known), encoding="utf-8")
            if bad:
                print(f"left out, fails without a fault: {' '.join(bad)}", flush=True)
        return known[key]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", help="folders or files; default: all below the window")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--least", type=float, default=0.95, help="share that must be noticed [0.95]")
    parser.add_argument("--only", type=int, help="the N-th fault of the draw alone")
    parser.add_argument("--list", action="store_true", help="the faults, without putting them in")
    parser.add_argument("--gui", action="store_true", help="the window's tests too")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    wishes = parser.parse_args()
    global JOBS
    JOBS = [f"-j{wishes.jobs}"]
    folders = wishes.folders or [f for f in FOLDERS if f != "gui" and (ROOT / f).is_dir()]
    faults = draw(folders, wishes.seed)
    if wishes.list:
        for _, fault in zip(range(wishes.count), faults):
            print(describe(fault))
        return 0

    refresh()
    configured = run(["cmake", "--preset", "dev", f"-DREACHLAB_GUI={'ON' if wishes.gui else 'OFF'}"], cwd=COPY)
    if configured.returncode != 0:
        sys.exit(configured.stdout)
    campaign = Campaign(wishes.gui)
    equivalents = known_equivalents()
    noticed, alive, nothing, number, drawn = 0, [], 0, 0, 0
    for fault in faults:
        if number == wishes.count or (wishes.only and drawn == wishes.only):
            break
        drawn += 1
        if wishes.only and drawn != wishes.only:
            continue
        words = describe(fault)
        if re.sub(r":\d+: ", ": ", words, count=1) in equivalents:
            nothing += 1
            print(f"{drawn} changes nothing (listed) {words}", flush=True)
            continue
        verdict, by = campaign.judge(fault, words)
        if verdict == "does not compile":
            continue
        if verdict == "same":
            nothing += 1
            print(f"{drawn} changes nothing (same object) {words}", flush=True)
            continue
        number += 1
        if verdict == "noticed":
            noticed += 1
            print(f"{drawn} noticed by {by}: {words}", flush=True)
        else:
            alive.append(words)
            print(f"{drawn} ALIVE {words}", flush=True)
    share = noticed / number if number else 1.0
    print(f"seed {wishes.seed}: {noticed} of {number} noticed ({100 * share:.1f} %), {nothing} change nothing")
    for words in alive:
        print(f"ALIVE {words}")
    return 0 if share >= wishes.least else 1


if __name__ == "__main__":
    sys.exit(main())
