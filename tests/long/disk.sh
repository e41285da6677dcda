#!/bin/bash
# A full, a read-only and a yanked disk, as small tmpfs. Needs to be root, or unprivileged user namespaces. $1 is the build folder.
set -euo pipefail
build=$(realpath "$1")
if [ "${REACHLAB_IN_NAMESPACE:-}" != 1 ]; then
  REACHLAB_IN_NAMESPACE=1 exec unshare --mount --map-root-user "$0" "$build"
fi
reach=$build/cli/reach
work=$(mktemp -d)
trap 'umount -l "$work"/* 2> /dev/null || true; rm -rf "$work"' EXIT
fail() { echo "disk: $*"; exit 1; }

# Exit code 3, one sentence, and every announced trial in the log.
check() {
  local name=$1 code=$2 log=$3
  [ "$code" = 3 ] || fail "$name: exit code $code: $(cat "$work/err")"
  grep -v '^run ' "$work/err" > "$work/sentence" || true
  [ "$(wc -l < "$work/sentence")" = 1 ] || fail "$name: not one sentence: $(cat "$work/sentence")"
  local announced=0 kept=0
  announced=$(grep -c '^trial=' "$work/out" || true)
  if [ -n "$log" ]; then
    kept=$("$reach" export "$log" --format csv --out "$work/csv" > /dev/null && grep -c -v '^subject\|interrupted' "$work/csv/trials.csv" || true)
    [ "$kept" -ge "$announced" ] || fail "$name: $announced trials announced, $kept kept"
  fi
  echo "disk: $name: $announced trials announced, $kept kept; $(cat "$work/sentence")"
}
run() { local code=0; "$reach" run chain-moderate --device simulated --trials "$2" --seed 1 "${@:3}" --data "$1" > "$work/out" 2> "$work/err" || code=$?; echo $code; }

mkdir "$work/full" "$work/readonly" "$work/disk" "$work/yanked"
mount -t tmpfs -o size=2m tmpfs "$work/full"
code=$(run "$work/full" 100 --fast)
check "full disk" "$code" "$(ls "$work"/full/sourcedata/*_log.reach)"

mount -t tmpfs -o ro,size=2m tmpfs "$work/readonly"
code=$(run "$work/readonly" 3 --fast)
check "read-only folder" "$code" ""

# The yanked disk is seen through a second mount, so that what was on it can be looked at afterwards.
mount -t tmpfs -o size=200m tmpfs "$work/disk"
mount --bind "$work/disk" "$work/yanked"
(sleep 6; umount -l "$work/yanked") &
code=$(run "$work/yanked" 100 --timing-check 0)
wait
check "yanked disk" "$code" "$(ls "$work"/disk/sourcedata/*_log.reach)"
