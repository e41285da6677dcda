#!/usr/bin/env python3
"""Writes a short recorded run in each version of the log that there is, for golden_test.cpp: run once when a version is new, never again.

    tests/record/golden_runs/make_runs.py build/release/cli/reach tests/record/golden_runs

Two trials of a simulated hand with two masses on a line. What the computer adds (its name, the compiler, the moment) is put out of it, so that the
files say nothing of where they were made. Version 1 lacks the last two numbers of a trial (docs/recording.md).
"""
import json
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

EXPERIMENT = {
    "schema_version": 1, "name": "golden", "constraint": {"name": "ellipse"},
    "object": {"kind": "chain", "masses_kg": [0.3, 0.2], "stiffness_n_per_m": [400], "damping_n_s_per_m": [3]},
    "coupling": {"stiffness_n_per_m": 500, "damping_n_s_per_m": 10},
    "task": {"start": [0], "target": [1.5], "duration_s": 0.4,
             "tolerance": {"position_m": 0.03, "velocity_m_per_s": 0.5, "time_s": 0.2}},
}
CONFIGURATION, TRIAL, END, SETUP = 1, 5, 6, 7
SINCE_VERSION_2 = 16  # bytes at the end of a trial


def records(log):
    at = 16
    while at < len(log):
        length, kind, _, _ = struct.unpack_from("<IHHI", log, at)
        yield at, kind, log[at + 12:at + 12 + length]
        at += 16 + length


def framed(sequence, kind, payload):
    head = struct.pack("<IHHI", len(payload), kind, 0, sequence) + payload
    return head + struct.pack("<I", zlib.crc32(head))


def nameless(payload):
    c = json.loads(payload)
    c.update(computer="Linux", build="g++", software_version="reachlab 0.1.0", started_utc="2026-11-22T00:00:00.000Z")
    return json.dumps(c, indent=1).encode()


def rewritten(log, version):
    header = b"REACHLOG" + struct.pack("<I", version)
    out, place = header + struct.pack("<I", zlib.crc32(header)), {}
    for sequence, (at, kind, payload) in enumerate(records(log)):
        place[at] = len(out)
        payload = bytearray(nameless(payload) if kind == CONFIGURATION else payload)
        tail = SINCE_VERSION_2 if kind == TRIAL else 0
        links = {TRIAL: [len(payload) - tail - 24, len(payload) - tail - 12], END: [0]}.get(kind, [])
        for link in links:  # offsets of records that stand before this one
            offset, = struct.unpack_from("<Q", payload, link)
            struct.pack_into("<Q", payload, link, place.get(offset, offset))
        if version == 1 and tail:
            del payload[-tail:]
        out += framed(sequence, kind, bytes(payload))
    return out


def main():
    reach, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as work:
        file = pathlib.Path(work) / "golden.json"
        file.write_text(json.dumps(EXPERIMENT))
        subprocess.run([reach, "run", file, "--device", "simulated", "--trials", "2", "--seed", "7", "--fast", "--data", f"{work}/data"], check=True)
        log = next(pathlib.Path(work).glob("data/sourcedata/*.reach")).read_bytes()
    for version in (1, 2):
        (folder / f"run-version-{version}_log.reach").write_bytes(rewritten(log, version))


if __name__ == "__main__":
    main()
