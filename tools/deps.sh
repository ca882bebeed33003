#!/bin/sh
# Installs the packages that are missing, with apt-get; elsewhere says what to install.
# usage: deps.sh PACKAGE... -- PACKAGE...   those after -- exist only where FLINT and Arb are separate
set -eu
wanted= optional= after=no
for p in "$@"; do
  if [ "$p" = -- ]; then after=yes
  elif [ $after = no ]; then wanted="$wanted $p"
  else optional="$optional $p"; fi
done
if ! command -v apt-get >/dev/null 2>&1; then
  echo "deps: no apt-get here; install:$wanted (and$optional where FLINT is older than 3)"
  exit 0
fi
installed() { dpkg-query -W -f='${Status}' "$1" 2>/dev/null | grep -q 'ok installed'; }
missing=
for p in $wanted $optional; do installed "$p" || missing="$missing $p"; done
[ -n "$missing" ] || exit 0
sudo=
[ "$(id -u)" = 0 ] || sudo=sudo
$sudo apt-get update -qq
list=
for p in $missing; do
  case " $optional " in
    *" $p "*) apt-cache policy "$p" | grep -q 'Candidate: [0-9]' || continue ;;
  esac
  list="$list $p"
done
[ -z "$list" ] || DEBIAN_FRONTEND=noninteractive $sudo apt-get install -y -qq --no-install-recommends $list
