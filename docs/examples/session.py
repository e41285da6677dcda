"""Reachlab's CSV export in pandas: python3 session.py FOLDER [PREDICTION.csv]

FOLDER is what `reach export DATASET --format csv --out FOLDER` wrote; PREDICTION.csv is of `reach predict EXPERIMENT --criterion C`."""
import sys
from pathlib import Path

import numpy as np
import pandas as pd

folder = Path(sys.argv[1])

# 1. The trials. Labels are text: read as numbers, subject 01 would become 1, and pandas would take a condition "null" for no value.
trials = pd.read_csv(folder / "trials.csv", dtype={"subject": str, "session": str}, keep_default_na=False, na_values=[""])
trials = trials[(trials.phase == "recorded") & (trials.catch_trial == 0) & trials.outcome.isin(["success", "failure"])]

# 2. Success, as in the paper's Table 2. Aborted and interrupted trials are no attempts.
by = ["subject", "session", "condition"]
success = (trials.outcome == "success").groupby([trials[k] for k in by])
table = pd.DataFrame({"successes": success.sum(), "trials": success.count(), "percent": 100 * success.mean()}).reset_index()
print("subject session condition successes trials percent")
for row in table.itertuples():
    print(f"{row.subject} {row.session} {row.condition} {row.successes} {row.trials} {row.percent:.1f}")

# 3. Movement times of the successful trials.
good = trials[trials.outcome == "success"]
print("condition mean_s sd_s")
for condition, times in good.groupby("condition").movement_time_s:
    print(f"{condition} {times.mean():.4f} {times.std():.4f}")

# 4. The hand's velocity along the way of every successful trial, from onset to end, at 101 instants, scaled to the mean movement time.
profiles = []
for (subject, session, run), rows in good.groupby(["subject", "session", "run"]):
    file = next(folder.glob(f"sub-{subject}_ses-{session}_*_run-{run:02d}_samples.csv"))
    samples = pd.read_csv(file)
    for trial in rows.itertuples():
        time = np.linspace(trial.task_onset_s, trial.end_s, 101)
        at = lambda column: np.interp(time, samples.time_s, samples[column])
        places = np.array([at(f"hand_{axis}_m") for axis in "xyz"])
        way = places[:, -1] - places[:, 0]
        velocity = way @ np.array([at(f"hand_v{axis}_m_per_s") for axis in "xyz"]) / np.linalg.norm(way)
        profiles.append(velocity * trial.movement_time_s / good.movement_time_s.mean())
mean = np.mean(profiles, axis=0)
print(f"hand: peak of the mean profile {mean.max():.4f} m/s at {mean.argmax()} %, {len(profiles)} trials")

# 5. Against a prediction, the paper's epsilon over all samples. `reach analyze` does the same after filtering and with the onset rule
#    of docs/analysis.md; the numbers differ by that.
if len(sys.argv) > 2:
    prediction = pd.read_csv(sys.argv[2])
    duration = prediction.time_s.iloc[-1]
    expected = np.interp(np.linspace(0, duration, 101), prediction.time_s, prediction.hand_m_per_s) * duration / good.movement_time_s.mean()
    print(f"epsilon {np.sqrt(np.mean((np.array(profiles) - expected) ** 2)):.4f} m/s")
