#!/bin/sh
# page.sh POINTS.csv VALUES.csv REFERENCES.csv: prints the page of docs/speed-against-error: page.md, each line
# '@table NAME' replaced by that table of these numbers (tables.awk).
set -eu
study=$(dirname "$0")
while IFS= read -r line; do
  case $line in
    '@table '*)
      name=${line#'@table '}
      awk -f "$study/../common/verdict.awk" -f "$study/tables.awk" -v table="$name" "$@" |
        awk '{ print } END { exit NR == 0 }' || { echo "page.sh: the table $name is empty" >&2 && exit 1; }
      ;;
    *) printf '%s\n' "$line" ;;
  esac
done <"$study/page.md"
