#!/usr/bin/env python3
"""Prints how many objects are compiled again after a change of a header, from what the compiler told ninja.

    tests/house/rebuilds.py build/dev                                          # the headers of the list below
    tests/house/rebuilds.py build/dev base/math/vec3.h sim/trial/outcome.h     # others
    tests/house/rebuilds.py build/dev --most 150                               # fails where a header has more

An object that was not built yet is not counted, so the whole tree has to be built first.
"""
import argparse
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Headers that a change of the dynamics touches often.
HEADERS = ["constraints/constraint.h", "sim/dynamics/scene.h", "sim/dynamics/object/plant.h", "sim/dynamics/systems/system.h",
           "sim/dynamics/hand/hand_segment.h", "base/math/lanes.h"]


def objects_by_header(build):
    """Header's path from the root, to the objects that include it."""
    told = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=True).stdout
    found, target = {}, None
    for line in told.splitlines():
        if line.startswith("    "):
            path = Path(build, line.strip()).resolve() if not line.strip().startswith("/") else Path(line.strip())
            if path.is_relative_to(ROOT):
                found.setdefault(str(path.relative_to(ROOT)), set()).add(target)
        elif ": #deps" in line and line.endswith("(VALID)"):
            target = line.split(": #deps")[0]
        else:
            target = None
    return found


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("build", help="build folder, made with Ninja")
    options.add_argument("headers", nargs="*", default=HEADERS, help="paths from the root")
    options.add_argument("--most", type=int, help="fail where more objects include a header")
    asked = options.parse_args()
    found = objects_by_header(asked.build)
    if not found:
        sys.exit(f"{asked.build}: ninja knows no object yet; build the tree first")
    too_many = False
    for header in asked.headers:
        count = len(found.get(header, ()))
        if not (ROOT / header).is_file():
            sys.exit(f"{header}: there is no such file")
        beyond = asked.most is not None and count > asked.most
        too_many |= beyond
        print(f"{count:4d} objects include {header}" + (f", more than {asked.most}" if beyond else ""))
    return 1 if too_many else 0


if __name__ == "__main__":
    sys.exit(main())
