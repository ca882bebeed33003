#!/bin/sh
# README's two commands, and the bytes of quick outputs, on a clone in a fresh Debian of another release; needs root, debootstrap
# and two gigabytes in the temporary folder.
# usage: fresh.sh RELEASE
set -eu
root=$(mktemp -d)
leave() { # nothing is removed while a folder of this machine hangs in it
  for place in dev/pts dev proc; do
    if mountpoint -q "$root/$place"; then umount -l "$root/$place" || return; fi
  done
  rm -rf --one-file-system "$root"
}
trap leave EXIT
debootstrap --variant=minbase --include=git,make,ca-certificates "$1" "$root" > /dev/null
mount --bind /proc "$root/proc"
mount --bind /dev "$root/dev"
mount -t devpts devpts "$root/dev/pts"
cp /etc/resolv.conf "$root/etc/resolv.conf"
git clone -q . "$root/root/stickslip"
chroot "$root" sh -euc 'cd /root/stickslip; make deps verify; git diff --exit-code -- reports; make deps check; python3 tools/digests.py build/stickslip --quick'
