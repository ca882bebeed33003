#!/bin/sh
# Installs into a temporary folder, builds the README's example against the copy, runs both, and uninstalls.
# usage: check-install.sh BUILD-FOLDER
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() { echo "check-install: $1"; exit 1; }
make -s install B="$1" PREFIX="$dir" >/dev/null
PKG_CONFIG_PATH="$dir/lib/pkgconfig" pkg-config --exists stickslip || fail "stickslip.pc is not found"
flags=$(PKG_CONFIG_PATH="$dir/lib/pkgconfig" pkg-config --cflags --libs stickslip)
# shellcheck disable=SC2086
${CC:-cc} -o "$dir/orbits" examples/orbits.c $flags -Wl,-rpath,"$dir/lib"
"$dir/orbits" | grep -c multiplier | grep -qx 2 || fail "the example does not print two orbits"
readelf -d "$dir/orbits" | grep -q libstickslip.so.0 || fail "the example is not linked to the shared library"
(cd "$dir" && bin/stickslip verify --only eq-27 --out "$dir/report" --quiet >/dev/null) || fail "the installed program fails"
[ -f "$dir/share/man/man1/stickslip.1" ] || fail "no man page"
[ -f "$dir/share/man/man5/stickslip-eq.5" ] || fail "no man page of the formats"
[ -f "$dir/share/bash-completion/completions/stickslip" ] || fail "no completion"
make -s uninstall PREFIX="$dir"
left=$(find "$dir/bin" "$dir/lib" "$dir/include" "$dir/share" ! -type d)
[ -z "$left" ] || fail "left behind: $left"
