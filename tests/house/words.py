#!/usr/bin/env python3
"""The words of every text that a person reads. Exits 1 with a line for each wrong word.

- Strings below `gui/` and `cli/` speak of keys and values. They name no option of the command line and no widget of the window. Each front
  end adds its words (cli/terminal/option_words.h, gui/**/fault_words.h). base/terminal is about command lines and is left out.
- Header comments, README, manual, changelog, decision records, and the help and labels of `cli/` and `gui/` use the preferred words of TERMS
  and none of its banned words.

  tests/house/words.py              checks
  tests/house/words.py --self-test  checks that it would find what it looks for
"""
import re
import sys
from pathlib import Path

from prose import groups, paragraphs_of, readable
from self_test import judges_wrongly

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


COUNTED = "second|minute|hour|tick|trial|run|session|station|subject|hand|row|line|file|cell|coordinate|processor|object"
# pattern, wanted instead (empty: another sentence), only in help and labels
TERMS = [(re.compile(pattern, re.I), wanted, short) for pattern, wanted, short in [
    (r"\bin words\b|\bof (?:its|their|one's) own\b|\bthat is none\b", "", False),
    (r"\b(?:goes|go) on\b", "continue", False),
    (r"(?<!-)\bstands?\b(?! (?:still|for)\b|-)", "is", False),
    (r"\bmend(?:s|ed|ing)?\b", "repair", False),
    (r"\bput(?:s|ting)? up\b", "prepare or place", False),
    (r"\bprices?\b", "computation time", False),
    (rf"\b(?:samples|frames|numbers|words|lines|times|trials|reports|pictures|messages|bytes|calls|one|once|line|row|sentence) an? (?:{COUNTED})\b(?=[,.;:)]|$)", "per", False),
    (r"\b(?:along|off|round) the way\b", "path", False),
    (r"\bfaults?\b(?!\\| of the program)", "error", True),
    (r"\b(?:same|calibration|degenerate|on this|of this) places?\b|\bplaces? on\b", "position", True),
]]


def wrong_terms(text, short=False):
    """(written, wanted) in a paragraph; `short`: of help or a label."""
    return [(m.group(), wanted) for pattern, wanted, only in TERMS if short or not only for m in pattern.finditer(text)]


def texts():
    """(file, paragraph, short) of everything that a person reads."""
    for files in groups().values():
        for file in files:
            for paragraph in paragraphs_of(file):
                yield file, readable(paragraph), False
    for top in ("cli", "gui"):
        for file in sorted((ROOT / top).rglob("*.cpp")):
            for _, string in strings(file.read_text()):
                if " " in string:
                    yield file, string, True


def self_test():
    said = ['R"(of\nseveral lines: --check)"', 'throw FaultError("--age 200: too old");', 'x("more than 3 of --unknowns");', 'say("look into the dock");', 'say("in the Menus");']
    silent = ['#include "a--b"', '// "--age"', 'for (; n; --n) say("n");', 'say("a -- b");', 'say("tabulated, docked");', 'x = y; // "--age"', 'json["docks"]', 'say("button 2 of the handle");']
    wrong = judges_wrongly("words.py", faults_in, said, silent)
    said = ["The reason in words.", "A clock of its own.", "It stands here.", "The trial goes on.", "Mends a log.", "The price of a step.", "One line a trial.",
            "A trial is put up.", "100 samples a second.", "along the way"]
    silent = ["In plain words.", "The hand stands still.", "It stands for a mass.", "A stand-in.", "100 samples per second.", "The trial under way.",
              "Asks once a trial is over.", "No session, no fault."]
    wrong |= judges_wrongly("words.py", wrong_terms, said, silent)
    return wrong | judges_wrongly("words.py", lambda text: wrong_terms(text, True), ["Every fault of the file.", "the same place"], [])


def main():
    if (wrong := self_test()) or "--self-test" in sys.argv:
        return wrong
    files = [f for top in BELOW for f in sorted((ROOT / top).rglob("*")) if f.suffix in (".h", ".cpp") and f.parent.name != "terminal"]
    found = [(f.relative_to(ROOT), *fault) for f in files for fault in faults_in(f.read_text())]
    for file, number, string in found:
        print(f"{file}:{number}: names an option or a widget: {string}")
    words = [(file.relative_to(ROOT), *term, text) for file, text, short in texts() for term in wrong_terms(text, short)]
    for file, written, wanted, text in words:
        at = text.find(written)
        print(f"{file}: '{written}'{f', better {wanted}' if wanted else ''}: …{text[max(0, at - 40):at + len(written) + 40].strip()}…")
    print(f"{len(words)} words that have a better one")
    print(f"{len(files)} files below gui and cli: {len(found)} strings name an option or a widget")
    return bool(found or words) or not files


if __name__ == "__main__":
    sys.exit(main())
