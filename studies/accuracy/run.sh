#!/bin/sh
# run.sh FILE COMMAND...: runs the command and adds a line to FILE: the processor seconds that it took. Wall time says
# little where other programs run too; a run that was interrupted has a line for each of its parts.
set -eu
file=$1
shift
code=0
"$@" || code=$?
# Second line of `times`: children, user and system, as 1m2.34s. Not through a pipe, whose shell has other children.
times >"$file.times"
awk 'NR == 2 {
  split($1, user, "m")
  split($2, kernel, "m")
  printf "%.2f\n", 60 * (user[1] + kernel[1]) + user[2] + kernel[2]
}' "$file.times" >>"$file"
rm "$file.times"
exit "$code"
