#!/usr/bin/env python3
"""The walks of docs/call-traces.md: which files a reader enters, in order, from one end of a job to the other.

  tests/house/walks.py BUILD           records the walks of the programs in BUILD under gdb and rewrites the page's lists and its figure
  tests/house/walks.py BUILD --show    prints them and changes nothing
  tests/house/walks.py --figure        draws docs/images/walks.svg anew from the page's lists and today's includes
  tests/house/walks.py --check         exits 1 unless the page's lists keep the limits below and name files that are there

A walk is a recorded call trace: the functions of the project that one thread enters between a function's entry and its return, in the order of
their first entry. Of a room that the walk only asks (it calls and gets an answer) the door counts, the first file entered, and not what that room
calls in turn; a header and its source are one file. Inlined functions leave no trace.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE, FIGURE = ROOT / "docs/call-traces.md", ROOT / "docs/images/walks.svg"
sys.path.insert(0, str(Path(__file__).parent))
import layers  # noqa: E402

TOPS = "base|constraints|sim|analysis|devices|network|bench|gui|cli"
MAX_RETURNS = 2
RUN = "run chain-moderate --device simulated --trials 1 --seed 1 --fast --data {tmp}/"
TYPED = """{ "schema_version": 1, "constraint": { "curve": ["0", "a*cos(phi)", "b*sin(phi)"], "shape": { "a": 0.1, "b": 0.06 } },
  "object": { "kind": "chain", "masses_kg": [0.6, 0.6], "stiffness_n_per_m": [600] },
  "coupling": { "stiffness_n_per_m": 600, "damping_n_s_per_m": 5 },
  "task": { "start": [0.3], "target": [3.4], "duration_s": 1.35, "tolerance": { "position_m": 0.012, "velocity_m_per_s": 0.012, "time_s": 0.5 } } }
"""
# name: parts (program, arguments, segments), rooms that are only asked, most files. A segment is a function and which of its entries.
WALKS = {
    "hand → tick → force": ([("cli/reach", RUN + "new", ["reachlab::haptics::LoopCore::tick(@1500"])], [], 25),
    "formula → dynamics → picture": (
        [("cli/reach", "simulate {tmp}/typed.json --until 0.01 --hand min-jerk --out {tmp}/out.csv",
          ["reachlab::constraints::makeConstraint(@1", "reachlab::dynamics::compileScene(@1"]),
         ("tests/gui/test_gui", "--gtest_filter=ScenePlan.*", ["reachlab::gui::scene::planScene(@1"])], ["base"], 45),
    "trial → log → BIDS → table": (
        [("cli/reach", RUN + "new", ["reachlab::record::Recorder::onTick(@1500", "reachlab::record::writeBids(@1"]),
         ("cli/reach", "analyze {tmp}/recorded --out {tmp}/analysis",
          ["reachlab::analysis::readDataset(@1", "reachlab::analysis::writeTables(@1"])],
        ["base", "constraints", "sim/experiment", "sim/predict", "sim/trial", "cli"], 45),
    "experiment file → running object": (
        [("cli/reach", RUN + "new", ["reachlab::experiment::openExperiment(@1", "reachlab::dynamics::compileScene(@1", "reachlab::haptics::TickEngine::TickEngine(@1"])],
        ["base", "constraints"], 20),
    "click → haptic thread": (
        [("tests/gui/test_gui", "--gtest_filter=Day.EpsilonOfTheRunIsTheAnalysissAndFailedTrialsStayOut",
          ["reachlab::gui::app::MainWindow::nextTrial(@2", "reachlab::haptics::LoopCore::tick(@1>reachlab::haptics::TickEngine::step("])],
        ["base", "devices", "sim/record"], 12),
}


def functions_of(program):
    """`address file function` of the project's own functions that were not inlined everywhere."""
    symbols = subprocess.run(["nm", "--defined-only", program], capture_output=True, text=True, check=True).stdout
    addresses = sorted({line.split()[0] for line in symbols.splitlines() if line.split()[1] in "tTwW"})
    told = subprocess.run(["addr2line", "-f", "-C", "-e", program], input="\n".join(addresses), capture_output=True, text=True, check=True)
    lines = told.stdout.splitlines()
    for address, name, place in zip(addresses, lines[0::2], lines[1::2]):
        file = re.search(rf"(?:^|/)((?:{TOPS})/[^:]+\.(?:cpp|h)):", place)
        if name == "main" or (file and "/tests/" not in place and (ROOT / file.group(1)).exists()):
            yield f"{address} {file.group(1) if file else 'main'} {name}"


def record(build, walk):
    """`file function` of every first entry, in order."""
    trace = []
    with tempfile.TemporaryDirectory() as tmp:
        Path(tmp, "typed.json").write_text(TYPED)
        if any("recorded" in part[1] for part in WALKS[walk][0]):
            recorded = [str(build / "cli/reach")] + (RUN + "recorded").format(tmp=tmp).split()
            subprocess.run(recorded, check=True, capture_output=True, cwd=ROOT)
        for program, arguments, segments in WALKS[walk][0]:
            functions, out = Path(tmp, "functions"), Path(tmp, "out")
            functions.write_text("\n".join(functions_of(str(build / program))) + "\n")
            environment = dict(os.environ, WALK_FUNCTIONS=str(functions), WALK_OUT=str(out), WALK_SEGMENTS=";".join(segments), WALK_ASKED=";".join(WALKS[walk][1]))
            command = ["gdb", "-q", "-nx", "-batch", "-x", str(Path(__file__).parent / "walk_trace.py"), "--args", str(build / program)]
            command += arguments.format(tmp=tmp).split()
            if "gui" in program:
                command = [str(ROOT / "tests/gui/under_xvfb")] + command
            run = subprocess.run(command, env=environment, cwd=ROOT, capture_output=True, text=True, stdin=subprocess.DEVNULL)
            text = out.read_text() if out.exists() else ""
            if text.count("\n\n") < len(segments):
                sys.exit(f"{walk}: the trace ended early\n{run.stdout[-2000:]}\n{run.stderr[-3000:]}")
            trace += [line.split(" ", 1) for line in text.splitlines() if line]
    return trace


def room_of(file):
    parts = Path(file).parts
    return "/".join(parts[:2]) if parts[0] in ("sim", "analysis", "gui") and len(parts) > 2 else parts[0]


def files_of(trace, asked):
    """Each file once, in the order of entry, a header with its source; of a room that is only asked the first."""
    files, seen, doors = [], set(), set()
    for file, _ in trace:
        stem, room = str(Path(file).with_suffix("")), room_of(file)
        if stem in seen or (room in asked and room in doors):
            continue
        seen.add(stem)
        doors.add(room)
        files.append(file)
    return files


def rooms_along(files, asked=()):
    rooms = [room_of(f) for f in files if room_of(f) not in asked]
    return [r for i, r in enumerate(rooms) if i == 0 or rooms[i - 1] != r]


def returns(rooms):
    """How often the walk comes back to a room that it has left, for the worst room. To ask is not to leave."""
    return max(rooms.count(r) - 1 for r in rooms)


def describe(walk, files):
    asked = WALKS[walk][1]
    rooms = rooms_along(files, asked)
    text = f"{len(files)} files" + (f" (only asked: {', '.join(asked)})" if asked else "") + ":\n"
    previous = None
    for file in files:
        room = room_of(file)
        text += ("" if previous is None else ", " if room == previous else "\n") + (f"- {room}: " if room != previous else "") + f"`{file}`"
        previous = room
    return text + f"\n\nReturns to an earlier module: {returns(rooms)} at most.\n"


def page_walks():
    page = PAGE.read_text()
    found = {}
    for walk in WALKS:
        part = re.search(rf"<!-- walk: {re.escape(walk)} -->\n(.*?)<!-- end -->", page, re.S)
        if part:
            found[walk] = re.findall(r"`((?:%s)/[^`]+)`" % TOPS, part.group(1))
    return found


def check(walks):
    faults = [f"docs/call-traces.md: no walk {w}" for w in WALKS if not walks.get(w)]
    for walk, files in walks.items():
        if not files:
            continue
        faults += [f"{walk}: {f} is not there" for f in files if not (ROOT / f).exists()]
        if len(files) > WALKS[walk][2]:
            faults.append(f"{walk}: {len(files)} files; allowed: {WALKS[walk][2]}")
        if returns(rooms_along(files, WALKS[walk][1])) > MAX_RETURNS:
            faults.append(f"{walk}: goes back to a room {returns(rooms_along(files, WALKS[walk][1]))} times; allowed: {MAX_RETURNS}")
    return faults


def room_arrows():
    arrows = {}
    for file in layers.sources():
        arrows.setdefault(room_of(str(file)), set())
        for other in layers.included(file):
            other = room_of(str(other / "x.h"))
            if other != room_of(str(file)):
                arrows[room_of(str(file))].add(other)
    return arrows


def depth_of(arrows):
    depth = {}

    def visit(room, above=()):
        if room not in depth:
            depth[room] = 1 + max([visit(o, above + (room,)) for o in arrows.get(room, ()) if o not in above], default=-1)
        return depth[room]

    for room in sorted(arrows):
        visit(room)
    return depth


def draw(walks):
    """Rooms in rows, each above what it includes; grey lines are includes, coloured ones the walks."""
    arrows = room_arrows()
    depth = depth_of(arrows)
    rows = {}
    for room, row in sorted(depth.items()):
        rows.setdefault(row, []).append(room)
    width, box, step = 1080, 118, 62
    height = step * (max(rows) + 1) + 60 + 20 * len(walks)
    place = {}
    for row, rooms in rows.items():
        for i, room in enumerate(rooms):
            place[room] = (width * (i + 0.5 + 0.13 * (row % 3 - 1)) / len(rooms), step * (max(rows) - row) + 36)
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="DejaVu Sans, sans-serif" font-size="12">',
           f'<rect width="{width}" height="{height}" fill="white"/>']
    for room, used in sorted(arrows.items()):
        for other in sorted(used):
            (x, y), (u, v) = place[room], place[other]
            svg.append(f'<line x1="{x:.0f}" y1="{y:.0f}" x2="{u:.0f}" y2="{v:.0f}" stroke="#ddd"/>')
    colours = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#000000"]
    for k, (walk, files) in enumerate(walks.items()):
        points = [place[r] for r in rooms_along(files) if r in place]
        shift = 4 * (k - 2)
        path = " ".join(f"{x + shift:.0f},{y + shift:.0f}" for x, y in points)
        svg.append(f'<polyline points="{path}" fill="none" stroke="{colours[k]}" stroke-width="2.4" opacity="0.75"/>')
    for room, (x, y) in place.items():
        svg.append(f'<rect x="{x - box / 2:.0f}" y="{y - 11:.0f}" width="{box}" height="22" rx="4" fill="white" fill-opacity="0.85" stroke="#555"/>')
        svg.append(f'<text x="{x:.0f}" y="{y + 4:.0f}" text-anchor="middle">{room}</text>')
    for k, (walk, files) in enumerate(walks.items()):
        x, y = place[room_of(files[0])]
        svg.append(f'<circle cx="{x - box / 2:.0f}" cy="{y + 4 * (k - 2):.0f}" r="5" fill="{colours[k]}"/>')
        y = step * (max(rows) + 1) + 40 + 20 * k
        svg.append(f'<line x1="30" y1="{y - 4}" x2="60" y2="{y - 4}" stroke="{colours[k]}" stroke-width="2.4"/>')
        svg.append(f'<text x="70" y="{y}">{walk}: {len(files)} files (begins at the dot)</text>')
    FIGURE.write_text("\n".join(svg + ["</svg>"]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=Path)
    for option in ("--show", "--figure", "--check"):
        parser.add_argument(option, action="store_true")
    parser.add_argument("--walk", choices=WALKS, action="append")
    arguments = parser.parse_args()
    if arguments.build:
        for walk in arguments.walk or WALKS:
            trace = record(arguments.build.resolve(), walk)
            files = files_of(trace, WALKS[walk][1])
            text = describe(walk, files)
            print(f"{walk}: {text}")
            if not arguments.show:
                page = PAGE.read_text()
                mark = rf"(<!-- walk: {re.escape(walk)} -->\n).*?(<!-- end -->)"
                PAGE.write_text(re.sub(mark, lambda m: m.group(1) + text + m.group(2), page, flags=re.S))
    walks = page_walks() if not arguments.show else {}
    if arguments.figure or (arguments.build and not arguments.show):
        draw(walks)
    faults = check(walks) if not arguments.show else []
    print("\n".join(faults) or "each walk keeps its limits")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
