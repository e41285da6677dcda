#!/bin/bash
# The Debian packages in a bare Debian 12: install, first window, first recorded and analysed session, removal without traces. Builds them by
# packaging/deb unless PACKAGES names a folder that has them. Needs what packaging/bare needs.
set -euo pipefail
source=$(realpath "$(dirname "$0")/../..")
[[ $(id -u) == 0 ]] || { echo "packages: needs root for debootstrap and chroot"; exit 1; }
if [[ -z ${PACKAGES:-} ]]; then
  "$source/packaging/deb" > /dev/null
  PACKAGES=$source/build/package/packages
fi
root=$(mktemp -d /var/tmp/reachlab-bare-XXXXXX)
clean_up() { umount "$root/proc" 2> /dev/null || true; rm -rf --one-file-system "$root"; }
trap clean_up EXIT
"$source/packaging/bare" "$root"
mount -t proc proc "$root/proc"
mkdir "$root/packages" "$root/tmp/home" && cp "$PACKAGES"/*.deb "$root/packages/"
inside() { DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 HOME=/tmp/home chroot "$root" "$@"; }  # a person's settings stay, and are no traces
quietly() { inside "$@" > "$root/last.log" 2>&1 || { echo "packages: $* failed"; tail -20 "$root/last.log"; exit 1; }; }
# What is there of ours, and which groups and users there are.
traces() { inside sh -c "find / -xdev \\( -path /proc -o -path /packages -o -path /tmp \\) -prune -o -iname '*reachlab*' -print; cut -d: -f1 /etc/group /etc/passwd; dpkg-query -W -f '\${Package}\\n'" | sort; }

since() { awk -v begin="$1" -v end="$EPOCHREALTIME" 'BEGIN { printf "%.1f s", end - begin }'; }
# Every recording under $1 was made by a program for level $2.
recorded_for() { inside sh -c "test -n \"\$(ls $1/code/experiments)\" && ! grep -L '\"build\": \".*, for $2\"' $1/code/experiments/*_experiment.json | grep ."; }

quietly apt-get update -qq
quietly apt-get install -qq --no-install-recommends adduser xvfb xauth xdotool openmpi-bin  # before the count of traces: not ours
traces > "$root.before"

begin=$EPOCHREALTIME
quietly sh -c "apt-get install -qq --no-install-recommends /packages/reachlab-cli_*.deb"
echo "packages: reachlab-cli installed in $(since "$begin")"
if inside sh -c "dpkg-query -W -f '\${Package}\\n' | grep -E 'qt|vtk'"; then echo "packages: reachlab-cli draws in Qt or VTK"; exit 1; fi
quietly reach --version
begin=$EPOCHREALTIME
quietly sh -c "mkdir /tmp/first && cd /tmp/first && reach run dingwell --device replay:/usr/share/reachlab/reaches --fast && reach analyze data"
echo "packages: the first session recorded and analysed in $(since "$begin")"
inside test -s /tmp/first/data/derivatives/reachlab/report.html
inside getent group reachlab > /dev/null
inside test -s /etc/security/limits.d/reachlab.conf

level=$(inside /lib64/ld-linux-x86-64.so.2 --help | awk '/x86-64-v[234] \(supported/ && !found++ { print $1 }')
recorded_for /tmp/first/data "$level" || { echo "packages: the program for $level is not the one that was started"; exit 1; }
quietly sh -c "cd /tmp/first && REACHLAB_LEVEL=x86-64-v2 reach run chain-moderate --device simulated --trials 2 --fast --data oldest"
recorded_for /tmp/first/oldest x86-64-v2 || { echo "packages: REACHLAB_LEVEL is not obeyed"; exit 1; }
quietly sh -c "reach replay /tmp/first/oldest/sourcedata/*_log.reach --check"
echo "packages: the program for $level was started, and computes what the one for x86-64-v2 recorded"

begin=$EPOCHREALTIME
quietly sh -c "apt-get install -qq --no-install-recommends /packages/reachlab_*.deb /packages/reachlab-doc_*.deb"
echo "packages: reachlab and reachlab-doc installed in $(since "$begin")"
cat > "$root/tmp/window.sh" <<'SH'
cd /tmp
begin=$(date +%s%N)
reachlab parallel --device simulated --trials 1 --data window & window=$!
timeout 60 xdotool search --sync --onlyvisible --name Reachlab > /dev/null || exit 1
echo "packages: the first window stood after $((($(date +%s%N) - begin) / 1000000)) ms"
sleep 20
kill $window || { echo "packages: the window ended by itself"; exit 1; }
SH
inside xvfb-run -a -s '-screen 0 1280x960x24 -noreset' sh /tmp/window.sh > "$root/last.log" 2>&1 || { echo "packages: there was no window"; tail "$root/last.log"; exit 1; }
grep '^packages:' "$root/last.log"
quietly sh -c "cd /tmp && timeout 300 xvfb-run -a reachlab --pictures pictures && ls pictures/*.png"
inside test -s /usr/share/doc/reachlab/html/index.html
quietly sh -c "test -s /usr/share/man/man1/reach-run.1.gz || grep -q path-exclude /etc/dpkg/dpkg.cfg.d/*"

begin=$EPOCHREALTIME
quietly sh -c "apt-get install -qq --no-install-recommends /packages/reachlab-mpi_*.deb"
echo "packages: reachlab-mpi installed in $(since "$begin")"
cat > "$root/tmp/first/ranks.json" <<'JSON'
{"schema_version": 1, "experiment": "chain-moderate", "subjects": 9, "trials": 2, "chunk_trials": 4, "vary": {"subject.noise": [0.5, 1]}}
JSON
quietly sh -c "cd /tmp/first && mpirun --allow-run-as-root --oversubscribe -n 2 reach-mpi ranks.json --out ranks && reach study ranks.json --out one"
quietly sh -c "cd /tmp/first && for table in trials.csv.gz trials.h5 trials.json; do cmp ranks/\$table one/\$table || exit 1; done"
echo "packages: two ranks of reach-mpi give the bytes of reach study"

quietly apt-get purge -qq --autoremove reachlab reachlab-cli reachlab-mpi reachlab-doc
traces > "$root.after"
diff "$root.before" "$root.after" || { echo "packages: traces are left (above)"; rm -f "$root.before" "$root.after"; exit 1; }
rm -f "$root.before" "$root.after"
echo "packages: installed, run and removed without traces in a bare Debian 12"
