#!/usr/bin/python3
"""Does `reach analyze` name the criterion that a simulated subject planned by, and nobody where there is nothing to name?

`recovery.py BUILD [--alone] [SEED…]` (default 1001 … 1010) records 30 trials of a simulated subject for five experiments, seven truths and each seed.
Every subject is judged alone (section "one person"); then five subjects of one truth together, three of one and two of another, and hands
that ignore the object: a minimum jerk with human scatter, and the human reaches of resources/reaches (--alone: not these three). Prints a line a cell and the sums.
Exit 1 when anybody is decided for a wrong criterion, fewer than 45 % of the sets with ten successes are named, a mixed group is decided,
or a hand that ignores the object is.
"""
import concurrent.futures, csv, json, math, os, pathlib, random, shutil, subprocess, sys, tempfile

EXPERIMENTS = ["chain-slow", "chain-moderate", "chain-fast", "dingwell", "parallel"]
TRUTHS = {  # letter of the subject's label: what the simulated hand plans by
    "a": "min-hand-jerk", "b": "min-torque-change", "c": "min-crackle", "d": "min-hand-crackle", "e": "min-hand-force,hand-mass=1",
    "f": "min-hand-force-change,hand-mass=0", "g": "min-hand-force-change,hand-mass=1"}
CAMPS = [("a", "f"), ("a", "c"), ("b", "f")]  # three subjects by the first, two by the second
FEWEST = 10  # successes

alone = "--alone" in sys.argv
build, seeds = pathlib.Path(sys.argv[1]).resolve(), [int(s) for s in sys.argv[2:] if s != "--alone"] or list(range(1001, 1011))
reach = build / "cli/reach"
reaches = pathlib.Path(__file__).resolve().parents[2] / "resources/reaches"
work = pathlib.Path(tempfile.mkdtemp(prefix="recovery"))


def nameOf(letter):
    return TRUTHS[letter].split(",")[0]


def record(experiment, device, data, subject, trials, seed):
    # A massless hand that jumps may never come to rest: at most a minute and 60 MB a set, the rest of the trials is lost.
    command = [reach, "run", experiment, "--device", device, "--trials", str(trials), "--seed", str(seed), "--fast", "--data", data,
               "--subject", subject]
    subprocess.run(["bash", "-c", 'ulimit -f 60000; exec timeout 60 "$@"', "_", *map(str, command)], capture_output=True)


def analyze(data):
    out = subprocess.run([reach, "analyze", data, "--json"], capture_output=True, text=True)
    return json.loads(out.stdout) if out.returncode == 0 and out.stdout else None


def linked(name, source, subjects):
    folder = work / name / "sourcedata"
    folder.mkdir(parents=True)
    for subject in subjects:
        for log in (source / "sourcedata").glob(f"sub-{subject}_*"):
            (folder / log.name).symlink_to(log)
    return folder.parent


def writeBlindReaches(folder):
    """Minimum jerks of 0.2 m in 1.35 s, duration and pace scattered by 7 %, a slow wave of 4 % on the velocity."""
    folder.mkdir()
    draw = random.Random(1)
    for i in range(40):
        T, wave, phase = 1.35 * (1 + 0.07 * draw.gauss(0, 1)), 0.04 * draw.gauss(0, 1), 2 * math.pi * draw.random()
        with open(folder / f"reach-{i:02}.csv", "w") as f:
            f.write("time_s,x_m,y_m,z_m\n")
            for k in range(0, int(T * 100) + 60):
                s = min(1, k / 100 / T)
                bell = 16 * (s * (1 - s)) ** 3 * 0.05 * wave * math.sin(4 * math.pi * s + phase)
                f.write(f"{k / 100:.2f},{0.2 * s ** 3 * (10 - 15 * s + 6 * s * s) + bell:.9f},0,0\n")


def judgeSets():
    """Every subject alone. Returns {(experiment, letter, seed): (successes, verdict, what was named)}."""
    sets = {}
    for experiment in EXPERIMENTS:
        data = work / experiment
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for letter, truth in TRUTHS.items():
                for seed in seeds:
                    pool.submit(record, experiment, f"simulated:criterion={truth}", data, f"{letter}{seed}", 30, seed)
        study = analyze(data)
        print(f"{experiment}: {len(TRUTHS) * len(seeds)} sets recorded and analysed", file=sys.stderr)
        successes, named = {}, {}
        with open(data / "derivatives/reachlab/success_table.csv", newline="") as f:
            for row in csv.DictReader(f):
                successes[row["subject"]] = int(row["successes"])
        for fit in study["fits"]:
            if fit["decided"]:
                named[fit["subject"]] = [fit["criterion"], *fit["equivalent"]]
        for letter in TRUTHS:
            for seed in seeds:
                who = f"{letter}{seed}"
                n, names = successes.get(who, 0), named.get(who, [])
                verdict = "right" if nameOf(letter) in names else "WRONG" if names else "undecided" if n >= FEWEST else "too few"
                sets[experiment, letter, seed] = n, verdict, names[0] if names else ""
    return sets


def judgeGroups(sets):
    """(experiment, members, right answer or None): conclusion of five subjects."""
    groups = []
    for experiment in EXPERIMENTS:
        enough = {l: [s for s in seeds if sets[experiment, l, s][0] >= FEWEST] for l in TRUTHS}
        for letter, good in enough.items():
            for i in range(0, len(good) - 4, 5):
                groups.append((experiment, [f"{letter}{s}" for s in good[i:i + 5]], nameOf(letter)))
        for first, second in CAMPS:
            if len(enough[first]) >= 3 and len(enough[second]) >= 2:
                groups.append((experiment, [f"{first}{s}" for s in enough[first][:3]] + [f"{second}{s}" for s in enough[second][:2]], None))

    def judge(numbered):
        i, (experiment, members, truth) = numbered
        return experiment, members, truth, analyze(linked(f"group{i}", work / experiment, members))["conclusion"]

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(judge, enumerate(groups)))


def judgeBlind():
    writeBlindReaches(work / "blind")
    out = []
    for experiment in EXPERIMENTS:
        for what, folder in [("minimum jerk", work / "blind"), ("human reaches", reaches)]:
            data = work / f"{experiment}-{what.split()[0]}"
            record(experiment, f"replay:{folder}", data, "01", 40, 1)
            study = analyze(data)
            out.append((experiment, what, study["conditions"][0]["success"], study["conclusion"]))
    return out


def main():
    bad = False
    sets = judgeSets()
    print(f"\nOne person, 30 trials, seeds {seeds[0]} … {seeds[-1]}: named right / undecided / named wrong, and sets with fewer than {FEWEST} successes\n")
    print("| planned by | " + " | ".join(EXPERIMENTS) + " |\n|---|" + "---|" * len(EXPERIMENTS))
    for letter, truth in TRUTHS.items():
        cells = []
        for experiment in EXPERIMENTS:
            v = [sets[experiment, letter, s][1] for s in seeds]
            cells.append(f"{v.count('right')} / {v.count('undecided')} / {v.count('WRONG')}, {v.count('too few')}")
        print(f"| {truth} | " + " | ".join(cells) + " |")
    verdicts = [v[1] for v in sets.values()]
    enough = sum(v[0] >= FEWEST for v in sets.values())
    right, wrong = verdicts.count("right"), verdicts.count("WRONG")
    print(f"\n{len(sets)} sets: {enough} with ten successes, {right} of them named right ({100 * right / max(1, enough):.0f} %), "
          f"{verdicts.count('undecided')} undecided, {wrong} named wrong")
    for (experiment, letter, seed), (n, verdict, named) in sets.items():
        if verdict == "WRONG":
            print(f"WRONG: {experiment}, {TRUTHS[letter]}, seed {seed}: {named} ({n} successes)")
    bad |= wrong > 0 or right < 0.45 * enough
    if alone:
        shutil.rmtree(work)
        return 1 if bad else 0

    results = judgeGroups(sets)
    alike = [r for r in results if r[2]]
    for title, rows in [("Five subjects of one kind", alike), ("Three of one kind and two of another", [r for r in results if not r[2]])]:
        named = [[c["criterion"], *c["equivalent"]] if c["decided"] else [] for *_, c in rows]
        good = sum(truth in names for (_, _, truth, _), names in zip(rows, named))
        wrongly = sum(bool(names) and truth not in names for (_, _, truth, _), names in zip(rows, named))
        print(f"\n{title}: {len(rows)} groups, {good} named right, {len(rows) - good - wrongly} undecided, {wrongly} named wrong")
        for (experiment, members, truth, c), names in zip(rows, named):
            if names and truth not in names:
                print(f"WRONG: {experiment} {' '.join(members)}: {c['sentence']}")
        bad |= wrongly > 0
    print("\nA hand that ignores the object (40 trials):\n\n| experiment | hand | successes | decided | reason |\n|---|---|---|---|---|")
    for experiment, what, n, c in judgeBlind():
        print(f"| {experiment} | {what} | {n} | {'NO: ' + c['criterion'] if c['decided'] else 'no'} | {c['reason']} |")
        bad |= c["decided"]
    shutil.rmtree(work)
    return 1 if bad else 0


sys.stdout.reconfigure(line_buffering=True)  # cells as soon as they are known
sys.exit(main())
