#!/usr/bin/env python3
"""Exits 1 where a program holds a product fused with an alternating sum (vfmaddsub, vfmsubadd): nobody wrote it, g++ 12 puts it there in spite of
-ffp-contract=off, and a processor without it computes other bits (docs/adr/0026-the-same-bits-at-every-level.md).

  tests/house/fused.py PROGRAM...
"""
import re
import subprocess
import sys


def main():
    faults = []
    for program in sys.argv[1:]:
        function, lines = "", 0
        listing = subprocess.Popen(["objdump", "-d", "--no-show-raw-insn", program], stdout=subprocess.PIPE, text=True)
        for line in listing.stdout:
            lines += 1
            if line.endswith(">:\n"):
                function = line.split("<", 1)[1][:-3]
            elif re.search(r"\bvfm(addsub|subadd)\d", line):
                faults.append(f"{program}: {function}")
        if listing.wait() != 0 or lines == 0:
            faults.append(f"{program}: objdump cannot read it")
    print("\n".join(sorted(set(faults))) or f"{len(sys.argv) - 1} programs: nothing is fused that nobody wrote")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
