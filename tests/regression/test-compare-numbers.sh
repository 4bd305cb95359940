#!/usr/bin/env bash
# test-compare-numbers.sh PROGRAM: numbers within their tolerance pass, others, missing rows and other texts do not.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir kept found
echo 'table,column,relative,absolute,times_uncertainty,why
a.csv,strength,0.01,0,0,1 %
a.csv,modulus,0,0,2,its uncertainty' >tolerances.csv
table() { printf 'name,strength [MPa],modulus [MPa],modulus_uncertainty [MPa]\n%s\n' "$1"; }
table 'dense,100,2000,10' >kept/a.csv

expect() { # CODE ROWS
  table "$2" >found/a.csv
  code=0
  "$program" tolerances.csv kept found >log.txt 2>&1 || code=$?
  [[ $code == "$1" ]] || {
    echo "rows '$2': found exit code $code, expected $1" >&2
    cat log.txt >&2
    exit 1
  }
}
expect 0 'dense,100.9,2019,11'
expect 1 'dense,101.1,2000,10'
expect 1 'dense,100,2021,10'
expect 1 'dense,,2000,10'
expect 1 'dense,nan,2000,10'
expect 1 $'dense,100,2000,10\nloose,50,1000,10'
rm found/a.csv
code=0
"$program" tolerances.csv kept found >log.txt 2>&1 || code=$?
[[ $code == 2 ]]
