#!/usr/bin/env bash
# tests/regression/smoke-numbers.sh BUILD [OUT]: holds the tables that the smoke studies made (OUT/smoke, OUT/own; OUT
# is out by default) to those kept in studies/results, within tolerances.csv and tolerances-own.csv.
# tests/regression/smoke-numbers.sh --hash: the hash of what is kept, for a file in changes/.
# tests/regression/smoke-numbers.sh --check-changes: fails where no file in changes/ names that hash.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
top=$(realpath "$here/../..")
kept=$top/studies/results

# tolerances FOLDER: of smoke, the figures, or own, studies with a powder of their own
tolerances() {
  case $1 in
  smoke) echo "$top/tests/regression/tolerances.csv" ;;
  own) echo "$top/tests/regression/tolerances-own.csv" ;;
  esac
}

held_tables() { grep -v '^#' "$(tolerances "$1")" | tail -n +2 | cut -d, -f1 | sort -u; }

hash_of_reference() {
  local folder
  for folder in smoke own; do
    (cd "$kept/$folder" && held_tables "$folder" | xargs cat)
    cat "$(tolerances "$folder")"
  done | sha256sum | cut -c1-16
}

case ${1:-} in
--hash) hash_of_reference ;;
--check-changes)
  hash=$(hash_of_reference)
  grep -qx "reference: $hash" "$top"/changes/*.md || {
    echo "the kept numbers of the smoke studies or their tolerances changed: found hash $hash, which no file in" \
      "changes/ names; changes/README.md says what to write" >&2
    exit 1
  }
  ;;
*)
  [[ $# -ge 1 ]] || {
    echo "smoke-numbers.sh: allowed: BUILD [OUT], --hash or --check-changes" >&2
    exit 2
  }
  code=0
  for folder in smoke own; do
    "$1/tests/compare-numbers" "$(tolerances $folder)" "$kept/$folder" "${2:-$top/out}/$folder" || code=$?
  done
  exit "$code"
  ;;
esac
