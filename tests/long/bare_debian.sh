#!/bin/bash
# From nothing to a first result in a bare Debian 12 (SUITE=trixie: Debian 13): a table of wall and processor time for install, build, first
# result, tests and packages, of a clone as root. Then the same first result under worse conditions: from the tarball, in a folder with spaces,
# parentheses and an umlaut, by a user with sudo, with German settings, and without network once everything is installed. Needs what
# packaging/bare needs, and takes hours.
#   tests/long/bare_debian.sh [STEP...]     only these steps: first, tests, packages, user (all unless named; tests and packages need first)
set -euo pipefail
source=$(realpath "$(dirname "$0")/../..")
steps=" ${*:-first tests packages user} "
wanted() { [[ $steps == *" $1 "* ]]; }
root=$(mktemp -d /var/tmp/reachlab-bare-XXXXXX)
clean_up() { umount "$root/dev/pts" "$root/dev/shm" "$root/proc" 2> /dev/null || true; rm -rf --one-file-system "$root"; }
trap clean_up EXIT
chmod 755 "$root"  # a user other than root goes through it
"$source/packaging/bare" "$root" "${SUITE:-bookworm}"
mount -t proc proc "$root/proc"
mkdir -p "$root/dev/shm" && mount -t tmpfs shm "$root/dev/shm"
mkdir -p "$root/dev/pts" && mount -t devpts -o newinstance,ptmxmode=0666 devpts "$root/dev/pts"  # tests of serial lines open terminals
# timed WORDS COMMAND…: a row of the table. What the command says stands in a log, whose end is shown when it fails.
timed() {
  local words=$1 TIMEFORMAT='%0R %0U %0S' spent
  shift
  spent=$({ time "$@" > "$root/said" 2>&1; } 2>&1) || { echo "bare_debian: $words: failed"; tail -20 "$root/said"; exit 1; }
  read -r wall user system <<< "$spent"
  printf '| %s | %d:%02d | %d:%02d |\n' "$words" $((wall / 60)) $((wall % 60)) $(((user + system) / 60)) $(((user + system) % 60))
}
inside() { LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive HOME=/root chroot "$root" "$@"; }
at_clone() { inside sh -c "cd /srv/reachlab && $*"; }
quietly() { "$@" > "$root/said" 2>&1 || { tail -20 "$root/said"; exit 1; }; }

quietly inside apt-get update -qq
quietly inside apt-get install -qq --no-install-recommends git ca-certificates sudo locales
git clone -q --no-hardlinks "$source" "$root/srv/reachlab"
echo "| Step ($(nproc) cores, $(git -C "$source" log -1 --format=%h)) | Wall time [min:s] | Processor time [min:s] |"
echo "|---|---|---|"
if wanted first; then
  timed "packages for the command line" at_clone packaging/install core
  timed "\`packaging/run\`: build, five virtual subjects, analysis" at_clone packaging/run
  cp "$root/said" "$root/first"
  timed "\`packaging/run\` again" at_clone packaging/run
fi
if wanted tests; then
  timed "packages for window and tests" at_clone packaging/install core gui test
  timed "\`packaging/test\`" at_clone packaging/test
fi
if wanted packages; then timed "\`packaging/deb\`" at_clone packaging/deb; fi
if wanted user; then
  place="/home/eva/Meine Übungen (SS 26)"
  quietly inside sh -c "echo 'de_DE.UTF-8 UTF-8' > /etc/locale.gen && locale-gen && useradd -m eva && echo 'eva ALL=(ALL) NOPASSWD: ALL' > /etc/sudoers.d/eva"
  mkdir -p "$root$place"
  git -C "$source" archive HEAD | tar -C "$root$place" -xf -
  inside chown -R eva "$place"
  eva() { LC_ALL=de_DE.UTF-8 HOME=/home/eva chroot --userspec=eva "$root" sh -c 'cd "$0" && exec "$@"' "$place" "$@"; }
  timed "a user with sudo: packages" eva packaging/install core
  timed "the same, German, without network: \`packaging/run\`" unshare -n bash -c "$(declare -p root place); $(declare -f eva); eva packaging/run"
fi
[[ ! -f $root/first ]] || { echo; tail -12 "$root/first"; }
