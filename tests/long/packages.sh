#!/bin/bash
# The Debian packages in a bare Debian 12: install, first window, first recorded and analysed session, removal without traces. Builds them by
# packaging/deb unless PACKAGES names a folder that has them. Needs root, debootstrap and a mirror (MIRROR, else deb.debian.org).
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
debootstrap --variant=minbase bookworm "$root" "${MIRROR:-http://deb.debian.org/debian}" > "$root.log" 2>&1 || { tail -5 "$root.log"; exit 1; }
rm "$root.log"
mount -t proc proc "$root/proc"
cp /etc/resolv.conf "$root/etc/"
[[ ! -d /etc/apt/apt.conf.d ]] || grep -lsi proxy /etc/apt/apt.conf.d/* | xargs -r cp -t "$root/etc/apt/apt.conf.d/" # how this machine reaches the mirror
mkdir "$root/packages" && cp "$PACKAGES"/*.deb "$root/packages/"
inside() { DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 chroot "$root" "$@"; }
quietly() { inside "$@" > "$root/last.log" 2>&1 || { echo "packages: $* failed"; tail -20 "$root/last.log"; exit 1; }; }
# What is there of ours, and which groups and users there are.
traces() { inside sh -c "find / -xdev \\( -path /proc -o -path /packages -o -path /root -o -path /tmp \\) -prune -o -iname '*reachlab*' -print; cut -d: -f1 /etc/group /etc/passwd; dpkg-query -W -f '\${Package}\\n'" | sort; }

quietly apt-get update -qq
quietly apt-get install -qq --no-install-recommends adduser xvfb xauth   # before the count of traces: not ours
traces > "$root.before"
begin=$SECONDS
quietly apt-get install -qq --no-install-recommends /packages/reachlab-cli_*.deb
echo "packages: reachlab-cli installed in $((SECONDS - begin)) s"
if inside sh -c "dpkg-query -W -f '\${Package}\\n' | grep -E 'qt|vtk'"; then echo "packages: reachlab-cli draws in Qt or VTK"; exit 1; fi
quietly reach --version
quietly sh -c "cd /var/tmp && reach run dingwell --device replay:/usr/share/reachlab/reaches --fast && reach analyze data"
inside test -s /var/tmp/data/derivatives/reachlab/report.html
inside getent group reachlab > /dev/null
inside test -s /etc/security/limits.d/reachlab.conf
begin=$SECONDS
quietly apt-get install -qq --no-install-recommends /packages/reachlab_*.deb /packages/reachlab-doc_*.deb
echo "packages: reachlab and reachlab-doc installed in $((SECONDS - begin)) s"
begin=$SECONDS
inside sh -c "cd /root && timeout 60 xvfb-run -a -s '-screen 0 1280x960x24' reachlab parallel --device simulated --trials 1 --data window" > "$root/last.log" 2>&1 && ended=0 || ended=$?
[[ $ended == 124 ]] || { echo "packages: the window ended by itself with $ended"; tail "$root/last.log"; exit 1; }
quietly sh -c "cd /root && timeout 300 xvfb-run -a reachlab --pictures pictures && ls pictures/*.png"
inside test -s /usr/share/doc/reachlab/html/index.html
quietly sh -c "test -s /usr/share/man/man1/reach-run.1.gz || grep -q path-exclude /etc/dpkg/dpkg.cfg.d/*"
quietly apt-get purge -qq --autoremove reachlab reachlab-cli reachlab-doc
traces > "$root.after"
diff "$root.before" "$root.after" || { echo "packages: traces are left (above)"; rm -f "$root.before" "$root.after"; exit 1; }
rm -f "$root.before" "$root.after"
echo "packages: installed, run and removed without traces in a bare Debian 12"
