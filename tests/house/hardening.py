#!/usr/bin/env python3
"""Says what of its hardening a program lacks (exit 1): full RELRO, BIND_NOW, PIE, fortified functions, stack canaries, control-flow protection.

    tests/house/hardening.py build/release/cli/reach build/release/gui/reachlab

Control-flow protection is looked for in the code. The mark in the file that has the system enforce it is set only where the C library's own start
files carry it, which those of Debian 12 do not.
"""
import platform
import re
import subprocess
import sys


def told(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def lacks(program):
    segments, dynamic, symbols = (told("readelf", "-W", option, program) for option in ("-l", "-d", "--dyn-syms"))
    now = re.search(r"\(FLAGS\).*\bBIND_NOW\b|\(FLAGS_1\).*\bNOW\b|\(BIND_NOW\)", dynamic) is not None
    if not now:
        yield "BIND_NOW"
    if "GNU_RELRO" not in segments or not now:
        yield "full RELRO"
    if not re.search(r"Type:\s+DYN", told("readelf", "-h", program)):
        yield "a place in memory that is drawn (PIE)"
    if not re.search(r"\b__(?!stack)\w+_chk@", symbols):
        yield "fortified functions (_FORTIFY_SOURCE)"
    if "__stack_chk_fail@" not in symbols:
        yield "stack canaries (-fstack-protector-strong)"
    if platform.machine() == "x86_64" and "endbr64" not in told("objdump", "-d", "--no-show-raw-insn", "--disassemble=main", program):
        yield "control-flow protection (-fcf-protection)"


def main():
    faults = [f"{program}: lacks {what}" for program in sys.argv[1:] for what in lacks(program)]
    print("\n".join(faults) or f"{len(sys.argv) - 1} programs: every hardening is there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main() if len(sys.argv) > 1 else __doc__)
