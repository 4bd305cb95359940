#!/usr/bin/env bash
# reasons.sh: every kept statement that differs from what was expected gives a reason of one of these kinds. Statements
# stand one a line in studies/results/MESH/figNN/verdict.json and own/STUDY/verdict.json.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

kinds="mended|the paper's choice, found: |the paper's error, shown by |open: "
differing() {
  grep -E '"agrees": ?false' studies/results/*/fig*/verdict.json studies/results/own/*/verdict.json
}

differing >/dev/null || { echo 'reasons.sh: no statement differs: nothing was checked' >&2 && exit 1; }
if differing | grep -vE "\"why\": ?\"($kinds)"; then
  echo "reasons.sh: no reason of a known kind ($kinds) in the statements above" >&2
  exit 1
fi
