#!/usr/bin/env bash
# tests/regression/smoke-numbers.sh BUILD [OUT]: holds the tables that the smoke studies made (OUT, by default
# out/smoke) to those kept in studies/results/smoke, within the tolerances of tolerances.csv.
# tests/regression/smoke-numbers.sh --hash: the hash of what is kept, for a file in changes/.
# tests/regression/smoke-numbers.sh --check-changes: fails where no file in changes/ names that hash.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
top=$(realpath "$here/../..")
tolerances=$top/tests/regression/tolerances.csv
kept=$top/studies/results/smoke

held_tables() { grep -v '^#' "$tolerances" | tail -n +2 | cut -d, -f1 | sort -u; }

hash_of_reference() {
  (
    cd "$kept"
    held_tables | xargs cat
    cat "$tolerances"
  ) | sha256sum | cut -c1-16
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
    echo "smoke-numbers.sh: expected BUILD [OUT], --hash or --check-changes" >&2
    exit 2
  }
  "$1/tests/compare-numbers" "$tolerances" "$kept" "${2:-$top/out/smoke}"
  ;;
esac
