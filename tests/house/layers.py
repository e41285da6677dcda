#!/usr/bin/env python3
"""The house's layers, read from the sources: exits 1 with a line for every arrow that CMake does not know, that no include needs, that
runs back up, for a file whose namespace is not its folder's, that takes Eigen from elsewhere than base/math/matrix.h, or that has more than
400 lines of code.

  tests/house/layers.py          checks
  tests/house/layers.py --show   prints the arrows
"""
import re
import sys
from pathlib import Path

from lines import code_lines

ROOT = Path(__file__).resolve().parents[2]
ORDER = ["base", "constraints", "sim", "analysis", "devices", "network", "bench", "gui", "cli"]  # a folder uses those to its left; gui and cli not each other
MAX_FILES = 30
MAX_LINES = 400


def library_of(folder):
    """The folder whose CMakeLists.txt takes in the sources of this one."""
    while folder != Path(".") and not re.search(r"add_library|add_executable|reachlab_library", cmake_text(folder)):
        folder = folder.parent
    return folder


def cmake_text(folder):
    file = ROOT / folder / "CMakeLists.txt"
    return file.read_text() if file.exists() else ""


def sources():
    for top in ORDER:
        for file in sorted((ROOT / top).rglob("*")):
            if file.suffix in (".h", ".cpp"):
                yield file.relative_to(ROOT)


def namespace_of(folder):
    parts = [p for p in folder.parts if p != "sim"]
    if parts[0] == "analysis" and len(parts) > 1:
        parts = parts[1:]
    return "reachlab" if parts == ["base"] else "reachlab::" + parts[0]


def stated_rooms():
    """The folders of the table of rooms, each with its sentence."""
    return dict(re.findall(r"^\| `([\w/]+)` \| (\S.*) \|$", (ROOT / "docs/architecture.md").read_text(), re.M))


def rings(arrows):
    """The nodes that lie on a ring or between two: taking away what uses nothing and what nothing uses leaves them."""
    rest = {a: set(b) & arrows.keys() - {a} for a, b in arrows.items()}
    while ready := [a for a in rest if not rest[a] & rest.keys() or not any(a in b for b in rest.values())]:
        for a in ready:
            del rest[a]
        for b in rest.values():
            b -= set(ready)
    return sorted(map(str, rest))


def room_faults(files):
    uses, count = {}, {}
    for file in files:
        count[file.parent] = count.get(file.parent, 0) + 1
        uses.setdefault(file.parent, set()).update(included(file))
    stated = stated_rooms()
    faults = [f"{room}: {n} files; at most {MAX_FILES}: split the room by idea" for room, n in count.items() if n > MAX_FILES]
    faults += [f"docs/architecture.md: no sentence for {room}" for room in count if str(room) not in stated]
    faults += [f"docs/architecture.md: {room} has no sources" for room in stated if Path(room) not in count]
    if ring := rings(uses):
        faults.append("a ring of rooms among " + ", ".join(ring))
    return faults


def included(file):
    return [Path(m).parent for m in re.findall(r'^#include "([^"]+/[^"]+)"', (ROOT / file).read_text(), re.M)]


def declared_arrows(folder, target_folder):
    """Folders of the project's libraries that this folder's CMakeLists.txt names."""
    # The program's own target may name its folder; that is no arrow.
    named = set(re.findall(r"\breachlab_(\w+)", re.sub(r"#.*", "", cmake_text(folder))))
    return {target_folder[n] for n in named if n in target_folder} - {folder}


def main():
    files = list(sources())
    folders = sorted({library_of(f.parent) for f in files})
    target_folder = {f.name: f for f in folders}
    faults, arrows = [], {f: set() for f in folders}
    for file in files:
        here = library_of(file.parent)
        for other in map(library_of, included(file)):
            if other != here:
                arrows[here].add(other)
        text = (ROOT / file).read_text()
        if (count := code_lines(text, "c")) > MAX_LINES:
            faults.append(f"{file}: {count} lines of code, at most {MAX_LINES}: split it by its sections")
        text = re.sub(r"^namespace \w[\w:]* {\n(?:(?:class|struct) \w+;\n)+}", "", text, flags=re.M)  # names said in advance
        wrong = [n for n in re.findall(r"^namespace (reachlab[\w:]*) {", text, re.M)
                 if n != namespace_of(here) and not n.startswith(namespace_of(here) + "::")]
        faults += [f"{file}: namespace {n}, expected {namespace_of(here)}" for n in wrong]
        if "<Eigen/" in text and file != Path("base/math/matrix.h"):
            faults.append(f"{file}: includes Eigen itself; base/math/matrix.h has it, with the same bits on every processor")

    for folder, used in arrows.items():
        declared = declared_arrows(folder, target_folder)
        faults += [f"{folder}/CMakeLists.txt: does not name {o}, which is included" for o in sorted(used - declared)]
        faults += [f"{folder}/CMakeLists.txt: names {o}, which nothing includes" for o in sorted(declared - used)]
        for other in used:
            rank, below = ORDER.index(folder.parts[0]), ORDER.index(other.parts[0])
            if below > rank or (folder.parts[0], other.parts[0]) == ("cli", "gui"):
                faults.append(f"{folder} includes {other}: the arrow runs back up")

    if ring := rings(arrows):
        faults.append("a ring of libraries among " + ", ".join(ring))
    faults += room_faults(files)

    if "--show" in sys.argv:
        for folder in folders:
            print(folder, "->", ", ".join(map(str, sorted(arrows[folder]))) or "nothing")
    print("\n".join(faults) or f"{len(files)} files in {len(folders)} libraries: every arrow is declared, used and points down")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
