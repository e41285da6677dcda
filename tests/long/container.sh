#!/bin/bash
# The container's tree, out of a bootstrap and the package reachlab-cli: `reach` records and analyses in it, and nothing is in it that a node does not
# need. Builds the packages unless PACKAGES names a folder that has them. Needs root, debootstrap and a mirror (MIRROR, else deb.debian.org).
set -euo pipefail
source=$(realpath "$(dirname "$0")/../..")
[[ $(id -u) == 0 ]] || { echo "container: needs root for debootstrap and chroot"; exit 1; }
if [[ -z ${PACKAGES:-} ]]; then
  "$source/packaging/deb" > /dev/null
  PACKAGES=$source/build/package/packages
fi
"$source/packaging/container/build" "$PACKAGES"/reachlab-cli_*.deb > /dev/null
tree=$(mktemp -d /var/tmp/reachlab-node-XXXXXX)
clean_up() { umount "$tree/proc" 2> /dev/null || true; rm -rf --one-file-system "$tree"; }
trap clean_up EXIT
tar -C "$tree" -xf "$source/build/container/rootfs.tar"
mount -t proc proc "$tree/proc"  # as every container has it
inside() { LC_ALL=C.UTF-8 chroot "$tree" "$@"; }
inside reach --version
inside sh -c "cd /data && reach run dingwell --device simulated --trials 3 --seed 1 --fast && reach analyze data" > "$tree.log" 2>&1 || { tail -5 "$tree.log"; rm "$tree.log"; exit 1; }
rm "$tree.log"
inside test -s /data/data/derivatives/reachlab/report.html
for other in g++ gcc cmake; do
  if inside sh -c "command -v $other" > /dev/null; then echo "container: $other is in it"; exit 1; fi
done
echo "container: reach runs in a tree of $(du -smx --exclude=data "$tree" | cut -f1) MB"
