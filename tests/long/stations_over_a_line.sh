#!/usr/bin/env bash
# Two stations, encrypted, in two network namespaces that a relay joins with delay, jitter and loss (needs root):
#   tests/long/stations_over_a_line.sh BUILD [TRIALS]
# 25 +- 2.5 ms each way: copies apart at most 0.5 mm RMS; 50 +- 5 ms: 1.5 mm; 5 % loss each way. Exits 1 when they are not, or a copy does not
# replay to the bit.
set -euo pipefail
reach=$(realpath "$1")/cli/reach
trials=${2:-3}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
a=reachA$$ b=reachB$$ va=rva$$ vb=rvb$$
tidy() {
  [[ -n ${relay:-} ]] && kill "$relay" 2>/dev/null || true
  ip netns del $a 2>/dev/null || true
  ip netns del $b 2>/dev/null || true
  ip link del $va 2>/dev/null || true
  ip link del $vb 2>/dev/null || true
  rm -rf "$work"
}
trap tidy EXIT
g++ -std=c++20 -O2 -o "$work/line_relay" "$here/line_relay.cpp"
ip netns add $a; ip netns add $b
ip link add $va type veth peer name ${va}n netns $a
ip link add $vb type veth peer name ${vb}n netns $b
for pair in "$a ${va}n 10.77.0.1" "$b ${vb}n 10.77.0.2"; do
  set -- $pair  # namespace, interface, address
  ip netns exec "$1" ip addr add "$3/24" dev "$2"
  ip netns exec "$1" ip link set lo up
  ip netns exec "$1" ip link set "$2" up
  ip netns exec "$1" "$work/line_relay" checksums "$2"
done
ip link set $va up; ip link set $vb up

cd "$work"
"$reach" peers init left --conductor --name left >/dev/null
"$reach" peers init right --name right >/dev/null
"$reach" peers add left right/request.pem >/dev/null
cp left/for-right/* right/

bad=0
try() {  # one-way delay and jitter in ms, bound in mm
  ./line_relay $va $vb "$1" "$2" 5 &
  relay=$!
  data=$work/data-$1
  ip netns exec $b "$reach" station chain-two-hands --number 2 --device simulated:noise=0 --seed 2 --peers right \
    --interface ${vb}n --peer 10.77.0.1 --data "$data/right" >right.out 2>right.err &
  other=$!
  ip netns exec $a "$reach" station chain-two-hands --number 1 --conductor --device simulated:noise=0 --seed 1 --trials "$trials" --peers left \
    --interface ${va}n --peer 10.77.0.2 --data "$data/left" >left.out 2>left.err || { echo "left: exit $?"; cat left.err; bad=1; }
  wait $other || { echo "right: exit $?"; cat right.err; bad=1; }
  kill $relay; wait $relay 2>/dev/null || true; relay=
  echo "one way $1 +- $2 ms, 5 % loss:"
  grep '^trial=' left.out || true
  grep -h '^station' left.err | sed 's/^/  /'
  awk -v bound="$3" '/copies apart/ { n++; if ($(NF-2) + 0 > bound) worse++ } END { if (!n || worse) { print "  copies farther apart than " bound " mm"; exit 1 } }' left.err || bad=1
  for log in "$data"/*/sourcedata/*_log.reach; do "$reach" replay "$log" --check >/dev/null || { echo "  $log does not replay"; bad=1; }; done
}
try 25 2.5 0.5
try 50 5 1.5
exit $bad
