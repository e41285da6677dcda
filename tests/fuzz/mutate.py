#!/usr/bin/env python3
"""Mutates what Reachlab reads, knowing its structure, and runs `reach` on it.

    tests/fuzz/mutate.py build/asan --minutes 10 --seed 1            # under the sanitizers: no report, no unknown exit code
    tests/fuzz/mutate.py build/release --minutes 10 --limits         # and nothing above 2 s of processor time or 512 MB
    tests/fuzz/mutate.py build/dev --only 1234 --seed 1 --keep DIR   # one case again, its files kept

Experiments, plans and definitions as JSON trees; logs record by record, with right lengths, sequence numbers and CRCs; replayed reaches and
series of adaptation as tables; BIDS folders cell by cell. Case n depends on (seed, n) alone. Findings are named with their case; exit 1 when there
is one. A `run` or a `simulate` of a movement that lasts long (`duration_s` up to 3600 is allowed) may take 20 us more for each of its ticks.
"""
import argparse
import json
import os
import pathlib
import random
import re
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXIT_CODES = {0, 1, 2, 3, 4}  # 1: replay --check found a difference
CRITERIA = ["min-hand-jerk", "min-hand-jerk", "min-torque-change", "min-crackle", "min-hand-force", "min-hand-force-change", "min-com-acceleration",
            "min-hand-crackle"]
NUMBERS = [0, -0.0, 1, -1, 2, 3, 0.5, 1e-9, -1e-9, 1e-300, 5e-324, 1e3, 1e6, 1e9, 1e15, 1e20, 1e300, 1.7e308, -1.7e308, 2**31 - 1, 2**31, 2**32,
           2**53 + 1, 2**63, 2**64 - 1, 2**64, -2**31 - 1, -2**63 - 1, 600, 9999, 10000, 65536]
# Every force and a cursor, and a block that mixes them.
FORCES = {"schema_version": 1, "constraint": {"name": "free"}, "object": {"kind": "none"},
          "task": {"start": [0, 0, 0], "target": [0, 0, -0.1], "duration_s": 0.5, "plane": "horizontal", "via_m": [[0.01, 0, -0.05]], "via_radius_m": 0.02,
                   "tolerance": {"position_m": 0.01, "velocity_m_per_s": 0.05, "time_s": 0.2}},
          "environment": [{"kind": "viscous", "when": "trial", "matrix_n_s_per_m": [[0, 0, 5], [0, 0, 0], [-5, 0, 0]]},
                          {"kind": "elastic", "matrix_n_per_m": [[10, 0, 0], [0, 0, 0], [0, 0, 10]], "centre_m": [0, 0, 0]},
                          {"kind": "joint-viscous", "matrix_n_m_s_per_rad": [[0.5, 0], [0, 0.5]]},
                          {"kind": "channel", "stiffness_n_per_m": 1000, "damping_n_s_per_m": 15, "half_width_m": 0.001, "ramp_s": 0.1, "break_m": 0.03},
                          {"kind": "pulse", "force_n": [1, 0, 0], "at": {"onset_s": 0.1}, "duration_s": 0.1, "rise_s": 0.01},
                          {"kind": "pulse", "force_n": [1, 0, 0], "at": {"distance_m": 0.02}}],
          "arm": {"link_length_m": [0.33, 0.34], "shoulder_m": [0, -0.4]},
          "cursor": {"rotation_deg": 30, "gain": 1.2, "delay_s": 0.1, "show": "movement-end", "judge": "hand"}}
MIXED = {"schema_version": 1, "name": "mixed",
         "kinds": {"null": {"environment": []}, "turned": {"cursor": {"clamp_deg": 30}}, "channel": {"environment[0]": {"kind": "channel"}}},
         "blocks": [{"experiment": "curl-field", "trials": 4, "mix": [{"kind": "null", "count": 1}, {"kind": "channel", "count": 1}],
                     "targets": {"ring": {"count": 2, "radius_m": 0.1, "first_deg": 90}}, "order": "shuffled-cycles", "not_first": ["channel"],
                     "return": "reach"},
                    {"experiment": "curl-field", "trials": 2, "mix": [{"kind": "null"}, {"kind": "turned"}], "order": "shuffled",
                     "targets": [[0, 0, -0.1], [0.1, 0, 0]], "not_twice": ["null"]}]}
FELT = ["simulated", "simulated:kind=ofc", "simulated:kind=impedance"]
TEXTS = ["", " ", "a", "..", "../../x", "/dev/zero", "x" * 5000, "\u0000", "\x1b[31m", "\udcff".encode("utf-8", "replace").decode(), "ä", "🦀" * 50, "=1+1",
         "sin(", "phi^phi^phi", "1/0", "((((((((" * 30, "a*cos(phi)", "u", "-", "1e400", "NaN", "%s%n", "\n", "\t", ",", "\"", "'"]


def strip_comments(text):
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', lambda m: m.group(1) or " ", text, flags=re.S)


def places(tree, path=()):
    yield path
    if isinstance(tree, dict):
        for key in tree:
            yield from places(tree[key], path + (key,))
    elif isinstance(tree, list):
        for i in range(len(tree)):
            yield from places(tree[i], path + (i,))


def value(chance, old=None):
    kind = chance.randrange(10)
    if kind < 4:
        return chance.choice(NUMBERS)
    if kind < 5 and isinstance(old, (int, float)) and not isinstance(old, bool):
        return old * chance.choice([-1, 0.1, 0.5, 1.001, 2, 10, 1000])
    if kind < 7:
        return chance.choice(TEXTS)
    return chance.choice([None, True, False, [], {}, [0], [[]], [1e308] * 3, [0] * 600, [0.1] * 5000, {"a": 1}, [None], ["x"]])


def mutate_tree(tree, chance):
    tree = json.loads(json.dumps(tree))
    for _ in range(chance.choice([1, 1, 1, 2, 3, 8])):
        path = chance.choice(list(places(tree)))
        if not path:
            continue
        holder = tree
        for step in path[:-1]:
            holder = holder[step]
        last, what = path[-1], chance.randrange(8)
        if what == 0:
            del holder[last]
        elif what == 1 and isinstance(holder, dict):
            holder[chance.choice(TEXTS + list(holder))] = holder[last]
        elif what == 2 and isinstance(holder, list):
            holder.extend([holder[last]] * chance.choice([1, 2, 100]))
        else:
            holder[last] = value(chance, holder[last])
    return tree


def mutate_text(text, chance):
    data = bytearray(text.encode("utf-8", "replace"))
    for _ in range(chance.choice([1, 1, 2, 5])):
        if not data:
            break
        at, what = chance.randrange(len(data)), chance.randrange(5)
        if what == 0:
            data[at] ^= 1 << chance.randrange(8)
        elif what == 1:
            del data[at:at + chance.choice([1, 5, 50, len(data)])]
        elif what == 2:
            data[at:at] = data[at:at + 40] * chance.choice([1, 3, 200])
        elif what == 3:
            data[at:at] = chance.choice([b"\x00", b"\xff", b"[" * 200, b"{\"a\":" * 100, b"\"", b"1e999", b"NaN", b"//", b"/*", b"\xef\xbb\xbf"])
        else:
            del data[at:]
    return bytes(data)


def json_case(tree, chance):
    if chance.randrange(4) == 0:
        return mutate_text(json.dumps(tree, indent=1), chance)
    return json.dumps(mutate_tree(tree, chance), indent=1).encode("utf-8", "replace")


def seconds_asked_for(command):
    """What a movement lasts that is simulated, tick by tick."""
    if command[0] not in ("run", "simulate") or not str(command[1]).endswith("case.json"):
        return 0
    try:
        duration = json.loads(pathlib.Path(command[1]).read_bytes())["task"]["duration_s"]
        return duration if isinstance(duration, (int, float)) and 0 < duration <= 3600 else 0
    except (ValueError, KeyError, TypeError, RecursionError):
        return 0


def is_short(plan):
    """Whether the plan's trials and pauses let it be recorded here."""
    try:
        tree = json.loads(plan)
        settings = [tree, *tree["blocks"]]
        return sum(block.get("trials", tree.get("trials", 0)) for block in tree["blocks"]) <= 40 and len(settings) <= 10
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return True  # refused before the first trial


class Log:
    """A log as its records: (type, payload)."""

    def __init__(self, data):
        self.header, self.records, at = data[:16], [], 16
        while at + 16 <= len(data):
            length, kind, _, _ = struct.unpack_from("<IHHI", data, at)
            self.records.append((kind, bytes(data[at + 12:at + 12 + length])))
            at += length + 16

    def bytes(self, records):
        out = bytearray(self.header)
        for number, (kind, payload) in enumerate(records):
            frame = struct.pack("<IHHI", len(payload), kind, 0, number) + payload
            out += frame + struct.pack("<I", zlib.crc32(frame))
        return bytes(out)

    def case(self, chance):
        records = list(self.records)
        for _ in range(chance.choice([1, 1, 2, 4])):
            at, what = chance.randrange(len(records)), chance.randrange(8)
            if what == 7:
                at = 0
            kind, payload = records[at]
            if kind == 1:
                records[at] = (kind, json_case(json.loads(payload), chance) if payload[:1] == b"{" and len(payload) < 200_000 else payload)
            elif what == 0:
                del records[at]
            elif what == 1:
                records.insert(chance.randrange(len(records) + 1), records[at])
            elif what == 2:
                records[at] = (chance.randrange(0, 9), payload)
            elif what == 3:
                other = chance.randrange(len(records))
                records[at], records[other] = records[other], records[at]
            elif payload:
                data = bytearray(payload)
                for _ in range(chance.choice([1, 2, 6])):
                    spot, size = chance.randrange(len(data)), chance.choice([1, 2, 4, 8])
                    whole = chance.choice([0, 1, 0x7F, 0x80, 0xFF, 0xFFFFFFFF, 0x80000000, 0x7FF0000000000000, 0x7FF8000000000000, 2**63, 2**64 - 1,
                                           chance.getrandbits(64)])
                    data[spot:spot + size] = (whole & (2**(8 * size) - 1)).to_bytes(size, "little")
                if chance.randrange(5) == 0:
                    del data[chance.randrange(len(data)):]
                records[at] = (kind, bytes(data))
            if not records:
                break
        return self.bytes(records)


def table_case(text, separator, chance):
    lines = [line.split(separator) for line in text.split("\n")]
    for _ in range(chance.choice([1, 1, 2, 5])):
        row = chance.randrange(len(lines)) if chance.randrange(3) else min(chance.randrange(3), len(lines) - 1)
        what = chance.randrange(8)
        if what == 0:
            del lines[row]
        elif what == 1:
            lines.insert(row, lines[row] * chance.choice([1, 2, 50]))
        elif what == 2 and len(lines[row]) > 1:
            del lines[row][chance.randrange(len(lines[row]))]
        elif lines[row]:
            cell = chance.choice(NUMBERS + TEXTS)
            lines[row][chance.randrange(len(lines[row]))] = str(cell)
        if not lines:
            return b""
    text = "\n".join(separator.join(line) for line in lines)
    return text.encode("utf-8", "replace") if chance.randrange(8) else mutate_text(text, chance)


class Seeds:
    """What is mutated: shipped files, and one small recorded dataset."""

    def __init__(self, reach, folder):
        read = lambda pattern: {p: json.loads(strip_comments(p.read_text(encoding="utf-8"))) for p in sorted(ROOT.glob(pattern))}
        self.experiments = [*read("resources/experiments/**/*.json").values(), *[FORCES] * 6]
        self.plans = [*read("resources/plans/*.json").values(), *[MIXED] * 4]
        self.definitions = list(read("constraints/definitions/*.json").values())
        self.reaches = [p.read_text() for p in sorted(ROOT.glob("resources/reaches/*.csv"))[:4]]
        data = folder / "seed"
        for experiment in ("dingwell", "torus"):
            subprocess.run([reach, "run", experiment, "--device", "simulated", "--trials", "2", "--seed", "1", "--fast", "--data", data],
                           stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        mixed = folder / "mixed.json"
        mixed.write_text(json.dumps(MIXED))
        subprocess.run([reach, "run", mixed, "--device", "simulated:kind=ofc", "--seed", "1", "--fast", "--subject", "02", "--data", data],
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        self.series = (ROOT / "docs/examples/adaptation-series.csv").read_text()
        self.logs = [Log(p.read_bytes()) for p in sorted((data / "sourcedata").glob("*.reach"))]
        self.dataset = data


def make_case(seeds, chance, folder):
    """Files in `folder`, and the commands to run on them."""
    kind = chance.choice(["experiment"] * 4 + ["plan"] * 2 + ["definition"] * 2 + ["log"] * 5 + ["reach"] * 2 + ["bids"] * 2 + ["series"])
    if kind == "experiment":
        file = folder / "case.json"
        file.write_bytes(json_case(chance.choice(seeds.experiments), chance))
        criterion = chance.choice(CRITERIA)
        return kind, chance.sample([["validate", file], ["validate", file, "--device", "virtual:omni"],
                                    ["simulate", file, "--hand", chance.choice(["hold", "none", "min-jerk", "min-jerk-along"])],
                                    ["predict", file, "--criterion", criterion, "--json"],
                                    ["run", file, "--device", chance.choice(FELT), "--trials", "1", "--seed", "1", "--fast", "--data", folder / "data"]], 2)
    if kind == "plan":
        file = folder / "plan.json"
        file.write_bytes(json_case(chance.choice(seeds.plans), chance))
        commands = [["validate", file]]
        if is_short(file.read_bytes()):
            commands.append(["run", file, "--device", chance.choice(FELT), "--seed", "1", "--fast", "--data", folder / "data"])
        return kind, commands
    if kind == "series":
        file = folder / "series.csv"
        file.write_bytes(table_case(seeds.series, ",", chance))
        return kind, [["adaptation", file, "--resamples", "100"]]
    if kind == "definition":
        file = folder / "definition.json"
        file.write_bytes(json_case(chance.choice(seeds.definitions), chance))
        return kind, [["constraint", "check", file], ["constraint", "eval", file, "--at", chance.choice(["0", "1e300", "0.1,0.2", "-3,1e-300"])]]
    if kind == "log":
        file = folder / "sourcedata" / "sub-01_ses-01_task-x_run-01_log.reach"
        file.parent.mkdir()
        file.write_bytes(chance.choice(seeds.logs).case(chance))
        return kind, chance.sample([["export", file, "--format", "csv", "--out", folder / "csv"], ["export", file, "--format", "bids", "--out", folder / "bids"],
                                    ["replay", file, "--check"], ["recover", file], ["analyze", folder]], 2)
    if kind == "reach":
        file = folder / "reach.csv"
        file.write_bytes(table_case(chance.choice(seeds.reaches), ",", chance))
        return kind, [["run", "dingwell", "--device", f"replay:{file}", "--trials", "1", "--seed", "1", "--fast", "--data", folder / "data"],
                      ["simulate", "dingwell", "--hand", file]]
    data = folder / "dataset"
    shutil.copytree(seeds.dataset, data, ignore=shutil.ignore_patterns("sourcedata", "derivatives"))
    files = sorted(p for p in data.rglob("*") if p.is_file() and p.suffix in (".tsv", ".json"))
    for file in chance.sample(files, chance.choice([1, 1, 2])):
        text = file.read_text(encoding="utf-8", errors="replace")
        file.write_bytes(table_case(text, "\t", chance) if file.suffix == ".tsv" else mutate_text(text, chance))
    return kind, [["analyze", data]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", type=int)
    parser.add_argument("--limits", action="store_true", help="2 s of processor time and 512 MB are findings too")
    parser.add_argument("--keep", type=pathlib.Path, help="folder that keeps the files of findings (and of --only)")
    wishes = parser.parse_args()
    reach = str((wishes.build / "cli" / "reach").resolve())
    findings, cases, codes = 0, 0, {}
    environment = dict(os.environ, ASAN_OPTIONS="allocator_may_return_null=1:detect_leaks=0:max_allocation_size_mb=4096", UBSAN_OPTIONS="print_stacktrace=1",
                       XDG_DATA_HOME="/nonexistent", XDG_CONFIG_HOME="/nonexistent")
    with tempfile.TemporaryDirectory(prefix="reach-mutate-") as scratch:
        scratch = pathlib.Path(scratch)
        seeds = Seeds(reach, scratch)
        end, number = time.monotonic() + 60 * wishes.minutes, 0
        while time.monotonic() < end:
            number += 1
            if wishes.only:
                number = wishes.only
            chance = random.Random(wishes.seed * 1_000_003 + number)
            folder = scratch / "case"
            folder.mkdir()
            try:
                kind, commands = make_case(seeds, chance, folder)
            except (ValueError, KeyError, IndexError, TypeError):  # nothing to mutate was left
                shutil.rmtree(folder)
                continue
            for command in commands:
                cases += 1
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                process = subprocess.Popen([reach, *map(str, command)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL,
                                           env=environment, cwd=folder, start_new_session=True,
                                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (600, 600)))
                try:
                    _, err = process.communicate(timeout=1800)
                except subprocess.TimeoutExpired:  # it waits for what never comes
                    os.killpg(process.pid, 9)
                    _, err = process.communicate()
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
                text = err.decode("utf-8", "replace")
                codes[process.returncode] = codes.get(process.returncode, 0) + 1
                why = []
                if process.returncode not in EXIT_CODES:
                    why.append(f"exit code {process.returncode}")
                if "AddressSanitizer" in text or "runtime error" in text:
                    why.append("sanitizer")
                for words in ("json.exception", "filesystem error", "bad_alloc", "std::", "basic_string", "vector::"):
                    if words in text:
                        why.append(f"says {words}")
                if process.returncode not in (0, 1) and not text.strip():
                    why.append("says nothing")
                if wishes.limits and seconds > 2 + 20e-3 * seconds_asked_for(command):
                    why.append(f"{seconds:.1f} s")
                if wishes.limits and after.ru_maxrss > 512 * 1024 and after.ru_maxrss > before.ru_maxrss:
                    why.append(f"{after.ru_maxrss // 1024} MB")
                if why:
                    findings += 1
                    print(f"case {number} ({kind}): {', '.join(why)}: reach {' '.join(str(c).replace(str(folder), '.') for c in command)}", flush=True)
                    print("    " + "\n    ".join(text.strip().split("\n")[:12])[:2000], flush=True)
                if wishes.keep and (why or wishes.only):
                    kept = wishes.keep / f"case-{wishes.seed}-{number}"
                    shutil.copytree(folder, kept, dirs_exist_ok=True)
            shutil.rmtree(folder)
            if wishes.only:
                break
    told = ", ".join(f"{count} times exit {code}" for code, count in sorted(codes.items()))
    print(f"mutate: seed {wishes.seed}: {cases} commands on {number} mutated inputs ({told}): {findings} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
