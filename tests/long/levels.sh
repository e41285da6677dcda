#!/bin/bash
# The packages' programs for x86-64-v2, -v3 and -v4 (those that this processor runs) compute the same bits, the lowest under an emulated Nehalem too.
# Builds the packages by packaging/deb unless PACKAGES names a folder that has them. PRICE names a native `reach` to time the levels beside.
set -euo pipefail
source=$(realpath "$(dirname "$0")/../..")
if [[ -z ${PACKAGES:-} ]]; then
  "$source/packaging/deb" > /dev/null
  PACKAGES=$source/build/package/packages
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
dpkg-deb --extract "$PACKAGES"/reachlab-cli_*.deb "$work"
export REACHLAB_RESOURCES=$work/usr/share/reachlab
loader=$(/lib64/ld-linux-x86-64.so.2 --help)
programs=()
for level in x86-64-v4 x86-64-v3 x86-64-v2; do
  [[ $loader == *"$level (supported"* ]] || continue
  program=$work/usr/libexec/reachlab/$level/reach
  [[ -x $program ]] || { echo "levels: the package has no program for $level"; exit 1; }
  programs+=("${level#x86-64-}=$program")
done
"$source/tests/long/levels.py" --emulate Nehalem "${programs[@]}"
[[ -z ${PRICE:-} ]] || "$source/tests/long/paired_ticks.py" "$PRICE" "${programs[@]#*=}"
