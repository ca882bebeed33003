#!/bin/sh
# Formatting, arrows between rooms, static analysis, the README's generated table.  Exits non-zero at the first kind of finding.
set -eu
for tool in clang-format cppcheck; do
  command -v $tool >/dev/null 2>&1 || { echo "lint: $tool is missing; install it (Debian: apt-get install $tool)"; exit 1; }
done
sources=$(git ls-files '*.c' '*.h')

echo "lint: formatting"
# shellcheck disable=SC2086
clang-format --dry-run -Werror $sources
# shellcheck disable=SC2086
awk 'length > 120 { print FILENAME ":" FNR ": more than 120 columns"; long = 1 } END { exit long }' $sources

echo "lint: arrows between rooms"
python3 tools/arrows.py "${1:-build}"

echo "lint: style sheets and script"
grep -n '[<&]' src/*/*.css src/*/*.js && { echo "lint: the page is XML, in which these would be markup"; exit 1; }
if command -v node >/dev/null 2>&1; then
  for script in src/*/*.js; do node --check "$script"; done
fi

if command -v mandoc >/dev/null 2>&1; then
  echo "lint: man pages"
  mandoc -Tlint -Wwarning man/*.[135]
fi

echo "lint: README table"
python3 tools/readme.py --check

echo "lint: cppcheck"
# shellcheck disable=SC2046
cppcheck --quiet --std=c11 --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
  --suppress=missingIncludeSystem -Iinclude -I. -Isrc --suppress=preprocessorErrorDirective $(git ls-files 'src/*.c' 'bench/*.c' 'verify/checker/*.c')
echo "lint: clean"
