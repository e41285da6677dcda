#!/usr/bin/env python3
"""A study over 2 and 3 MPI ranks gives the bytes of one process: study_mpi.py REACH REACH_MPI MPIEXEC"""
import subprocess
import sys
import tempfile
from pathlib import Path

REACH, REACH_MPI, MPIEXEC = sys.argv[1:4]
STUDY = """{"schema_version": 1, "name": "ranks", "experiment": "chain-moderate", "subjects": 9, "trials": 2, "chunk_trials": 4,
  "vary": {"subject.noise": [0.5, 1]}}"""


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def tables(folder):
    return [(folder / name).read_bytes() for name in ("trials.csv.gz", "trials.h5", "trials.json")]


def ranks(count, *arguments):
    return [MPIEXEC, "--oversubscribe", "--allow-run-as-root", "-n", str(count), REACH_MPI, *map(str, arguments)]


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        study = folder / "ranks.json"
        study.write_text(STUDY)
        run(REACH, "study", study, "--out", folder / "one")
        for count in (1, 2, 3):
            run(*ranks(count, study, "--out", folder / f"of{count}"))
            assert tables(folder / f"of{count}") == tables(folder / "one"), f"{count} ranks give other bytes"
        # A share by hand, the rest by ranks.
        run(REACH, "study", study, "--out", folder / "both", "--shard", "2/3")
        again = subprocess.run(ranks(2, study, "--out", folder / "both"), capture_output=True, text=True, check=False)
        assert again.returncode != 0 and "--resume" in again.stderr, again.stderr
        run(*ranks(2, study, "--out", folder / "both", "--resume"))
        assert tables(folder / "both") == tables(folder / "one"), "ranks that go on give other bytes"
        # A fault on one rank ends all.
        bad = folder / "bad.json"
        bad.write_text(STUDY.replace("[0.5, 1]", "[0.5, 11]"))
        ended = subprocess.run(ranks(2, bad, "--out", folder / "bad"), capture_output=True, text=True, check=False, timeout=60)
        assert ended.returncode != 0 and "noise=11" in ended.stderr, ended.stderr


if __name__ == "__main__":
    main()
