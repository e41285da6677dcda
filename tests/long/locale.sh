#!/bin/bash
# The same bytes under LC_ALL=de_DE.UTF-8, where a decimal comma lurks. $1 is the build folder.
set -euo pipefail
build=$(realpath "$1")
reach=$build/cli/reach
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
locales=$build/locales
if [ ! -d "$locales/de_DE.UTF-8" ]; then
  mkdir -p "$locales"
  localedef -i de_DE -f UTF-8 "$locales/de_DE.UTF-8" || { echo "locale: apt-get install locales"; exit 1; }
fi
export LOCPATH=$locales
comma=$(LC_ALL=de_DE.UTF-8 /usr/bin/printf '%.1f' 1,5)
[ "$comma" = 1,5 ] || { echo "locale: de_DE.UTF-8 is not in force ($comma)"; exit 1; }
for locale in C de_DE.UTF-8; do
  out=$work/$locale
  LC_ALL=$locale "$reach" run chain-moderate --device simulated --trials 3 --seed 1 --fast --age 30.5 --data "$out/data" > "$out.run" 2> /dev/null
  LC_ALL=$locale "$reach" simulate chain-moderate --hand min-jerk > "$out.simulate"
  LC_ALL=$locale "$reach" predict chain-moderate --criterion min-hand-jerk > "$out.predict"
done
cmp "$work/C.run" "$work/de_DE.UTF-8.run"
cmp "$work/C.simulate" "$work/de_DE.UTF-8.simulate"
cmp "$work/C.predict" "$work/de_DE.UTF-8.predict"
# The same log exported under both.
log=$(ls "$work"/C/data/sourcedata/*_log.reach)
for locale in C de_DE.UTF-8; do
  LC_ALL=$locale "$reach" export "$log" --format csv --out "$work/$locale/csv" > /dev/null
  LC_ALL=$locale "$reach" export "$log" --format bids --out "$work/$locale/bids" > /dev/null
  LC_ALL=$locale "$reach" replay "$log" --check > /dev/null
done
diff -r "$work/C/csv" "$work/de_DE.UTF-8/csv"
diff -r "$work/C/bids" "$work/de_DE.UTF-8/bids"
echo "locale: the same bytes in C and de_DE.UTF-8"
