#!/usr/bin/env python3
"""Measures across the way, computed again with pandas from the BIDS files of a dataset alone: deviation_oracle.py REACH

A virtual subject reaches in a curl field and with a rotated cursor. `reach analyze` writes its measures, and this script computes them from
motion.tsv, channels.tsv, events.tsv and experiment.json. They agree to 1e-10."""
import json
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd

from motion_signals import reach, readRun

NORMAL = {"horizontal": [0, 1, 0], "frontal": [0, 0, 1]}
MEASURES = ["max_perpendicular_m", "perpendicular_at_peak_speed_m", "hand_angle_deg", "hand_angle_at_radius_deg"]


def measures_of(base):
    """One row per trial, from the files of one run."""
    rows, events = readRun(f"{base}_motion.tsv")
    folder = Path(base).parents[3] / "code/experiments"
    task = json.loads((folder / (Path(base).name.replace("_tracksys-haptic", "") + "_experiment.json")).read_text())["experiment"]["task"]
    start, target = np.array(task["start"]), np.array(task["target"])
    along = (target - start) / np.linalg.norm(target - start)
    right = np.cross(along, NORMAL[task["plane"]])
    found = []
    for _, event in events.iterrows():
        time = rows["latency"]
        moving = rows[(time >= event["onset"] - 1e-9) & (time <= event["onset"] + event["duration"] + 1e-9)]
        off = moving[["hand_pos_x", "hand_pos_y", "hand_pos_z"]].to_numpy() - start
        speed = np.linalg.norm(moving[["hand_vel_x", "hand_vel_y", "hand_vel_z"]].to_numpy(), axis=1)
        d, s = off @ right, off @ along
        angle = np.degrees(np.arctan2(-d, s))
        fastest = int(np.argmax(speed))
        beyond = np.flatnonzero(np.linalg.norm(off, axis=1) >= np.linalg.norm(target - start))
        found.append([d[np.argmax(np.abs(d))], d[fastest], angle[fastest], angle[beyond[0]] if len(beyond) else np.nan])
    return pd.DataFrame(found, columns=MEASURES)


def main():
    with tempfile.TemporaryDirectory() as folder:
        experiment = Path(folder) / "rotated.json"
        experiment.write_text(json.dumps({
            "schema_version": 1, "constraint": {"name": "free"}, "object": {"kind": "none"},
            "task": {"start": [0.01, 0, 0.02], "target": [0.08, 0, -0.05], "duration_s": 0.6,
                     "tolerance": {"position_m": 0.01, "velocity_m_per_s": 0.05, "time_s": 0.25}},
            "cursor": {"rotation_deg": 30}}))
        field = Path(folder) / "field.json"
        field.write_text(json.dumps({**{k: v for k, v in json.loads(experiment.read_text()).items() if k != "cursor"},
                                     "environment": [{"kind": "viscous", "matrix_n_s_per_m": [[0, 0, 13], [0, 0, 0], [-13, 0, 0]]}]}))
        worst, beyond = 0, 0
        for kind in (experiment, field):
            data, out = f"{folder}/{kind.stem}", f"{folder}/{kind.stem}-out"
            reach("run", kind, "--device", "simulated:kind=ofc", "--trials", "12", "--seed", "3", "--fast", "--data", data)
            reach("analyze", data, "--out", out)
            (base,) = {str(file).removesuffix("_motion.tsv") for file in Path(data).glob("sub-*/ses-*/motion/*_motion.tsv")}
            told = pd.read_csv(f"{out}/trials.csv")
            again = measures_of(base)
            assert len(told) == len(again) == 12, (len(told), len(again))
            for name in MEASURES:
                a, b = told[name].to_numpy(), again[name].to_numpy()
                assert (np.isnan(a) == np.isnan(b)).all(), name
                if "radius" in name:
                    beyond += np.isfinite(a).sum()  # a hand that stops short of the radius has no angle there
                else:
                    assert np.isfinite(a).all(), name
                worst = max(worst, np.max(np.abs(a - b), where=np.isfinite(a), initial=0))
        print(f"{2 * 12} trials, {len(MEASURES)} measures: largest difference {worst:.1e}")
        assert worst <= 1e-10, worst
        assert beyond > 0, "no hand came as far as the target's radius"


if __name__ == "__main__":
    main()
