#!/bin/sh
# README's two commands, and the bytes of quick outputs, on a clone in a fresh Debian of another release; needs root,
# debootstrap and two gigabytes in the temporary folder.
# usage: fresh.sh RELEASE
set -eu
root=$(mktemp -d)
trap 'rm -rf --one-file-system "$root"' EXIT
debootstrap --variant=minbase --include=git,make,ca-certificates "$1" "$root" > /dev/null
cp /etc/resolv.conf "$root/etc/resolv.conf"
git clone -q . "$root/root/stickslip"
# The mounts are the inner shell's own and end with it: the machine never sees them, and what is removed holds none.
unshare --mount sh -euc '
  mount --bind /proc "$1/proc"
  mount --bind /dev "$1/dev"
  mount -t devpts devpts "$1/dev/pts"
  chroot "$1" sh -euc "cd /root/stickslip; make deps verify; git diff --exit-code -- reports; make deps check
    python3 tools/digests.py build/stickslip --quick"' sh "$root"
