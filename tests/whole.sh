#!/bin/sh
# The audit of the whole paper, as the tests read it: whole.sh PROGRAM FOLDER.
# In FOLDER are then paper/, the report; said, errors and status, how it went; and copies of the other reports, of which the
# page shows some.
program=$1 folder=$2
rm -rf "$folder" && mkdir -p "$folder" && cp -R reports/* "$folder" && rm -r "$folder/paper" || exit
"$program" verify paper --out "$folder/paper" > "$folder/said" 2> "$folder/errors"
echo $? > "$folder/status"
