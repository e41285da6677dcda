#!/usr/bin/env python3
"""Files, decision records, headings and tests that comments and pages cite: exits 1 with a line for every one that is not there.

  tests/house/citations.py              checks
  tests/house/citations.py --self-test  checks that it would find what it looks for

A citation is the path of a file or a folder from the repository's root (docs/theory/criteria.md, tests/long), for a page also from its own folder. Behind a
page may follow a comma and a heading in quotation marks, or # and its anchor. docs/adr/0020 stands for the record of that number. A test is a
`Suite.Name` in backticks; `Suite.*` stands for all of a suite, and `Suite.Beg…` for those that begin so."""
import functools
import re
import sys
from pathlib import Path

from self_test import judges_wrongly

ROOT = Path(__file__).resolve().parents[2]
TOPS = ["analysis", "base", "bench", "cli", "cmake", "constraints", "devices", "docs", "gui", "network", "packaging", "resources", "sim", "tests"]
CODE = (".h", ".cpp", ".py", ".sh", ".cmake", ".in", ".txt")
PAGE = re.compile(r'(?<![\w/.:-])((?:[\w.-]+/)*[\w.-]+\.md)(?:(?:,? |\)? )"([^"]+)"|, "([^"]+)"|#([\w-]+))?')
FILE = re.compile(rf"(?<![\w/.-])((?:{'|'.join(TOPS)})/[\w./-]*\w)(?![\w*…-])")
TEST = re.compile(r"`([A-Z][A-Za-z0-9]*\.(?:\*|[A-Z][A-Za-z0-9]*…?))`")
RECORD = re.compile(r"docs/adr/(\d{4})(?![\w-])")
COMMENT = re.compile(r"^\s*(?:///?|\*)\s?(.*)$")
HASH_COMMENT = re.compile(r"^\s*#\s?(.*)$")
PLACEHOLDER = re.compile(r"NAME|ROOM|FILE|EXPERIMENT|…")
# Not about files of ours: what a dataset or a study's output is called.
FOREIGN = {"README.md", "report.md"}


def comments(text, code):
    """(line, text) of each comment, its lines joined; of a page its paragraphs."""
    block, start = [], 0
    for number, line in enumerate([*text.splitlines(), ""], 1):
        found = code.match(line) if code else None
        said = found[1] if found else (line if not code and line.strip() else None)
        trailing = re.search(r"//\s?(.*)$", line) if code is COMMENT and said is None else None
        if said is not None:
            start = start or number
            block.append(said)
            continue
        if block:
            yield start, " ".join(block)
        block, start = [], 0
        if trailing:
            yield number, trailing[1]


def style_of(file):
    return None if file.suffix == ".md" else COMMENT if file.suffix in (".h", ".cpp") else HASH_COMMENT


def anchor_of(heading):
    plain = re.sub(r"[^\w\- ]", "", heading.replace("`", "").lower())
    return plain.replace(" ", "-")


def headings(page):
    lines, fenced, found = page.read_text().splitlines(), False, []
    for line in lines:
        fenced ^= line.startswith("```")
        if not fenced and (heading := re.match(r"#{1,6} (.+?)\s*$", line)):
            found.append(heading[1].replace("$", "").replace("`", ""))
        elif bold := re.match(r"\*\*(.+?)\.?\*\*", line):
            found.append(bold[1].rstrip("."))
    return found


@functools.cache
def tests():
    found = re.compile(r"TEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)")
    return {".".join(names) for file in (ROOT / "tests").rglob("*_test.cpp") for names in found.findall(file.read_text())}


def is_test(cited):
    return any(test.startswith(cited.rstrip("*…")) for test in tests()) if cited[-1] in "*…" else cited in tests()


def faults(text, file, code):
    for number, said in comments(text, code):
        for found in PAGE.finditer(said):
            if PLACEHOLDER.search(found[1]) or found[1] in FOREIGN or "*" in found[0]:
                continue
            beside = (ROOT / file).parent / found[1]
            page = ROOT / found[1] if (ROOT / found[1]).is_file() or code else beside
            if not page.is_file():
                yield number, f"{found[1]} is not there"
                continue
            heading, anchor = found[2] or found[3], found[4]
            known = headings(page)
            if heading and heading not in known:
                yield number, f'{found[1]} has no heading "{heading}"'
            if anchor and anchor not in {anchor_of(h) for h in known}:
                yield number, f"{found[1]} has no heading #{anchor}"
        for found in FILE.finditer(said):
            if not found[1].endswith(".md") and not RECORD.fullmatch(found[1]) and not PLACEHOLDER.search(found[1]) and not (ROOT / found[1]).exists():
                yield number, f"{found[1]} is not there"
        for found in RECORD.finditer(said):
            if not list((ROOT / "docs/adr").glob(found[1] + "-*.md")):
                yield number, f"docs/adr/{found[1]} is not there"
        for found in TEST.finditer(said):
            if not is_test(found[1]):
                yield number, f"there is no test {found[1]}"


def self_test():
    said = ["// see docs/nowhere.md", '// docs/theory/criteria.md, "No such heading"', '// docs/theory/criteria.md,\n// "No such heading"', "// docs/adr/9999",
            "// criteria.md 5", "int x;  // tests/long/gone.sh", "// tests/gone", "// docs/theory/criteria.md#no-such"]
    silent = ['// docs/theory/criteria.md, "Flat\n// outputs"', "// docs/adr/0020", 'auto x = "docs/nowhere.md";', "// tests/house/citations.py", "// tests/house/", "// tests/house/gone*.py", "// devices/ROOM/NAME.cpp", '#include "base/gone.h"']
    return (judges_wrongly("citations.py", lambda text: list(faults(text, "x.h", COMMENT)), said, silent)
            | judges_wrongly("citations.py", lambda text: list(faults(text, "docs/x.md", None)), ["[x](gone.md)", "`Watch.GoneTest`", "`Watch.Gone…`", "`Gone.*`"],
                            ["[x](theory/motion.md#energy)", "`Watch.PassesAnOrdinaryReachUntouched`", "`Watch.Passes…`", "`Watch.*`"]))


def main():
    if (wrong := self_test()) or "--self-test" in sys.argv:
        return wrong
    files = [f for top in TOPS for f in sorted((ROOT / top).rglob("*")) if f.suffix in (*CODE, ".md") and f.is_file() and "expected" not in f.parts]
    files += [f for f in ROOT.glob("*.md")] + [ROOT / "CMakeLists.txt"]
    found = []
    for file in files:
        name = file.relative_to(ROOT)
        if file == Path(__file__).resolve():
            continue
        try:
            text = file.read_text()
        except UnicodeDecodeError:
            continue
        found += [f"{name}:{number}: {said}" for number, said in faults(text, name, style_of(file))]
    print("\n".join(found), end="\n" if found else "")
    print(f"{len(files)} files: {len(found)} citations lead nowhere")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
