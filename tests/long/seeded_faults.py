#!/usr/bin/env python3
"""Puts single faults into the sources, one at a time, and names those that no test notices.

    tests/long/seeded_faults.py --seed 7 --count 20 sim/trial sim/record
    tests/long/seeded_faults.py --seed 7 --count 300                      # everything but the window
    tests/long/seeded_faults.py --seed 7 --count 20 --only 13 sim/trial   # the 13th of the same draw again

A fault is a comparison, a sign (or * against /), a constant, or a statement left out. The same seed, folders and sources give the same
faults. It works on a copy of the sources in build/faults (made anew from the working tree at each start, its objects kept), builds the test
programs that the changed file goes into, the nearest first, and runs them until one fails. A fault that does not compile is drawn again;
one whose object file is bit for bit the old one changes nothing and is not counted; nor is one listed in equivalent_faults.txt with the
reason why it changes nothing that anybody could see. Exit 1 when less than --least of the rest was noticed.
"""
import argparse
import hashlib
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


def programs(gui):
    listed = run(["ninja", "-C", str(BUILD), "-t", "targets", "all"]).stdout
    names = sorted(set(re.findall(r"^(tests/(?:\w+/)?test_\w+): ", listed, re.M)))
    return [n for n in names if gui or "gui" not in n]


def nearest_first(path, names):
    parts = pathlib.Path(path).parts[:-1]
    return sorted(names, key=lambda n: -max([i + 1 for i, p in enumerate(parts) if n.endswith("test_" + p)], default=0))


def object_of(path):
    """Bytes of the object file of a .cpp; None for a header."""
    for file in BUILD.rglob(pathlib.Path(path).name + ".o"):
        if str(file).endswith(f"{pathlib.Path(path).parent.name}.dir/{pathlib.Path(path).name}.o") or pathlib.Path(path).parent.name in str(file):
            return file
    return None


def hash_of(file):
    return hashlib.sha256(file.read_bytes()).hexdigest() if file and file.exists() else None


def first_failure(program, known_bad, seconds):
    """Name of a test that fails, or None. The tests of a program are shared out over the processors."""
    shards = max(1, int(JOBS[0][2:]))
    skip = "-" + ":".join(known_bad) if known_bad else "*"
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
    tests = programs(wishes.gui)
    built = ninja("cli/reach", *tests)
    if built.returncode != 0:
        sys.exit(built.stdout[-4000:])
    baseline, bad = {}, {}
    for program in tests:  # what fails without a fault says nothing
        begin = time.monotonic()
        out = run([str(BUILD / program), "--gtest_brief=1"], 3600, cwd=BUILD / "tests")
        baseline[program] = time.monotonic() - begin
        bad[program] = sorted(set(re.findall(r"^\[  FAILED  \] (\w+\.[/\w]+)", out.stdout, re.M)))
        if bad[program]:
            print(f"left out, fails without a fault: {' '.join(bad[program])}", flush=True)

    equivalents = known_equivalents()
    noticed, alive, nothing, number, drawn = 0, [], 0, 0, 0
    for fault in faults:
        if number == wishes.count or (wishes.only and drawn == wishes.only):
            break
        drawn += 1
        if wishes.only and drawn != wishes.only:
            continue
        path, kind, begin, end, new = fault
        words = describe(fault)
        if re.sub(r":\d+: ", ": ", words, count=1) in equivalents:
            nothing += 1
            print(f"{drawn} changes nothing (listed) {words}", flush=True)
            continue
        file = COPY / path
        text = file.read_text(encoding="utf-8")
        object_file = object_of(path) if path.endswith(".cpp") else None
        before = hash_of(object_file)
        try:
            file.write_text(text[:begin] + new + text[end:], encoding="utf-8")
            told = None
            if object_file:
                if ninja(str(object_file.relative_to(BUILD))).returncode != 0:
                    continue
                if hash_of(object_file) == before:
                    nothing += 1
                    print(f"{drawn} changes nothing (same object) {words}", flush=True)
                    continue
            compiles = True
            for program in nearest_first(path, tests):
                goals = [program] + (["cli/reach"] if program.endswith("test_cli") else [])
                made = ninja(*goals)
                if made.returncode != 0:
                    compiles = False
                    break
                if "no work to do" in made.stdout:
                    continue
                told = first_failure(program, bad[program], 30 + 5 * baseline[program])
                if told:
                    break
            if not compiles:
                continue
            number += 1
            if told:
                noticed += 1
                print(f"{drawn} noticed by {told}: {words}", flush=True)
            else:
                alive.append(words)
                print(f"{drawn} ALIVE {words}", flush=True)
        finally:
            file.write_text(text, encoding="utf-8")
    ninja("cli/reach", *tests)
    share = noticed / number if number else 1.0
    print(f"seed {wishes.seed}: {noticed} of {number} noticed ({100 * share:.1f} %), {nothing} change nothing")
    for words in alive:
        print(f"ALIVE {words}")
    return 0 if share >= wishes.least else 1


if __name__ == "__main__":
    sys.exit(main())
