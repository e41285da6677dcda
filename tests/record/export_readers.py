#!/usr/bin/env python3
"""export_readers.py REACH: what `reach export` writes is opened by each format's own readers (scipy, h5py, pandas; C3D by the rules of its guide),
and every number is compared with the CSV export, bit for bit; C3D holds single precision: the nearest one, in mm for points.

Octave's and R's readers: tests/long/exports.sh."""
import csv
import json
import struct
import subprocess
import sys
import tempfile
import zlib
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


MIXED = Path(__file__).parent / "bids/mixed.json"


def read_log(path):
    """Rows of samples by column, and (kind, target) of each trial, read without the program (docs/recording.md)."""
    data, at, rows, planned = path.read_bytes(), 16, [], []
    while at + 16 <= len(data):
        length, kind, _, _ = struct.unpack_from("<IHHI", data, at)
        payload = data[at + 12:at + 12 + length]
        assert zlib.crc32(data[at:at + 12 + length]) == struct.unpack_from("<I", data, at + 12 + length)[0]
        if kind == 1:
            configuration = json.loads(payload)
        elif kind == 3:
            count, columns = struct.unpack_from("<II", payload)
            rows.append(numpy.frombuffer(payload, dtype=[("tick", "<u8"), ("value", "<f8", columns)], count=count, offset=8)["value"])
        elif kind == 5:
            planned.append(struct.unpack_from("<i", payload, 4)[0])
        at += 16 + length
    scenes = [configuration["scenes"][configuration["trials"][i].get("scene", 0)] for i in planned]
    names = [(channel["column"], channel["name"], channel["tracked_point"]) for channel in configuration["table"]["channels"]]
    return names, numpy.concatenate(rows), [(scene["kind"], scene["target"]) for scene in scenes]


def check_mixed(run, data):
    """A block that mixes kinds: forces on the hand, cursor, kinds and targets are the log's in every format."""
    run("run", MIXED, "--device", "simulated:kind=ofc", "--seed", "1", "--fast", "--data", data)
    for form in ("csv", "mat", "hdf5", "c3d", "bids"):
        run("export", data, "--format", form)
    names, rows, scenes = read_log(next((data / "sourcedata").glob("*_log.reach")))
    assert len(set(scenes)) == 8, scenes
    columns = {column: rows[:, k] for k, (column, _, _) in enumerate(names)}
    assert numpy.abs(columns["environment_z_n"]).max() > 1 and numpy.abs(columns["cursor_z_m"] - columns["hand_z_m"]).max() > 0.02
    derived = data / "derivatives"
    samples, trials = read_csv(next(derived.glob("csv/*_samples.csv"))), read_csv(derived / "csv/trials.csv")
    for column, values in columns.items():
        if column not in ("time_s", "measured_s"):  # of exported files since the first sample
            equal(column_of(samples, column), values, ("csv", column))
    assert [(row["kind"], row["target"]) for row in trials] == scenes
    assert check_mat5(next(derived.glob("mat/*.mat")), samples, trials) == check_hdf5(next(derived.glob("hdf5/*.h5")), samples, trials)
    for k, trial in enumerate(trials):
        c3d = C3d(derived / "c3d" / f"{next(derived.glob('csv/*_samples.csv')).name.removesuffix('_samples.csv')}_trial-{k + 1:03}.c3d")
        assert (c3d.parameters["REACHLAB:KIND"].texts()[0], c3d.parameters["REACHLAB:TARGET"].texts()[0]) == scenes[k]
        begin = float(c3d.parameters["REACHLAB:BEGIN_S"].data)
        first = next(i for i, row in enumerate(samples) if begin <= float(row["time_s"]))
        part = slice(first, first + len(c3d.place))
        for axis, name in enumerate("xyz"):
            assert numpy.array_equal(c3d.place[:, c3d.points.index("cursor"), axis], (1000 * columns[f"cursor_{name}_m"][part]).astype("<f4")), k
            channel = next(c for column, c, _ in names if column == f"environment_{name}_n")
            assert numpy.array_equal(c3d.signal[:, c3d.signals.index(channel)].astype("<f4"), columns[f"environment_{name}_n"][part].astype("<f4")), k
    for events in data.glob("sub-*/ses-*/motion/*_events.tsv"):
        with open(events, newline="", encoding="utf-8") as file:
            told = [row for row in csv.DictReader(file, delimiter="\t") if row["trial_type"] == "reach"]
        assert [(row["kind"], row["target"]) for row in told] == scenes
    print(f"a mixed block: {len(samples)} rows of {len(columns)} columns, kind and target of {len(trials)} trials are the log's in all formats")


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
        check_mixed(run, Path(work) / "mixed")


if __name__ == "__main__":
    main()
