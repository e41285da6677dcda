#!/usr/bin/env python3
"""Runs the commands of the manual: commands.py REACH [--long] [--list] [--update] [PAGE...]

A page's marked blocks are run in their order, in one empty folder with the repository's `resources`, `docs` and `tests` beside it:

    <!-- run -->              the next block, by `bash -e`
    <!-- run: long -->        only with --long
    <!-- not run: WHY -->     never; the reason stands in the page's source
    <!-- file: NAME -->       the next block is written to NAME

A block in `console` style holds `$ commands` and what they print; `…` alone on a line stands for any lines, within a line for any
text. --update writes what is printed now in place of it, except where the page has `…`.

Every block that calls a program of ours must be marked. Every `reach` command of every page, also within a sentence, must name a
subcommand and options that there are."""
import argparse
import os
import re
import shlex
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OURS = re.compile(r"^\s*(?:\$ )?(?:reach|reachlab|packaging/\w+|build/\S+|cmake|tests/\S+)(?: |$)", re.M)
MARK = re.compile(r"^<!-- (run|run: long|not run: .+|file: \S+) -->\s*$")


@dataclass
class Block:
    page: Path
    line: int
    style: str
    text: str
    mark: str  # "" without one


def manual_pages():
    """All pages but the decision records and those that are made from schemas."""
    return [page for page in sorted((ROOT / "docs").rglob("*.md")) if page.parent.name not in ("adr", "reference")]


def blocks(page):
    """Fenced and indented blocks with the mark right before them."""
    lines = page.read_text().splitlines()
    mark, i = "", 0
    while i < len(lines):
        line = lines[i]
        marked = MARK.match(line)
        if marked:
            mark = marked[1]
        elif fence := re.match(r"^(`{3,})(\w*)", line):
            end = next((k for k in range(i + 1, len(lines)) if lines[k].startswith(fence[1])), None)
            if end is None:
                sys.exit(f"{page}:{i + 1}: the block has no end")
            yield Block(page, i + 1, fence[2], "\n".join(lines[i + 1:end]), mark)
            mark, i = "", end
        elif line.startswith("    ") and line.strip() and (i == 0 or not lines[i - 1].strip() or MARK.match(lines[i - 1])):
            end = i
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            yield Block(page, i + 1, "", "\n".join(part[4:] for part in lines[i:end]).rstrip(), mark)
            mark, i = "", end - 1
        elif line.strip():
            if mark:
                sys.exit(f"{page}:{i + 1}: a mark without a block")
        i += 1


def steps(block):
    """Pairs of commands and what they should print (None: not said)."""
    if block.style != "console":
        return [(block.text, None)]
    found = []
    for line in block.text.splitlines():
        if line.startswith("$ "):
            found.append([line[2:], []])
        elif found and found[-1][0].endswith("\\") and not found[-1][1]:
            found[-1][0] += "\n" + line
        elif found:
            found[-1][1].append(line)
        else:
            sys.exit(f"{block.page}:{block.line}: output before the first command")
    return [(command, "\n".join(output)) for command, output in found]


def same(expected, printed):
    """Whether `printed` is what the page shows."""
    pattern = ""
    for line in expected.rstrip().splitlines():
        if line.strip() == "…":
            pattern += r"(?:.*\n)*?"
        else:
            pattern += r"[^\n]*".join(re.escape(part) for part in line.rstrip().split("…")) + r"[ ]*\n"
    return re.fullmatch(pattern, printed.rstrip() + "\n" if printed.strip() else "") is not None


def environment(reach, folder):
    programs = folder / "programs"
    programs.mkdir()
    (programs / "reach").symlink_to(reach)
    (programs / "python3").symlink_to("/usr/bin/python3")  # Debian's, which has pandas
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("REACHLAB", "DISPLAY", "WAYLAND", "XDG_", "LC_"))}
    return {**kept, "PATH": f"{programs}:{kept['PATH']}", "HOME": str(folder), "LC_ALL": "C.UTF-8"}


def run_page(page, reach, long, update):
    """Faults of the page's commands, one text each."""
    faults = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        work = folder / "work"
        work.mkdir()
        for link in ("resources", "docs", "tests", "constraints"):
            (work / link).symlink_to(ROOT / link)
        shell = environment(reach, folder)
        for block in blocks(page):
            place = f"{page.relative_to(ROOT)}:{block.line}"
            if block.mark.startswith("file: "):
                (work / block.mark[6:]).write_text(block.text + "\n")
            elif block.mark == "run" or (block.mark == "run: long" and long):
                for command, expected in steps(block):
                    done = subprocess.run(["bash", "-e", "-o", "pipefail", "-c", command], cwd=work, env=shell, capture_output=True,
                                          text=True, stdin=subprocess.DEVNULL, check=False)
                    if done.returncode != 0:
                        return faults + [f"{place}: exit {done.returncode}\n$ {command}\n{done.stdout}{done.stderr}"]
                    if expected is not None and not same(expected, done.stdout):
                        if update and "…" not in expected:
                            page.write_text(page.read_text().replace(f"$ {command}\n{expected}", f"$ {command}\n{done.stdout.rstrip()}"))
                        else:
                            faults.append(f"{place}: prints something else\n$ {command}\n{done.stdout}instead of\n{expected}")
            elif not block.mark and OURS.search(block.text):
                faults.append(f"{place}: the block has commands and no mark, <!-- run --> for example\n{block.text}")
    return faults


class Grammar:
    """The subcommands and options that `reach --help` tells of."""

    def __init__(self, reach):
        self.reach, self.known = reach, {}

    def options(self, words):
        key = tuple(words)
        if key not in self.known:
            done = subprocess.run([self.reach, *words, "--help"], capture_output=True, text=True, check=False)
            self.known[key] = set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", done.stdout, re.M)) if done.returncode == 0 else None
        return self.known[key]

    def fault(self, command):
        try:
            words = shlex.split(command, comments=True)[1:]
        except ValueError as error:
            return str(error)
        if not words or words[0].startswith("-") or words[0] in ("…", "COMMAND"):
            return ""
        path = words[:2] if words[0] in ("constraint", "peers", "study") and len(words) > 1 and words[1] != "--help" else words[:1]
        known = self.options(path)
        if known is None:
            return f"there is no reach {' '.join(path)}"
        for word in words:
            if re.match(r"--[a-z]", word) and word.split("=")[0] not in known:
                return f"reach {' '.join(path)} has no {word}"
        return ""


def commands_named(page):
    """(line, command) of every `reach` call in blocks and sentences."""
    for number, line in enumerate(page.read_text().splitlines(), 1):
        found = re.findall(r"`(reach [^`]+)`", line)
        if bare := re.match(r"^(?:    |\$ |  )?(reach [a-z][^|]*)", line):
            if "`" not in line:
                found.append(bare[1])
        for command in found:
            for part in re.split(r" \| |; | && | > | 2> ", command):
                if part.startswith("reach "):
                    yield number, part


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("reach", type=Path)
    parser.add_argument("pages", nargs="*", type=Path)
    for flag in ("--long", "--list", "--update"):
        parser.add_argument(flag, action="store_true")
    given = parser.parse_args()
    reach = given.reach.resolve()
    pages = [page.resolve() for page in given.pages] or [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *manual_pages()]
    if given.list:
        for page in pages:
            for block in blocks(page):
                if block.mark.startswith(("run", "not")):
                    print(f"{page.relative_to(ROOT)}:{block.line}: {block.mark}")
        return
    faults, grammar = [], Grammar(reach)
    for page in pages:
        faults += run_page(page, reach, given.long, given.update)
        faults += [f"{page.relative_to(ROOT)}:{line}: {said}" for line, command in commands_named(page) if (said := grammar.fault(command))]
    if faults:
        sys.exit("\n\n".join(faults) + f"\n\n{len(faults)} faults in the manual's commands")


if __name__ == "__main__":
    main()
