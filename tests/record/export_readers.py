#!/usr/bin/env python3
"""export_readers.py REACH: what `reach export` writes is opened by each format's own readers (scipy, h5py, pandas; C3D by the rules of its guide),
and every number is compared with the CSV export, bit for bit; C3D holds single precision: the nearest one, in mm for points.

Octave's and R's readers: tests/long/exports.sh."""
import csv
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy
import pandas
import scipy.io

sys.path.insert(0, str(Path(__file__).parent))
from c3d_reader import C3d  # noqa: E402

NOTE = "Übung α 𝛽: \"quoted\", und so weiter"


def equal(a, b, what):
    a, b = numpy.asarray(a, dtype=float).ravel(), numpy.asarray(b, dtype=float).ravel()
    assert a.shape == b.shape, (what, a.shape, b.shape)
    assert numpy.array_equal(a, b, equal_nan=True), (what, a[:3], b[:3])


def column_of(table, name):
    """A CSV column: numbers where every cell is one (or empty), else texts."""
    cells = [row[name] for row in table]
    try:
        return [float(c) if c else numpy.nan for c in cells]
    except ValueError:
        return cells


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


TEXTS = {"subject", "session", "phase", "condition", "kind", "target", "outcome", "reason", "by_unit", "experiment", "seed", "device", "sex", "handedness", "notes"}


def same_trials(expected, column, what):
    """`column(name)`: a list of numbers or of texts."""
    for name in expected[0]:
        if name in TEXTS:
            assert column(name) == [row[name] for row in expected], (what, name, column(name))
        else:
            equal(column(name), column_of(expected, name), (what, name))


def check_mat5(path, samples, trials):
    mat = scipy.io.loadmat(path, squeeze_me=False)
    for name in samples[0]:
        equal(mat[name], column_of(samples, name), ("mat", name))
        assert mat[name].shape == (len(samples), 1), (name, mat[name].shape)
    table = mat["trials"][0, 0]

    def column(name):
        values = table[name]
        return [str(v[0]) if v.size else "" for v in values.ravel()] if values.dtype == object else values
    # What is not in the basic plane has no place in a version 5 file that scipy can read.
    same_trials([{**row, "notes": row["notes"].replace("𝛽", "\ufffd")} for row in trials], column, "mat")
    assert mat["units"][0, 0]["hand_x_m"][0] == "m"
    assert "CLOCK" in str(mat["clock"][0]) or "virtual clock" in str(mat["clock"][0])
    events = mat["events"][0, 0]
    kinds = [str(v[0]) for v in events["event"].ravel()]
    assert kinds.count("trial_start") == len(trials), kinds
    return list(events["time_s"].ravel()), kinds


def check_hdf5(path, samples, trials):
    with h5py.File(path, "r") as file:
        frame = pandas.DataFrame({name: item[()] for name, item in file["samples"].items()})
        assert set(frame.columns) == set(samples[0])
        for name in frame:
            equal(frame[name], column_of(samples, name), ("hdf5", name))
        assert file["samples/hand_vx_m_per_s"].attrs["units"] == "m/s"
        assert file["samples/hand_x_m"].attrs["description"]

        def column(name):
            item = file["trials"][name]
            return list(item.asstr()[()]) if h5py.check_string_dtype(item.dtype) else item[()]
        same_trials(trials, column, "hdf5")
        assert "clock" in file.attrs["clock"]
        json.loads(file["experiment_json"].asstr()[0])
        return list(file["events/time_s"][()]), list(file["events/event"].asstr()[()])


def check_c3d(path, samples, trial):
    """The frames of one trial are the rows between its start and its end."""
    c3d = C3d(path)
    rows = [row for row in samples if row["trial"] == trial["trial"] and float(trial["start_s"]) <= float(row["time_s"])]
    assert c3d.rate == 100 and c3d.unit == "mm"
    begin = float(c3d.parameters["REACHLAB:BEGIN_S"].data)
    rows = [row for row in rows if begin <= float(row["time_s"])][:len(c3d.place)]
    assert len(rows) == len(c3d.place) > 20, (len(rows), len(c3d.place))
    assert c3d.points[:3] == ["hand", "device", "mass1"]
    for k, point in enumerate(c3d.points):
        for axis, name in enumerate("xyz"):
            expected = (1000 * numpy.array([float(row[f"{point}_{name}_m"]) for row in rows])).astype("<f4")
            assert numpy.array_equal(c3d.place[:, k, axis], expected), (path, point, name)
    assert c3d.seen.all()
    by_channel = {"coupling_force_x": "coupling_x_n", "hand_vel_y": "hand_vy_m_per_s", "energy": "energy_j", "phase": "phase"}
    for channel, column in by_channel.items():
        expected = numpy.array([float(row[column]) for row in rows]).astype("<f4")
        assert numpy.array_equal(c3d.signal[:, c3d.signals.index(channel)].astype("<f4"), expected), (path, channel)
    assert c3d.signal_units[c3d.signals.index("coupling_force_x")] == "N"
    for event, column in {"go": "go_s", "onset": "task_onset_s", "end": "end_s"}.items():
        if trial[column]:
            assert abs(c3d.events[event] - (float(trial[column]) - begin)) < 1e-5, (event, c3d.events)
    assert c3d.parameters["REACHLAB:OUTCOME"].texts()[0] == trial["outcome"]


def main():
    reach = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as work:
        data = Path(work) / "data"

        def run(*arguments):
            return subprocess.run([reach, *map(str, arguments)], check=True, capture_output=True, text=True).stdout
        for experiment in ("chain-moderate", "torus"):
            run("run", experiment, "--device", "simulated", "--trials", "3", "--seed", "1", "--fast", "--data", data, "--notes", NOTE, "--age", "30.5")
        written = {}
        for form in ("csv", "mat", "hdf5", "c3d"):
            written[form] = run("export", data, "--format", form).split("\n")
            description = json.loads((data / "derivatives" / form / "dataset_description.json").read_text())
            assert description["DatasetType"] == "derivative" and description["GeneratedBy"][0]["Name"] == "reachlab", description
        all_trials = read_csv(data / "derivatives/csv/trials.csv")
        runs = sorted((data / "derivatives/csv").glob("*_samples.csv"))
        assert len(runs) == 2
        for path in runs:
            name = path.name.removesuffix("_samples.csv")
            samples = read_csv(path)
            trials = [row for row in all_trials if name.endswith(f"run-{int(row['run']):02}")]
            assert len(trials) == 3 and trials[0]["notes"] == NOTE
            times = check_mat5(data / "derivatives/mat" / (name + ".mat"), samples, trials)
            assert check_hdf5(data / "derivatives/hdf5" / (name + ".h5"), samples, trials) == times
            for trial in trials:
                check_c3d(data / "derivatives/c3d" / f"{name}_trial-{int(trial['trial']):03}.c3d", samples, trial)
            print(f"{name}: {len(samples)} rows of {len(samples[0])} columns and 3 trials read the same from mat, hdf5 and c3d")


if __name__ == "__main__":
    main()
