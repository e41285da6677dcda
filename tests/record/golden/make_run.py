#!/usr/bin/env python3
"""Writes a short recorded run of a release, for golden_test.cpp: run once by the release's own program, never again.

    tests/record/golden/make_run.py build/release/cli/reach tests/record/golden/0.2.0/run_log.reach

Two trials of a simulated hand with two masses on a line. What the computer adds (its name, the compiler, the moment) is taken out, so that the
file says nothing of where it was made.
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
CONFIGURATION, TRIAL, END = 1, 5, 6
SINCE_LINKS = 16  # bytes of a trial behind its links


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
    c.update(computer="Linux", build="g++", started_utc="2026-11-23T00:00:00.000Z")
    return json.dumps(c, indent=1).encode()


def rewritten(log):
    out, place = log[:16], {}
    for sequence, (at, kind, payload) in enumerate(records(log)):
        place[at] = len(out)
        payload = bytearray(nameless(payload) if kind == CONFIGURATION else payload)
        links = {TRIAL: [len(payload) - SINCE_LINKS - 24, len(payload) - SINCE_LINKS - 12], END: [0]}.get(kind, [])
        for link in links:  # offsets of records that stand before this one
            offset, = struct.unpack_from("<Q", payload, link)
            struct.pack_into("<Q", payload, link, place.get(offset, offset))
        out += framed(sequence, kind, bytes(payload))
    return out


def main():
    reach, golden = sys.argv[1], pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as work:
        file = pathlib.Path(work) / "golden.json"
        file.write_text(json.dumps(EXPERIMENT))
        subprocess.run([reach, "run", file, "--device", "simulated", "--trials", "2", "--seed", "7", "--fast", "--data", f"{work}/data"], check=True)
        golden.write_bytes(rewritten(next(pathlib.Path(work).glob("data/sourcedata/*.reach")).read_bytes()))


if __name__ == "__main__":
    main()
