#!/usr/bin/env python3
"""Two stations and what can happen to them and to the link between them (needs root, for network namespaces):
  station_faults.py BUILD [CASE ...]
Judged by what the logs hold, tick by tick: over a link of 25 +- 2.5 or 50 +- 5 ms each way that loses 5 % the copies keep together; who is
lost ends the trial as peer_lost within 150 ms of its last sample, with zero force from there on; a link that is cut for 30 ms goes on, for
90 ms fades and recovers and is marked; a clock that steps, frames that come twice or once more change nothing; certificates that are not
right, and other versions, are refused before a trial. Every log replays to the bit. Exits 1 otherwise."""
import csv
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from station_log import StationLog
from station_setup import add_station, chain_of

HERE = Path(__file__).resolve().parent
SIDES = ("left", "right")
SLOW = chain_of(2, 6)
SHIM = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/time.h>
#include <time.h>
/* From CLOCK_STEP_AT on (seconds of the monotonic clock) the wall clock is CLOCK_STEP seconds off, as if somebody had set it. */
static long step(void) {
  static int (*real)(clockid_t, struct timespec*);
  if (!real) real = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  struct timespec now;
  real(CLOCK_MONOTONIC, &now);
  const char* at = getenv("CLOCK_STEP_AT");
  return at && now.tv_sec >= atol(at) ? atol(getenv("CLOCK_STEP")) : 0;
}
int clock_gettime(clockid_t which, struct timespec* out) {
  static int (*real)(clockid_t, struct timespec*);
  if (!real) real = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  const int got = real(which, out);
  if (which == CLOCK_REALTIME) out->tv_sec += step();
  return got;
}
int gettimeofday(struct timeval* restrict out, void* restrict zone) {
  (void)zone;
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  out->tv_sec = now.tv_sec, out->tv_usec = now.tv_nsec / 1000;
  return 0;
}
/* The kernel's clock is not set: who waits until a moment of the stepped clock waits until the same moment of the kernel's. */
int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex, const struct timespec* until) {
  static int (*real)(pthread_cond_t*, pthread_mutex_t*, const struct timespec*);
  if (!real) real = (int (*)(pthread_cond_t*, pthread_mutex_t*, const struct timespec*))dlvsym(RTLD_NEXT, "pthread_cond_timedwait", "GLIBC_2.3.2");
  struct timespec at = *until;
  at.tv_sec -= step();
  return real(condition, mutex, &at);
}
time_t time(time_t* out) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (out) *out = now.tv_sec;
  return now.tv_sec;
}
"""
problems = []


def check(good, what):
    print(("  ok    " if good else "  WRONG ") + what, flush=True)
    if not good:
        problems.append(what)


def run(*words, **more):
    return subprocess.run(words, check=True, **more)


class Link:
    """Two namespaces joined by a relay that takes orders."""

    def __init__(self, work):
        tag = os.getpid()
        self.spaces = [f"reachA{tag}", f"reachB{tag}"]
        self.outer = [f"rva{tag}", f"rvb{tag}"]
        relay = work / "link_relay"
        run("g++", "-std=c++20", "-O2", "-o", relay, HERE / "link_relay.cpp")
        for i in range(2):
            run("ip", "netns", "add", self.spaces[i])
            run("ip", "link", "add", self.outer[i], "type", "veth", "peer", "name", self.outer[i] + "n", "netns", self.spaces[i])
            inside = ["ip", "netns", "exec", self.spaces[i]]
            run(*inside, "ip", "addr", "add", f"10.77.0.{i + 1}/24", "dev", self.outer[i] + "n")
            run(*inside, "ip", "link", "set", "lo", "up")
            run(*inside, "ip", "link", "set", self.outer[i] + "n", "up")
            run(*inside, relay, "checksums", self.outer[i] + "n")
            run("ip", "link", "set", self.outer[i], "up")
        self.relay = subprocess.Popen([relay, *self.outer, "1", "0.1", "0"], stdin=subprocess.PIPE, text=True, preexec_fn=urgent)

    def order(self, text):
        self.relay.stdin.write(text + "\n")
        self.relay.stdin.flush()

    def close(self):
        self.relay.kill()
        self.relay.wait()
        for space in self.spaces:
            subprocess.run(["ip", "netns", "del", space], check=False)


def urgent():
    try:
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(30))
    except PermissionError:
        pass


def before_others():
    """The haptic thread and the endpoint have real-time priority; who arms and answers must not wait for a busy computer either."""
    os.nice(-15)


class Pair:
    """One run of two stations; `left` is the conductor."""

    def __init__(self, bench, name, wait=20, experiment=None, trials=None, noise=0, **stations):
        self.folder = bench.work / name
        self.folder.mkdir()
        self.bench, self.processes = bench, {}
        for side, number in (("right", 2), ("left", 1)):
            more = stations.get(side, {})
            words = ["ip", "netns", "exec", bench.link.spaces[number - 1], more.get("reach", bench.reach), "station", experiment or bench.experiment,
                     "--number", str(number), "--device", f"simulated:noise={noise}", "--seed", str(number), "--every-tick", "--wait", str(wait),
                     "--peers", more.get("peers", bench.work / side), "--interface", bench.link.outer[number - 1] + "n",
                     "--peer", f"10.77.0.{3 - number}", "--data", self.folder / side]
            if side == "left":
                words += ["--conductor"] + (["--trials", str(trials)] if trials else [])
            self.processes[side] = subprocess.Popen(words, stdout=open(self.folder / f"{side}.out", "w"), stderr=open(self.folder / f"{side}.err", "w"),
                                                    env={**os.environ, **more.get("environment", {})}, preexec_fn=before_others)

    def text(self, name):
        return (self.folder / name).read_text()

    def first_line(self, name):
        return self.text(name).strip().splitlines()[:1]

    def file_of(self, side, pattern):
        """The first file of a station's dataset by a pattern, or None."""
        return next((self.folder / side).glob(pattern), None)

    def log_path(self, side):
        return self.file_of(side, "sourcedata/*_log.reach")

    def log(self, side):
        return StationLog(self.log_path(side))

    def await_movement(self, side="left", seconds=40):
        """Half a second after the onset."""
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            if self.processes[side].poll() is not None:
                break
            if self.log_path(side) and self.log(side).tick_of(4) is not None:
                time.sleep(0.5)
                return True
            time.sleep(0.05)
        return False

    def end(self, seconds=60):
        """Exit codes."""
        codes = {}
        for side, process in self.processes.items():
            try:
                codes[side] = process.wait(seconds)
            except subprocess.TimeoutExpired:
                process.kill()
                codes[side] = "did not end"
        return codes

    def kill(self, side):
        """The station itself, not the `ip` that started it: that has become it."""
        os.kill(self.processes[side].pid, signal.SIGKILL)

    # What is asked of every log.
    def check_logs(self, killed=()):
        for side in SIDES:
            path = self.log_path(side)
            if path is None:
                check(False, f"{side}: there is a log")
                continue
            log = self.log(side)
            replay = subprocess.run([self.bench.reach, "replay", path, "--check"], capture_output=True, text=True)
            check(replay.returncode == 0, f"{side}: replays to the bit: {replay.stdout.strip().splitlines()[-1:] or replay.stderr.strip()}")
            check(log.closed and log.whole or side in killed, f"{side}: the log lost nothing ({len(log.times)} ticks, {len(log.given)} samples of the other)")

    def forces(self, side):
        """(trial phase, device force) of every tick."""
        motion = self.file_of(side, "sub-*/ses-*/motion/*_motion.tsv")
        with open(str(motion).replace("_motion.tsv", "_channels.tsv")) as file:
            columns = [row["name"] for row in csv.DictReader(file, delimiter="\t")]
        at = [columns.index(f"device_force_{axis}") for axis in "xyz"]
        latency = columns.index("latency")
        with open(motion) as file:
            return {round(1e3 * float(row[latency])): sum(float(row[i]) ** 2 for i in at) ** 0.5 for row in csv.reader(file, delimiter="\t")}

    def check_lost(self, side):
        check("reason=peer_lost" in self.text(side + ".out"), f"{side}: {self.first_line(side + '.out')}")
        log = self.log(side)
        end = log.tick_of(5)
        if end is None or not log.given:
            check(False, f"{side}: the trial ended")
            return
        last = max(g[0] for g in log.given if g[0] < end)
        silence = (log.times[end] - log.times[last]) * 1e-6
        check(silence <= 150 and end - last <= 150, f"{side}: ended {silence:.0f} ms and {end - last} ticks after the last sample")
        forces = self.forces(side)
        check(max(forces.values()) <= 12 and max((f for t, f in forces.items() if t >= end), default=0) == 0,
              f"{side}: force at most {max(forces.values()):.2f} N, and zero from the end on")

    def check_goes_on(self):
        for side in SIDES:
            check("outcome=" in self.text(side + ".out") and "peer_lost" not in self.text(side + ".out"), f"{side}: {self.first_line(side + '.out')}")

    def trials(self, side):
        """Trial -> (whole, share of its ticks that this computer missed)."""
        with open(self.file_of(side, "sub-*/ses-*/motion/*_events.tsv")) as file:
            return {int(row["trial"]): (row["outcome"] in ("success", "failure"), float(row["missed_ticks"]) / (1e3 * float(row["elapsed_s"])))
                    for row in csv.DictReader(file, delimiter="\t") if row["elapsed_s"] != "n/a"}

    def check_together(self, side, bound):
        """Whole trials only: one that ended early proves nothing. Nor does one in which a computer stood still: its copy is then late by that."""
        MOST_MISSED = 0.01
        both = [self.trials(each) for each in SIDES]
        known = [trial for trial in both[0] if trial in both[1] and all(trials[trial][0] for trials in both)]
        whole = {trial for trial in known if all(trials[trial][1] <= MOST_MISSED for trials in both)}
        apart = {}
        for note in self.log(side).notes():
            if found := re.match(r"trial (\d+): copies apart ([\d.e+-]+) m RMS", note):
                apart[int(found[1])] = 1e3 * float(found[2])
        judged = sorted(whole & set(apart))
        check(judged and all(0 < apart[trial] <= bound for trial in judged),
              f"{side}: {len(judged)} whole trials, copies apart {', '.join(f'{apart[trial]:.3f}' for trial in judged)} mm RMS, at most {bound}")
        for trial in sorted(set(known) - whole):
            print(f"        {side}: trial {trial} not judged: {100 * both[0][trial][1]:.1f} and {100 * both[1][trial][1]:.1f} % of the ticks missed, "
                  f"{apart.get(trial, 0):.3f} mm")
        forces = self.forces(side)
        check(len(forces) >= len(self.log(side).times) - 2 and 0.1 < max(forces.values()) <= 12,
              f"{side}: force at most {max(forces.values()):.2f} of 12 N at each of {len(forces)} ticks")

    def told_link(self, side):
        """Round trip [ms], jitter [ms] and loss [%], as the station tells them at its end."""
        found = re.search(r"round trip ([\d.]+) ms, jitter ([\d.]+) ms, loss ([\d.]+) %", self.text(side + ".err"))
        return tuple(float(number) for number in found.groups()) if found else (0.0, 0.0, 0.0)

    def silence(self, side):
        """As the station's own note has it: the oldest sample [ms], ticks at less than the full coupling."""
        for note in self.log(side).notes():
            if found := re.search(r"up to ([\d.e-]+) s old, held by less than their full coupling for (\d+) ticks", note):
                return 1e3 * float(found[1]), int(found[2])
        return None, None

    def discarded(self, side):
        return next((int(found[1]) for note in self.log(side).notes() if (found := re.search(r"network: (\d+) bytes", note))), None)


class Bench:
    def __init__(self, build):
        self.reach = Path(build, "cli/reach").resolve()
        self.work = Path(tempfile.mkdtemp(prefix="station-faults-"))
        self.experiment = self.write("slow.json", SLOW)
        self.make_peers("left", "right")
        self.link = Link(self.work)

    def write(self, name, experiment):
        (self.work / name).write_text(json.dumps(experiment))
        return self.work / name

    def make_peers(self, conductor, other):
        add_station(self.reach, self.work / conductor, self.work / conductor, "left")
        add_station(self.reach, self.work / conductor, self.work / other, "right")

    def copy_peers(self, name):
        return shutil.copytree(self.work / "right", self.work / name)

    def close(self):
        self.link.close()
        if os.environ.get("KEEP"):
            print("kept:", self.work)
        else:
            shutil.rmtree(self.work, ignore_errors=True)

    # Cases.
    def peer_killed(self):
        pair = Pair(self, "peer_killed", 6)
        check(pair.await_movement(), "they move")
        pair.kill("right")
        pair.end()
        pair.check_lost("left")
        pair.check_logs(killed=("right",))

    def conductor_killed(self):
        pair = Pair(self, "conductor_killed", 6)
        check(pair.await_movement("right"), "they move")
        pair.kill("left")
        codes = pair.end()
        pair.check_lost("right")
        check(codes["right"] == 3 and "conductor was not heard of" in pair.text("right.err"), f"right ends and says so: exit {codes['right']}")
        pair.check_logs(killed=("left",))

    def stall(self):
        """A station that stands still for longer than the experiment allows, and not for long enough to be lost: it ends for both."""
        strict = self.write("strict.json", {**SLOW, "timing": {"max_missed_ticks": 100000, "max_gap_s": 0.04}})
        pair = Pair(self, "stall", experiment=strict, trials=1)
        check(pair.await_movement(), "they move")
        os.kill(pair.processes["right"].pid, signal.SIGSTOP)
        time.sleep(0.06)
        os.kill(pair.processes["right"].pid, signal.SIGCONT)
        pair.end()
        for side in SIDES:
            check("outcome=interrupted" in pair.text(side + ".out"), f"{side}: {pair.first_line(side + '.out')}")
            verdicts = [note for note in pair.log(side).notes() if "outcome" in note]
            check(any("outcome interrupted" in note for note in verdicts), f"{side}: {verdicts}")
        pair.check_logs()

    def cut(self, ms):
        pair = Pair(self, f"cut_{ms}")
        check(pair.await_movement(), "they move")
        self.link.order(f"cut {ms}")
        pair.end()
        return pair

    def cut_30(self):
        pair = self.cut(30)
        pair.check_goes_on()
        for side in SIDES:
            oldest, faded = pair.silence(side)
            check(oldest is not None and oldest >= 30 and faded == 0, f"{side}: a sample was {oldest} ms old, and nothing faded ({faded} ticks)")
        pair.check_logs()

    def cut_90(self):
        pair = self.cut(90)
        pair.check_goes_on()
        for side in SIDES:
            oldest, faded = pair.silence(side)
            check(oldest is not None and oldest >= 90 and 0 < faded < 60, f"{side}: marked: a sample was {oldest} ms old, faded for {faded} ticks")
        pair.check_logs()

    def cut_500(self):
        pair = self.cut(500)
        for side in SIDES:
            pair.check_lost(side)
        pair.check_logs()

    def over_a_link(self, delay, jitter, bound, noise=0, trials=3):
        """`delay` +- `jitter` ms each way, 5 % loss; copies apart at most `bound` mm. The chain of five as it is shipped, but that ticks may be late.
        Hands without noise, or the virtual subjects as they are."""
        shipped = json.loads((HERE / "../../resources/experiments/two-hands/chain-two-hands.json").read_text())
        chain = self.write("chain-two-hands.json", {**shipped, "timing": SLOW["timing"]})
        self.link.order(f"link {delay} {jitter} 5")
        pair = Pair(self, f"link_{2 * delay}_{noise}", experiment=chain, trials=trials, noise=noise)
        codes = pair.end()
        self.link.order("link 1 0.1 0")
        check(codes == {"left": 0, "right": 0}, f"exit {codes}")
        for side in SIDES:
            trip, spread, loss = pair.told_link(side)
            check(1.7 * delay < trip < 2.3 * delay, f"{side}: round trip {trip:.1f} ms, jitter {spread:.1f} ms, {loss:.0f} % lost")
            check(loss < 15, f"{side}: what is overtaken is not counted as lost")
            pair.check_together(side, bound)
        pair.check_logs()

    def link_50(self):
        self.over_a_link(25, 2.5, 0.5)

    def link_100(self):
        self.over_a_link(50, 5, 1.5)

    def link_50_noise(self):
        self.over_a_link(25, 2.5, 0.6, noise=1, trials=10)

    def link_100_noise(self):
        self.over_a_link(50, 5, 1.5, noise=1, trials=10)

    def loss_30(self):
        """A link that loses more than the 20 % that are allowed, from the first trial on: that is the last one."""
        pair = Pair(self, "loss_30", wait=8, trials=2)
        check(pair.await_movement(), "they move")
        self.link.order("link 1 0.1 30")
        codes = pair.end()
        self.link.order("link 1 0.1 0")
        found = re.search(r"(\d+) % of what it sends is lost; allowed: up to 20", pair.text("left.err"))
        check(codes["left"] == 3 and pair.log("left").trials == 1, f"left: exit {codes['left']}, {pair.log('left').trials} trial")
        check(found and 20 < int(found[1]) < 45, f"left says how much: {found and found[0]}")
        pair.check_logs()

    def clock_step(self):
        shim, source = self.work / "clock_step.so", self.work / "clock_step.c"
        source.write_text(SHIM)
        run("gcc", "-shared", "-fPIC", "-O2", "-o", shim, source, "-ldl")
        for seconds in (3600, -3600):
            at = int(time.clock_gettime(time.CLOCK_MONOTONIC)) + 7
            pair = Pair(self, f"clock_step_{seconds}",
                        right={"environment": {"LD_PRELOAD": str(shim), "CLOCK_STEP_AT": str(at), "CLOCK_STEP": str(seconds)}})
            moving = pair.await_movement()
            stepped_in = time.clock_gettime(time.CLOCK_MONOTONIC) < at
            pair.end()
            check(moving, f"they move{', and the clock steps under way' if stepped_in else ''}")
            pair.check_goes_on()
            pair.check_logs()

    def repeated(self, name, orders):
        pair = Pair(self, name)
        check(pair.await_movement(), "they move")
        for _ in range(5):
            for order in orders:
                self.link.order(order)
            time.sleep(0.3)
        pair.end()
        self.link.order("twice 0")
        pair.check_goes_on()
        for side in SIDES:
            log = pair.log(side)
            order = [g[3] for g in log.given]
            check(all(b > a for a, b in zip(order, order[1:])), f"{side}: {len(order)} samples, each newer than the one before")
            check((pair.discarded(side) or 0) > 0, f"{side}: counted: {pair.discarded(side)} bytes dropped")
        pair.check_logs()

    def duplicates(self):
        self.repeated("duplicates", ["twice 100"])

    def replays(self):
        self.repeated("replays", ["again"])

    def refused(self, name, wait=8, **right):
        pair = Pair(self, name, wait, right=right)
        codes = pair.end()
        trials = pair.log("left").trials
        check(codes["left"] == 3 and trials == 0, f"left: exit {codes['left']}, {trials} trials: {pair.text('left.err').strip().splitlines()[-1]}")
        check(codes["right"] in (0, 3) and pair.log("right").trials == 0,  # 0: the conductor told it to finish
              f"right: exit {codes['right']}: {pair.text('right.err').strip().splitlines()[-1]}")
        return pair

    def wrong_certificate(self):
        self.make_peers("lab2", "stranger")
        pair = self.refused("wrong_certificate", peers=self.work / "stranger")
        check("station 2: is not there" in pair.text("left.err"), "left does not hear it")

    def expired_certificate(self):
        to = self.copy_peers("expired")
        authority, config = self.work / "left/authority", self.work / "ca.cnf"
        (self.work / "index.txt").write_text("")
        (self.work / "serial").write_text("1000\n")
        config.write_text(f"[ca]\ndefault_ca=c\n[c]\ndatabase={self.work}/index.txt\nserial={self.work}/serial\nnew_certs_dir={self.work}\n"
                          "default_md=sha256\npolicy=p\n[p]\ncommonName=supplied\n")
        run("openssl", "ca", "-batch", "-config", config, "-in", to / "request.pem", "-out", to / "identity.pem", "-notext",
            "-cert", authority / "identity_ca.pem", "-keyfile", authority / "identity_ca_key.pem",
            "-startdate", "20200101000000Z", "-enddate", "20200201000000Z", stderr=subprocess.DEVNULL)
        said = subprocess.run([self.reach, "peers", "list", to], capture_output=True, text=True)
        check("expired" in said.stdout + said.stderr, f"reach peers list: {said.stdout.strip()}")
        self.refused("expired_certificate", peers=to)

    def self_signed_permissions(self):
        to = self.copy_peers("selfsigned")

        def sign(what, change=lambda text: text):
            """The signed text is signed again by the station itself."""
            signed, plain = to / f"{what}.p7s", self.work / f"{what}.xml"
            text = signed.read_text()
            plain.write_text(change(text[text.index("<?xml"):text.index("</dds>") + 6].replace("\r", "")))
            run("openssl", "smime", "-sign", "-in", plain, "-text", "-out", signed, "-signer", to / "identity.pem", "-inkey", to / "key.pem")

        sign("permissions", lambda text: text.replace("reach_*", "*"))
        # Its own software is not what keeps it out: it may believe its own certificate.
        for authority in ("theirs", "its own"):
            if authority == "its own":
                shutil.copy(to / "identity.pem", to / "permissions_ca.pem")
                sign("governance")
            pair = self.refused("selfsigned_" + authority.replace(" ", "_"), peers=to)
            check("station 2: is not there" in pair.text("left.err"), f"left does not hear it (permissions authority: {authority})")

    def other_version(self):
        version = subprocess.run([self.reach, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
        other = "9" * len(version.split(".")[0]) + version[len(version.split(".")[0]):]
        folder = self.work / "other-version"
        folder.mkdir()
        program = folder / "reach"
        program.write_bytes(self.reach.read_bytes().replace(f"reachlab {version}".encode(), f"reachlab {other}".encode()))
        program.chmod(0o755)
        shutil.copy(self.reach.with_name("reachlab-endpoint"), folder)
        pair = self.refused("other_version", reach=program)
        check(f"runs reachlab {other}, and this one reachlab {version}" in pair.text("left.err"), "left says which")


CASES = ["link_50", "link_100", "link_50_noise", "link_100_noise", "loss_30", "peer_killed", "conductor_killed", "stall", "cut_30", "cut_90", "cut_500", "clock_step", "duplicates", "replays", "wrong_certificate",
         "expired_certificate", "self_signed_permissions", "other_version"]


def main():
    if len(sys.argv) < 2 or any(case not in CASES for case in sys.argv[2:]):
        sys.exit(__doc__ + "\nCases: " + " ".join(CASES))
    if os.geteuid() != 0:
        sys.exit("station_faults.py: network namespaces need root")
    bench = Bench(sys.argv[1])
    try:
        for case in sys.argv[2:] or CASES:
            print(case, flush=True)
            getattr(bench, case)()
    finally:
        bench.close()
    print(f"{len(problems)} wrong")
    sys.exit(1 if problems else 0)


main()
