"""A mass of 1 kg that `reach simulate` lets go on a formula, without a hand."""
import csv
import json
import pathlib
import subprocess


def let_go(program, folder, kind, lines, gravity, at, rate, seconds):
    """Exit code, the words on the standard error, and the last row (None without rows). `at`, `rate`, `seconds`: texts."""
    file = pathlib.Path(folder) / "scene.json"
    file.write_text(json.dumps({"schema_version": 1, "constraint": {kind: lines},
                                "object": {"kind": "point", "masses_kg": [1], "gravity_m_per_s2": [0, gravity, 0]},
                                "coupling": {"stiffness_n_per_m": 600}}))
    ended = subprocess.run([program, "simulate", str(file), "--hand", "none", "--at=" + at, "--rate=" + rate, "--until", seconds, "--every", seconds],
                           capture_output=True, text=True)
    rows = list(csv.DictReader(ended.stdout.splitlines()))
    return ended.returncode, ended.stderr.strip().replace(str(file), "FILE"), rows[-1] if rows else None
