#!/bin/sh
# Installs into a temporary folder; holds what the libraries export against the public headers; builds the examples against the
# copy, shared and static, and holds what they print against tests/oracle; runs the program; uninstalls.
# usage: check-install.sh BUILD-FOLDER
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() { echo "check-install: $1"; exit 1; }
make -s install B="$1" PREFIX="$dir" >/dev/null

# Each header alone, in C and in C++, and nothing in it without the prefix.
cc=${CC:-cc}
export PKG_CONFIG_PATH="$dir/lib/pkgconfig"
pkg-config --exists stickslip || fail "stickslip.pc is not found"
for header in stickslip.h $(cd "$dir/include" && ls stickslip/*.h); do
  echo "#include <$header>" > "$dir/alone.c"
  $cc -std=c17 -Wall -Wextra -pedantic -Werror -fsyntax-only -I"$dir/include" "$dir/alone.c" || fail "$header is not C17"
  if command -v c++ >/dev/null; then
    c++ -Wall -Wextra -pedantic -Werror -fsyntax-only -x c++ -I"$dir/include" "$dir/alone.c" || fail "$header is not C++"
  fi
done
cat "$dir"/include/stickslip/*.h > "$dir/all.h"
sed -n 's/^#define \([A-Za-z_]*\).*/\1/p' "$dir/all.h" | grep -v '^SS_' && fail "a macro without SS_"

# What is declared is exported, and nothing else; every public function has a test.
tr '\n' ' ' < "$dir/all.h" | grep -o 'SS_API [^(]*(' | grep -o 'ss_[a-z0-9_]*($' | tr -d '(' | sort -u > "$dir/declared"
nm -D --defined-only "$dir/lib/libstickslip.so" | awk '{ print $3 }' | sort -u > "$dir/exported"
nm -g --defined-only "$dir/lib/libstickslip.a" | awk 'NF == 3 { print $3 }' | sort -u > "$dir/static"
diff "$dir/declared" "$dir/exported" || fail "the shared library exports (>) other names than the headers declare (<)"
diff "$dir/declared" "$dir/static" || fail "the static library exports (>) other names than the headers declare (<)"
while read -r name; do
  grep -q "\<$name(" tests/check_library.c || fail "tests/check_library.c does not call $name"
done < "$dir/declared"

# The examples, with the shared and with the static library.
oracle() { awk -F '\t' -v n="$1" '$1 == "orbit" && $2 == "paper" && $3 == n { print $11 }' tests/oracle/orbits.tsv; }
first=$(oracle 0) second=$(oracle 1)
flip=$(awk -F '\t' '$1 == "0.8" && $6 == "e2" && $9 == "flip" { print $10; exit }' tests/oracle/bifurcations.tsv)
libs=$(pkg-config --libs stickslip)
static=$(pkg-config --static --libs stickslip | sed 's/-lstickslip/-l:libstickslip.a/')
for kind in "$libs -Wl,-rpath,$dir/lib" "$static"; do
  for example in orbit sweep audit; do
    # shellcheck disable=SC2046,SC2086
    $cc -Wall -Wextra -o "$dir/bin/$example" examples/$example.c $(pkg-config --cflags stickslip) $kind || fail "$example: $kind"
    "$dir/bin/$example" > "$dir/$example.txt" || fail "examples/$example.c fails"
  done
  # 48 digits: the file has 60, and the program rounds the last of its 50
  grep -qF "orbit 1: multiplier $(echo "$first" | cut -c1-50)" "$dir/orbit.txt" || fail "the multiplier of orbit 1"
  grep -qF "orbit 2: multiplier $(echo "$second" | cut -c1-50)" "$dir/orbit.txt" || fail "the multiplier of orbit 2"
  grep -qx "there is no other" "$dir/orbit.txt" || fail "the orbits are not complete"
  awk -v flip="$flip" '/stable from/ { ok = $5 < flip && flip < $7 && $7 - $5 < 0.001 } END { exit !ok }' "$dir/sweep.txt" ||
    fail "the sweep does not find tr J = -1 at $flip"
  grep -qx "eq-40: conditional" "$dir/audit.txt" || fail "eq-40 is not judged as on record"
  grep -qx "  condition: V = 1" "$dir/audit.txt" || fail "eq-40 has no condition"
  grep -q " differs, worst at chi = " "$dir/audit.txt" || fail "eq-40 has no certificate"
done
$cc -o "$dir/bin/orbit" examples/orbit.c $(pkg-config --cflags stickslip) $libs
readelf -d "$dir/bin/orbit" | grep -q 'libstickslip.so.0' || fail "the example is not linked to the shared library"
readelf -d "$dir/bin/orbit" | grep -q 'lib\(flint\|gsl\)' && fail "a program has to name what only the library uses"
rm "$dir/bin/orbit" "$dir/bin/sweep" "$dir/bin/audit"

(cd "$dir" && bin/stickslip verify --only eq-27 --out "$dir/report" --quiet >/dev/null) || fail "the installed program fails"
[ -f "$dir/share/man/man1/stickslip.1" ] || fail "no man page"
[ -f "$dir/share/man/man5/stickslip-eq.5" ] || fail "no man page of the formats"
for header in "$dir"/include/stickslip/*.h; do
  [ -f "$dir/share/man/man3/stickslip-$(basename "$header" .h).3" ] || fail "no man page of $header"
done
if python=$(command -v "${PYTHON:-/usr/bin/python3}") && [ -z "${EXTRA:-}" ]; then
  module=$(find "$dir/lib" -name stickslip.py)
  (cd "$dir" && unset STICKSLIP_LIBRARY STICKSLIP_DATA && PYTHONPATH=${module%/*} "$python" -c '
import stickslip
assert stickslip._lib._name.startswith("'"$dir"'"), stickslip._lib._name
print("multiplier", stickslip.Scene().orbits(50)[1].trace)') > "$dir/module.txt" || fail "the Python module fails"
  grep -qF "multiplier $(echo "$second" | cut -c1-50)" "$dir/module.txt" || fail "the Python module is wrong"
fi
for completion in bash-completion/completions/stickslip zsh/site-functions/_stickslip fish/vendor_completions.d/stickslip.fish; do
  [ -f "$dir/share/$completion" ] || fail "no completion: $completion"
done
[ "$(bash "$dir/share/bash-completion/completions/stickslip" "$dir/bin/stickslip" orb)" = orbit ] || fail "nothing is completed"
make -s uninstall PREFIX="$dir"
left=$(find "$dir/bin" "$dir/lib" "$dir/include" "$dir/share" ! -type d)
[ -z "$left" ] || fail "left behind: $left"
