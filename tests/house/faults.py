#!/usr/bin/env python3
"""Wrong input is a `Fault {key, what, allowed, place}` (base/fault.h) and nothing else: exits 1 with a line for every sentence that was put
together by hand below `gui/` and `cli/`, where a front end could no longer tell the key from the words.

- What is thrown is a FaultError, or a ResourceError, a RefusedError or a kind of these, and a FaultError is made of faults, never of a text.
- What is allowed and where it stands are fields: no `what` has an "allowed:" in it, nor begins with "FILE:" or "KEY:".

  tests/house/faults.py              checks
  tests/house/faults.py --self-test  checks that it would find what it looks for
"""
import re
import sys
from pathlib import Path

from self_test import judges_wrongly

ROOT = Path(__file__).resolve().parents[2]
BELOW = ["base", "constraints", "sim", "analysis", "devices", "network", "bench"]
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.S)
STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')
THROWN = re.compile(r"\bthrow\s+(?:\w+::)*(\w*(?:Error|error|exception|_argument|_range))\b")
KINDS = frozenset({"FaultError", "ResourceError", "RefusedError"})
KIND = re.compile(r"\b(?:struct|class)\s+(\w+)\s*(?:final\s*)?:\s*(?:public\s+)?(?:\w+::)*(?:ResourceError|RefusedError)\b")  # nothing that was given wrongly
OF_TEXT = re.compile(r'\bFaultError\(\s*(?:"|fmt::|std::string|\w+(?:\(\))?\s*\+)')
FAULT = re.compile(r"\b(?:Formula)?Fault\s*(?:\w+\s*)?\{|\bfaults\w*\.push_back\(\s*\{")


def without_comments(text):
    """Line breaks stay, so that lines count as they did; a string with // in it is left alone."""
    keep = lambda m: m.group() if m.group().startswith('"') else re.sub(r"[^\n]", " ", m.group())
    return re.sub(STRING.pattern + "|" + COMMENT.pattern, keep, text, flags=re.S)


def inside_braces(text, opening):
    depth = 0
    for at in range(opening, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0) if text[at] in "{}" else 0
        if depth == 0:
            return text[opening:at]
    return text[opening:]


def faults_in(text, kinds=KINDS):
    text = without_comments(text)
    kinds = kinds | set(KIND.findall(text))
    line = lambda at: text.count("\n", 0, at) + 1
    found = [(line(m.start()), f"throws {m.group(1)}") for m in THROWN.finditer(text) if m.group(1) not in kinds]
    found += [(line(m.start()), "a FaultError made of a text") for m in OF_TEXT.finditer(text)]
    for m in FAULT.finditer(text):
        fault = inside_braces(text, m.end() - 1)
        without_key = re.match(r"\{\s*(\.what|\{\}|\"\")", fault)
        for string in STRING.findall(fault):
            if "allowed:" in string:
                found.append((line(m.start()), f"a fault that has its range in its words: {string}"))
            if without_key and string.startswith('"{}: '):
                found.append((line(m.start()), f"a fault that has its key or file in its words: {string}"))
    return found


def self_test():
    said = ['throw UsageError("x");', "throw std::runtime_error(what);", 'throw FaultError("a text");', 'throw FaultError(file + ": bad");',
            'throw FaultError(fmt::format("{}: bad", file));', 'throw FaultError(Fault{"key", "is 3; allowed: 2"});',
            'faults.push_back({"key", fmt::format("is {}; allowed: 2", x)});', 'FaultError(Fault{.what = fmt::format("{}: bad", file)});']
    silent = ['throw FaultError(Fault{"key", "is 3", "2"});', "throw FaultError(std::move(faults));", 'throw ResourceError("no disk");',
              '// throw UsageError("x")', "throw;", "throw std::bad_alloc();", 'throw RefusedError("too stiff; allowed: less");',
              'struct BusError : ResourceError {}; void f() { throw BusError("gone"); }',
              'explicit FaultError(Fault fault) : FaultError(std::vector<Fault>{std::move(fault)}) {}']
    return judges_wrongly("faults.py", faults_in, said, silent)


def main():
    if (wrong := self_test()) or "--self-test" in sys.argv:
        return wrong
    files = [f for top in BELOW for f in sorted((ROOT / top).rglob("*")) if f.suffix in (".h", ".cpp")]
    texts = {f.relative_to(ROOT): f.read_text() for f in files}
    kinds = KINDS.union(*(KIND.findall(text) for text in texts.values()))
    found = [(file, *fault) for file, text in texts.items() for fault in faults_in(text, kinds)]
    for file, number, what in found:
        print(f"{file}:{number}: {what}")
    print(f"{len(files)} files below gui and cli: {len(found)} faults that are only words")
    return bool(found) or not files


if __name__ == "__main__":
    sys.exit(main())
