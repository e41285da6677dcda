#!/usr/bin/env python3
"""What is said below `gui/` and `cli/` speaks of keys and values: exits 1 with a line for every string there that names an option of the
command line or a widget of the window. Each front end has the words of its own door (cli/terminal/option_words.h, gui/**/fault_words.h).

  tests/house/words.py              checks
  tests/house/words.py --self-test  checks that it would find what it looks for
"""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BELOW = ["base", "constraints", "sim", "analysis", "devices", "network", "bench"]
OPTION = re.compile(r"(?<![\w-])--[a-z]")
# No "button": devices have them.
WIDGET = re.compile(r"\b(dock|dialog|menu|spin ?box|check ?box|slider|tab page|tool ?bar|widget)s?\b", re.I)
RAW = re.compile(r'R"(\w*)\((.*?)\)\1"', re.S)
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')


def strings(text):
    """(line number, string) of every literal that is no include and stands in no comment."""
    for found in RAW.finditer(text):
        yield text.count("\n", 0, found.start()) + 1, found.group()
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith(("#include", "//", "/*", "*")):
            continue
        for found in STRING.finditer(line):
            if "//" not in STRING.sub("", line[: found.start()]):
                yield number, found.group()


def faults_in(text):
    """A single word is a key of some format, and no message."""
    named = lambda string: OPTION.search(string) or (" " in string and WIDGET.search(string))
    return [(number, string) for number, string in strings(text) if named(string)]


def self_test():
    said = ['R"(of\nseveral lines: --check)"', 'throw FaultError("--age 200: too old");', 'x("more than 3 of --unknowns");', 'say("look into the dock");', 'say("in the Menus");']
    silent = ['#include "a--b"', '// "--age"', 'for (; n; --n) say("n");', 'say("a -- b");', 'say("tabulated, docked");', 'x = y; // "--age"', 'json["docks"]', 'say("button 2 of the handle");']
    wrong = [line for line in said if not faults_in(line)] + [line for line in silent if faults_in(line)]
    for line in wrong:
        print(f"words.py judges wrongly: {line}")
    return bool(wrong)


def main():
    if self_test() or "--self-test" in sys.argv:
        return self_test()
    files = [f for top in BELOW for f in sorted((ROOT / top).rglob("*")) if f.suffix in (".h", ".cpp")]
    found = [(f.relative_to(ROOT), *fault) for f in files for fault in faults_in(f.read_text())]
    for file, number, string in found:
        print(f"{file}:{number}: names an option or a widget: {string}")
    print(f"{len(files)} files below gui and cli: {len(found)} strings name an option or a widget")
    return bool(found) or not files


if __name__ == "__main__":
    sys.exit(main())
