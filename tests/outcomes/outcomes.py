#!/usr/bin/env python3
"""What the commands print and write, compared with what was looked at once and stands in expected/: outcomes.py REACH [--update] [CASE...]

cases.txt holds `NAME: COMMAND`, run one after the other by `bash -e` in one empty folder with the repository's `resources` and `tests` beside
it. What a command prints, how it ends and the files that it writes make NAME.txt: long tables as some of their rows and the sum of every column,
drawings as their elements with the sums of their coordinates, books of other programs as their names, a list and what is said of a column on
one line; where NAME ends with `quiet`, the files are left out. Numbers may differ by one part in 100,000
(fits and quadratures end where the last bits of a machine's elementary functions put them), and by 2e-6 where they are small.
"""
import argparse
import ctypes.util
import difflib
import gzip
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
NUMBER = re.compile(r"(?<![\w.#])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w])")
FLAT = re.compile(r"^( +)(.*[\[{])((?:\n\1  [^\n{\[]+)+)\n\1([\]}])", re.M)  # a list or an object that holds no other
RELATIVE, ABSOLUTE = 1e-5, 2e-6
cairo_version = ctypes.CDLL(ctypes.util.find_library("cairo")).cairo_version_string
cairo_version.restype = ctypes.c_char_p
CAIRO = cairo_version()
ROWS = 6  # of a long table
TEXTS = {".csv", ".tsv", ".json", ".svg", ".html", ".txt", ".md", ".cpp", ".gz", ".sh"}


def plain(text, folder, programs):
    """Without what differs from run to run and from machine to machine."""
    text = text.replace(str(folder), "FOLDER").replace(programs, "PROGRAMS")
    text = re.sub(r"\d{4}-\d\d-\d\d[T ]\d\d:\d\d(?::\d\d(?:\.\d+)?)?Z?", "TIME", text)
    text = re.sub(r"g\+\+ [^\"\n,<]*, for [^\"\n,<]*", "COMPILER", text)
    text = re.sub(r'"fingerprint": "\w+"', '"fingerprint": "BUILD"', text)
    return re.sub(r"reachlab \d+\.\d+\.\d+", "reachlab VERSION", text, flags=re.I)


def sums(cells):
    """Of the numbers of a column, else how many different texts there are."""
    try:
        return f"{sum(float(cell) for cell in cells if cell not in ('', 'n/a')):.10g}"
    except ValueError:
        return f"{len(set(cells))} texts, {hashlib.sha256('|'.join(cells).encode()).hexdigest()[:8]}" if not any(NUMBER.search(c) for c in cells) else "texts"


def table(text, separator):
    lines = text.splitlines()
    if len(lines) < 2 * ROWS + 4:
        return text
    rows = [line.split(separator) for line in lines[1:]]
    if len({len(row) for row in rows}) > 1 or len(rows[0]) < 2:
        return text
    chosen = [lines[0]] + [lines[1 + k * (len(rows) - 1) // (ROWS - 1)] for k in range(ROWS)]
    return "\n".join(chosen + [f"{len(rows)} rows; sums: " + separator.join(sums(column) for column in zip(*rows))])


def drawing(text):
    """An element a line; paths of one style that follow each other by their number, the first one's ends, and their coordinates' sum."""
    text = re.sub(r"<defs>.*?</defs>", "", text, flags=re.S)
    out, style, paths = [], None, []

    def flush():
        if paths:
            ends = " ".join(f"{n:g}" for n in paths[0][:4] + paths[0][-2:])
            out.append(f"{len(paths)} paths, {sum(map(len, paths))} numbers {ends} sum {sum(map(sum, paths)):.6g} {style}")
            paths.clear()
    for element in re.findall(r"<(?!/|\?)([^>]*)>", text):
        element = re.sub(r'(?:stroke-opacity|fill-opacity):1;|stroke-miterlimit:10;|stroke-linecap:butt;|stroke-linejoin:(?:round|miter);', "", element)
        path = re.search(r'\bd="([^"]*)"', element)
        without = element.replace(path.group(0), "") if path else None
        if not path or without != style:
            flush()
        if path:
            style = without
            paths.append([float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", path.group(1))])
        else:
            out.append(element.strip(" /"))
    flush()
    merged, k = [], 0
    while k < len(out):  # letters of one word
        if out[k].startswith("use "):
            end = k
            while end < len(out) and out[end].startswith("use "):
                end += 1
            places = [[float(n) for n in re.findall(r'\b[xy]="([-\d.]+)"', use)] for use in out[k:end]]
            letters = hashlib.sha256("".join(re.findall(r'href="(#[^"]*)"', " ".join(out[k:end]))).encode()).hexdigest()[:8]
            style = merged.pop() + " " if merged[-1].startswith("g style=") else ""
            merged.append(f"{style}{end - k} letters {letters} " + " ".join(f"{sum(c):.6g}" for c in zip(*places)))
            k = end
            continue
        if out[k] not in ("g", ""):
            merged.append(out[k])
        k += 1
    return "\n".join(merged)


def digest(file):
    raw = file.read_bytes()
    suffixes = file.suffixes
    if file.suffix == ".gz":
        raw = gzip.decompress(raw)
        suffixes = suffixes[:-1]
    if file.suffix not in TEXTS:
        return "(not a text)"
    text = raw.decode("utf-8", errors="replace")
    kind = suffixes[-1] if suffixes else ""
    if kind == ".svg":
        return drawing(text)
    if kind == ".csv":
        return table(text, ",")
    if kind == ".tsv":
        return table(text, "\t")
    if kind == ".json":
        return FLAT.sub(lambda found: found[1] + found[2] + found[3].replace(f"\n{found[1]} ", "") + f" {found[4]}", text)
    if kind == ".html":
        text = re.sub(r"<style.*?</style>", "", text, flags=re.S)
        text = re.sub(r"<svg.*?</svg>", "(a drawing)", text, flags=re.S)
        return re.sub(r"\n\s*\n+", "\n", re.sub(r"<[^>]*>", "", re.sub(r"</(?:p|tr|h\d|li|div)>", "\n", text)))
    return text


def state(folder):
    return {p: (p.stat().st_mtime_ns, p.stat().st_size) for p in sorted(folder.rglob("*")) if p.is_file() and not p.is_symlink()}


def outcome(name, command, folder, environment):
    before = state(folder)
    done = subprocess.run(["bash", "-e", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          errors="replace", timeout=600)
    printed = done.stdout
    if "," in printed.split("\n", 1)[0] and len(printed.splitlines()) > 2 * ROWS + 4:
        printed = table(printed, ",")
    parts = [f"$ {command}", f"exit {done.returncode}", printed.rstrip()]
    if done.stderr.strip():
        parts += ["--- stderr", done.stderr.rstrip()]
    after = state(folder)
    seen = {}
    for file in after:
        if name.endswith("quiet") or before.get(file) == after[file] or file.name.endswith("_log.reach"):
            continue
        text = digest(file).rstrip()
        parts.append(f"--- {file.relative_to(folder)}")
        parts.append(text if text not in seen or len(text) < 200 else f"as {seen[text]}")
        seen.setdefault(text, file.name)
    lines = [line.rstrip()[:2000] for line in plain("\n".join(parts), folder, environment["PATH"].split(":")[0]).splitlines()]
    return "\n".join(lines) + "\n"


def same(wanted, got):
    if wanted == got:
        return True
    if NUMBER.sub("#", wanted) != NUMBER.sub("#", got):
        return False
    for a, b in zip(NUMBER.findall(wanted), NUMBER.findall(got)):
        x, y = float(a), float(b)
        if abs(x - y) > ABSOLUTE + RELATIVE * max(abs(x), abs(y)):
            return False
    return True


def without_drawings(text):
    return re.sub(r"^(--- \S+\.svg)\n(?:(?!--- ).*\n)*", r"\1\n", text, flags=re.M)


def differences(name, wanted, got):
    """Lines of a diff, without those that are the same but for the last digits of their numbers."""
    if not CAIRO.startswith(b"1.16."):  # others write the same drawing as other elements
        wanted, got = without_drawings(wanted), without_drawings(got)
    a, b = wanted.splitlines(), got.splitlines()
    if len(a) == len(b):
        b = [x if same(x, y) else y for x, y in zip(a, b)]
    return list(difflib.unified_diff(a, b, f"expected/{name}.txt", "now", lineterm="", n=0))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reach")
    parser.add_argument("cases", nargs="*")
    parser.add_argument("--update", action="store_true")
    wishes = parser.parse_intermixed_args()
    reach = pathlib.Path(wishes.reach).resolve()
    wrong = 0
    groups = {}  # cases of one group share a folder: "GROUP/NAME"
    for line in (HERE / "cases.txt").read_text(encoding="utf-8").splitlines():
        if line.strip() and not line.startswith("#"):
            name, command = line.split(": ", 1)
            groups.setdefault(name.split("-")[0], []).append((name, command))
    for group, cases in groups.items():
        if wishes.cases and not any(name in wishes.cases or group in wishes.cases for name, _ in cases):
            continue
        with tempfile.TemporaryDirectory() as made:
            folder = pathlib.Path(made)
            for beside in ("resources", "tests"):
                (folder / beside).symlink_to(ROOT / beside)
            environment = {k: v for k, v in os.environ.items() if not k.startswith("XDG_")} | {
                "PATH": f"{reach.parent}:{os.environ['PATH']}", "HOME": str(folder), "LC_ALL": "C.UTF-8", "COLUMNS": "120"}
            for name, command in cases:
                got = outcome(name, command, folder, environment)
                file = HERE / "expected" / f"{name}.txt"
                if wishes.update:
                    file.parent.mkdir(exist_ok=True)
                    if not file.exists() or not same(file.read_text(encoding="utf-8"), got):
                        file.write_text(got, encoding="utf-8")
                    continue
                told = differences(name, file.read_text(encoding="utf-8") if file.exists() else "", got)
                wrong += bool(told)
                print("\n".join(line[:400] for line in told[:40]), end="\n" if told else "")
    if wrong:
        print(f"{wrong} outcomes differ. If each difference is meant: {os.path.relpath(__file__)} {wishes.reach} --update")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
