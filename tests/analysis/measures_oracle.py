#!/usr/bin/python3
"""Every measure of `reach analyze` against numpy, scipy and pandas, from logs and from BIDS files alike. $1 is the program `reach`.

Signals come from the BIDS motion files, measures are computed here from their definitions (docs/analysis.md), and compared to 1e-10.
"""
import math, pathlib, shutil, sys, tempfile

import numpy as np
import pandas as pd
from scipy import signal, stats

from motion_signals import RATE, differentiate, lowPass, reach, readRun, readTable, sampled

TOLERANCE, SHARE = 1e-10, 0.05
worst = {}


def same(what, got, wanted):
    if pd.isna(got) and (wanted is None or math.isnan(wanted)):
        return
    apart = abs(got - wanted) / max(1.0, abs(wanted)) if wanted is not None and not pd.isna(got) else math.inf
    worst[what] = max(worst.get(what, 0.0), apart)


def movementIn(speed, rate):
    """(onset, offset, peak, time of the peak): 5 % of the peak, searched back from the first hump, the last stretch of 40 ms."""
    top = int(np.argmax(speed))
    peak, at = speed[top], float(top)
    if 0 < top < len(speed) - 1:
        at += 0.5 * (speed[top - 1] - speed[top + 1]) / (speed[top - 1] - 2 * speed[top] + speed[top + 1])
    level = SHARE * peak
    above = speed >= level
    hump = int(np.argmax(speed >= max(level, peak / 2)))
    begin = hump
    while begin > 0 and above[begin - 1]:
        begin -= 1
    cross = lambda i: (i + (level - speed[i]) / (speed[i + 1] - speed[i])) / rate
    onset = cross(begin - 1) if begin else 0.0
    offset, i = 0.0, begin
    while i < len(speed):
        if not above[i]:
            i += 1
            continue
        end = i
        while end < len(speed) and above[end]:
            end += 1
        if end - i >= max(1.0, 0.04 * rate) or i == begin:
            offset = (len(speed) - 1) / rate if end == len(speed) else cross(end - 1)
        i = end
    return onset, offset, peak, at / rate


def instants(onset, offset):
    return onset + np.linspace(0, 1, 101) * (offset - onset)


def sparc(speed):
    n = len(speed)
    bins = int(2 ** (math.ceil(math.log2(n)) + 4))
    f = np.arange(bins) * RATE / bins
    m = np.abs(np.fft.fft(speed, bins))
    m = m / m.max()
    keep = f <= 10.0
    f, m = f[keep], m[keep]
    inside = np.flatnonzero(m >= 0.05)
    f, m = f[inside[0] : inside[-1] + 1], m[inside[0] : inside[-1] + 1]
    return -np.sum(np.hypot(np.diff(f) / (f[-1] - f[0]), np.diff(m)))


def ldlj(speed):
    jerk = np.diff(speed, 2) * RATE**2
    return -math.log((len(speed) / RATE) ** 3 / speed.max() ** 2 * np.sum(jerk**2) / RATE)


def measure(rows, event, straight):
    begin = rows["latency"].iloc[0]
    tick = lambda seconds: round((seconds + begin) * 1000)
    armed, end = tick(event.armed), tick(event.onset + event.duration)
    ticks = (rows["latency"] * 1000).round().astype(int)
    r = rows[(ticks >= armed) & (ticks <= end)]
    since = lambda t: (t - armed) / 1000
    first, taskEnd, taskOnset = since(ticks[r.index[0]]), since(end), since(tick(event.onset))
    three = lambda what: r[[f"{what}_{axis}" for axis in "xyz"]].to_numpy()
    masses = max(int(c[4:-6]) for c in rows.columns if c.startswith("mass") and c.endswith("_pos_x"))
    hand, last = three("hand_pos"), three(f"mass{masses}_pos")
    velocity = lowPass(differentiate(hand), RATE)
    speed = np.linalg.norm(velocity, axis=1)
    along = velocity @ [1, 0, 0] if straight else speed
    object = three(f"mass{masses}_vel") @ [1, 0, 0]
    cells = max(0, math.ceil((taskEnd - first) * RATE - 1e-9))
    if len(speed) == cells:  # the trial ends between two rows
        speed, along, object = (np.append(x, 2 * x[-1] - x[-2]) for x in (speed, along, object))
    speed[-1] = max(0.0, speed[-1])
    onset, offset, peak, top = movementIn(speed[: cells + 1], RATE)
    offset = min(offset, taskEnd - first)
    a, b = (int(min(max(math.floor(t * RATE + 0.5), 0), len(speed) - 1)) for t in (onset, offset))
    part = speed[a : b + 1]
    out = dict(onset_s=first + onset, offset_s=first + offset, duration_s=offset - onset, movement_time_s=taskEnd - taskOnset,
               reaction_time_s=first + onset - since(tick(event.go)), peak_speed_m_per_s=peak, time_to_peak_s=top - onset,
               time_to_peak_percent=100 * (top - onset) / (offset - onset), symmetry_ratio=(top - onset) / (offset - top),
               path_length_m=np.trapz(part, dx=1 / RATE), speed_peaks=len(signal.find_peaks(part, prominence=0.05 * part.max())[0]),
               sparc=sparc(part), ldlj=ldlj(part), peak_force_n=event.peak_force, mean_force_n=event.mean_force)
    if straight:
        target = np.array([0.1, 0, 0])
        way = np.array([0.2, 0, 0])
        atEnd = int(min(max(math.floor((taskEnd - first) * RATE + 0.5), 0), len(last) - 1))
        out |= dict(hand_endpoint_error_m=np.linalg.norm(hand[min(b, len(hand) - 1)] - hand[0] - way),
                    object_endpoint_error_m=np.linalg.norm(last[atEnd] - target),
                    hand_overshoot_m=max(0.0, (hand - hand[0] - way)[:, 0].max()), object_overshoot_m=max(0.0, (last - target)[:, 0].max()))
    level = np.interp(offset * RATE, np.arange(len(speed)), speed) / peak
    at = instants(onset, offset)
    return out, (sampled(along, RATE, at), sampled(object, RATE, at), offset - onset, level)


class Prediction:
    """A criterion's hand (filtered as the recording) and last mass (not filtered) at 1 kHz, with rest on either side."""

    def __init__(self, experiment, criterion, T, folder):
        steps = max(2, math.ceil(T * 1000))
        file = folder / "prediction.csv"
        reach("predict", experiment, "--criterion", criterion, "--samples", steps + 1, "--out", file)
        table = pd.read_csv(file)
        self.rate = steps / T
        pad = lambda x: np.concatenate([np.zeros(300), x, np.zeros(300)])
        self.hand = lowPass(pad(table["hand_m_per_s"].to_numpy()), self.rate)
        self.object = pad(table[[c for c in table.columns if c.endswith("_m_per_s") and c.startswith("mass")][-1]].to_numpy())
        self.onset, _, self.peak, _ = movementIn(np.abs(self.hand), self.rate)
        self.peak = np.abs(self.hand).max()

    def errors(self, profile):
        hand, object, duration, level = profile
        speed, threshold = np.abs(self.hand), level * self.peak
        i = np.flatnonzero(speed > threshold)[-1]
        end = (i + (speed[i] - threshold) / (speed[i] - speed[i + 1])) / self.rate
        T = end - self.onset
        rms = lambda predicted, measured: math.sqrt(np.mean((predicted - measured * duration / T) ** 2))
        at = instants(self.onset, end)
        return rms(sampled(self.hand, self.rate, at), hand), rms(sampled(self.object, self.rate, at), object)


def logitOf(s, f):
    return math.log((s + 0.5) / (f + 0.5)), 1 / (s + 0.5) + 1 / (f + 0.5)


def peopleMean(values, variances):
    """(mean, low, high, p): t over people, never narrower than their own variances allow."""
    n, mean = len(values), np.mean(values)
    own = math.sqrt(sum(variances)) / n
    se = stats.sem(values)
    half = max(stats.t.ppf(0.975, n - 1) * se, stats.norm.ppf(0.975) * own)
    p = max(2 * stats.t.sf(abs(mean) / se, n - 1) if se > 0 else (1.0 if mean == 0 else 0.0), 2 * stats.norm.sf(abs(mean) / own))
    return mean, mean - half, mean + half, p


def checkTrials(data, out, folder):
    trials = readTable(out / "trials.csv").set_index(["condition", "subject", "session", "run", "trial"])
    predictions = {c: Prediction("chain-moderate", c, 1.35, folder) for c in ("min-hand-jerk", "min-crackle")}
    profiles, checked = {}, 0
    for motion in sorted(data.glob("sub-*/ses-*/motion/*_motion.tsv")):
        rows, events = readRun(motion)
        label = {p.split("-")[0]: p.split("-")[1] for p in motion.name.split("_") if "-" in p}
        condition = {"chainmoderate": "chain-moderate", "ellipse": "ellipse"}[label["task"]]
        for event in events.itertuples():
            row = trials.loc[condition, label["sub"], label["ses"], int(label["run"]), event.trial]
            wanted, profile = measure(rows, event, condition == "chain-moderate")
            for column, value in wanted.items():
                same(column, row[column], value)
            checked += 1
            if condition != "chain-moderate" or row["used"] != 1:
                continue
            profiles[(label["sub"], event.trial, label["ses"])] = profile
            for criterion, prediction in predictions.items():
                hand, object = prediction.errors(profile)
                name = criterion.replace("-", "_")
                same("epsilon_hand", row[f"epsilon_hand_{name}_m_per_s"], hand)
                same("epsilon_object", row[f"epsilon_object_{name}_m_per_s"], object)
    if checked < 40 or len(profiles) < 20:
        sys.exit(f"only {checked} trials, {len(profiles)} used: too few to say anything")
    used = trials.loc["chain-moderate"].query("used == 1")
    mean = used["duration_s"].mean()
    c = readTable(out / "conditions.csv").set_index("condition").loc["chain-moderate"]
    for column, value in [("mean_duration_s", mean), ("sd_duration_s", used["duration_s"].std()), ("mean_movement_time_s", used["movement_time_s"].mean()),
                          ("least_movement_time_s", used["movement_time_s"].min()), ("largest_movement_time_s", used["movement_time_s"].max())]:
        same(column, c[column], value)
    table = readTable(out / "mean_profiles.csv").query("condition == 'chain-moderate'")
    for k, what in enumerate(["hand", "object"]):
        scaled = np.array([p[k] * p[2] / mean for p in profiles.values()])
        for i in range(101):
            same("mean_profiles", table[f"{what}_mean_m_per_s"].iloc[i], scaled[:, i].mean())
            same("mean_profiles", table[f"{what}_sd_m_per_s"].iloc[i], scaled[:, i].std(ddof=1))
    series = readTable(out / "series.csv").query("condition == 'chain-moderate' and criterion == 'min-crackle'")
    for row in series.itertuples():
        own = used.reset_index().query(f"subject == '{row.subject}' and session == '{row.session}'")
        same("series", row.epsilon_m_per_s, math.sqrt((own[f"epsilon_{row.signal}_min_crackle_m_per_s"] ** 2).mean()))
    rank = readTable(out / "ranking.csv").query("condition == 'chain-moderate' and signal == 'hand'").set_index("criterion")
    e = {c: used.groupby("subject")[f"epsilon_hand_{c.replace('-', '_')}_m_per_s"].apply(lambda x: math.sqrt((x**2).mean())) for c in rank.index}
    best = rank.index[0]
    for criterion, row in rank.iterrows():
        x = e[criterion]
        half = stats.t.ppf(0.975, len(x) - 1) * stats.sem(x)
        same("ranking", row.epsilon_low_m_per_s, x.mean() - half)
        same("ranking", row.epsilon_high_m_per_s, x.mean() + half)
        if criterion != best:
            d = x - e[best]
            half = stats.t.ppf(1 - 0.025 / (len(rank) - 1), len(d) - 1) * stats.sem(d)
            same("ranking", row.difference_low_m_per_s, d.mean() - half)
            same("ranking", row.difference_high_m_per_s, d.mean() + half)


def checkSuccess(out):
    attempts = readTable(out / "trials.csv").query("outcome in ['success', 'failure']").copy()
    attempts["won"] = (attempts.outcome == "success").astype(int)
    cells = {}
    for row in readTable(out / "success_table.csv").itertuples():
        won = attempts.query(f"subject == '{row.subject}' and day == {row.day} and condition == '{row.condition}'").won
        ci = stats.binomtest(int(won.sum()), len(won)).proportion_ci(0.95, "exact")
        for got, wanted in [(row.successes, won.sum()), (row.low_percent, 100 * ci.low), (row.high_percent, 100 * ci.high)]:
            same("success_table", got, wanted)
        cells[row.subject, row.condition, row.day] = int(won.sum()), int(len(won) - won.sum())
    for row in readTable(out / "learning.csv").itertuples():
        won = attempts.query(f"subject == '{row.subject}' and condition == '{row.condition}'").won.to_numpy()[row.first_trial - 1 : row.last_trial]
        ci = stats.binomtest(int(won.sum()), len(won)).proportion_ci(0.95, "exact")
        same("learning", row.low_percent, 100 * ci.low)
        same("learning", row.high_percent, 100 * ci.high)
    share = lambda s, f: ((s + 0.5) * (f + 0.5) / (s + f + 1) ** 2) / (s + f)
    subjects = sorted(attempts.subject.unique())
    effects = readTable(out / "effects.csv")
    day = effects.query("effect == 'day' and condition == 'chain-moderate'").iloc[0]
    pairs = [(cells[s, "chain-moderate", 1], cells[s, "chain-moderate", 2]) for s in subjects]
    points = peopleMean([100 * (b[0] / sum(b) - a[0] / sum(a)) for a, b in pairs], [1e4 * (share(*a) + share(*b)) for a, b in pairs])
    logits = peopleMean([logitOf(*b)[0] - logitOf(*a)[0] for a, b in pairs], [logitOf(*b)[1] + logitOf(*a)[1] for a, b in pairs])
    for column, value in [("difference_percent", points[0]), ("low_percent", points[1]), ("high_percent", points[2]), ("odds_ratio", math.exp(logits[0])),
                          ("odds_ratio_low", math.exp(logits[1])), ("odds_ratio_high", math.exp(logits[2])), ("p", logits[3])]:
        same("effects", day[column], value)
    slope = effects.query("effect == 'slope' and condition == 'chain-moderate'").iloc[0]
    values, variances = [], []
    for s in subjects:
        won = attempts.query(f"subject == '{s}' and condition == 'chain-moderate'").won.to_numpy()
        x = np.arange(len(won)) - (len(won) - 1) / 2
        values.append(1e4 * stats.linregress(x, won).slope)
        variances.append(1e8 * share(won.sum(), len(won) - won.sum()) * len(won) / np.sum(x**2))
    line = peopleMean(values, variances)
    for column, value in [("difference_percent", line[0]), ("low_percent", line[1]), ("high_percent", line[2]), ("p", line[3])]:
        same("slope", slope[column], value)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        data, bare = folder / "data", folder / "bare"
        for subject in (1, 2, 3):
            for session in (1, 2):
                reach("run", "chain-moderate", "--device", "simulated", "--trials", 10 if session == 1 else 7, "--seed", 10 * subject + session,
                      "--fast", "--data", data, "--subject", f"0{subject}", "--session", f"0{session}")
        reach("run", "ellipse", "--device", "simulated", "--trials", 4, "--seed", 5, "--fast", "--data", data, "--subject", "01", "--session", "01")
        criteria = [x for c in ("min-hand-jerk", "min-crackle", "min-hand-force-change") for x in ("--criterion", c)]
        logs, bids = folder / "logs", folder / "bids"
        reach("analyze", data, "--out", logs, *criteria)
        shutil.copytree(data, bare, ignore=shutil.ignore_patterns("sourcedata", "derivatives"))
        reach("analyze", bare, "--out", bids, *criteria)
        tables = sorted(p.name for p in logs.glob("*.csv"))
        for table in tables:
            if (logs / table).read_bytes() != (bids / table).read_bytes():
                sys.exit(f"{table} differs between logs and BIDS files")
        checkTrials(bare, bids, folder)
        checkSuccess(logs)
    for what, apart in sorted(worst.items(), key=lambda e: -e[1]):
        print(f"{apart:9.1e}  {what}")
    bad = [what for what, apart in worst.items() if not apart <= TOLERANCE]
    print(f"{len(tables)} tables are the same bytes from logs and from BIDS files; {len(worst) - len(bad)} of {len(worst)} measures agree to {TOLERANCE}")
    return 1 if bad else 0


sys.exit(main())
