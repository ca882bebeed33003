#!/bin/sh
# The audit of the whole paper, as the tests read it: whole.sh PROGRAM FOLDER WORD..., the words being those of verify.
# In FOLDER are then paper/, the report; said, errors and status, how it went; and two neighbours that the page shows.
program=$1 folder=$2
shift 2
rm -rf "$folder" && mkdir -p "$folder/mutation" "$folder/bench" || exit
cp reports/mutation/mutation.json "$folder/mutation" && cp reports/bench/map.svg "$folder/bench" || exit
"$program" verify "$@" --out "$folder/paper" > "$folder/said" 2> "$folder/errors"
echo $? > "$folder/status"
