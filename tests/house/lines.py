#!/usr/bin/env python3
"""Lines of code by module: lines that hold neither only white space nor only a comment, in C++, Python, shell, and CMake.

  tests/house/lines.py             counts the files that git tracks here
  tests/house/lines.py REVISION    puts the count of another revision beside it
"""
import io
import re
import signal
import subprocess
import sys
import tarfile
from collections import Counter
from pathlib import PurePosixPath

CODE = {".cpp": "c", ".h": "c", ".c": "c", ".py": "#", ".sh": "#", ".cmake": "#"}
PRODUCT = ("base", "constraints", "sim", "analysis", "devices", "network", "bench", "gui", "cli", "cmake")


def files(revision):
    """(path, text) of every file of the revision, or of the working tree."""
    if not revision:
        for name in subprocess.run(["git", "ls-files"], capture_output=True, check=True, text=True).stdout.splitlines():
            if style_of(PurePosixPath(name)):
                yield name, open(name, encoding="utf-8").read()
        return
    archive = subprocess.run(["git", "archive", "--format=tar", revision], capture_output=True, check=True).stdout
    with tarfile.open(fileobj=io.BytesIO(archive)) as tar:
        for member in tar:
            if member.isfile() and style_of(PurePosixPath(member.name)):
                yield member.name, tar.extractfile(member).read().decode()


def style_of(path):
    return "#" if path.name == "CMakeLists.txt" else CODE.get(path.suffix)


def code_lines(text, style):
    if style == "c":
        text = re.sub(r'R"(\w*)\(.*?\)\1"', lambda m: m.group(0).replace("//", "  ").replace("/*", "  "), text, flags=re.S)
        text = re.sub(r"/\*.*?\*/", lambda m: "\n" * m.group(0).count("\n"), text, flags=re.S)
        return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("//"))
    text = re.sub(r'^\s*""".*?"""\s*$', "", text, flags=re.S | re.M)
    return sum(1 for line in text.splitlines() if line.strip() and not line.strip().startswith("#"))


def count(revision):
    lines = Counter()
    for name, text in files(revision):
        path = PurePosixPath(name)
        part = "product" if path.parts[0] in PRODUCT else "tests" if path.parts[0] == "tests" else None
        if not part:
            continue
        style = style_of(path)
        lines[str(path.parent)] += code_lines(text, style)
        lines[f"{part}: {'C++' if style == 'c' else 'scripts'}"] += code_lines(text, style)
    return lines


def main():
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # whoever reads the output may stop: no traceback
    columns = [count(revision) for revision in sys.argv[1:2]] + [count(None)]
    print(f"{'module':32}" + "".join(f"{name:>12}" for name in (sys.argv[1:2] or []) + ["here"]))
    for room in sorted(set().union(*columns), key=lambda r: (":" in r, r)):
        print(f"{room:32}" + "".join(f"{column[room]:12}" for column in columns))


if __name__ == "__main__":
    main()
