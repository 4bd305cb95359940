#!/usr/bin/env bash
# No test uses Catch2's Approx bare: by default it lets errors of 1e-5 pass (tests/support/tolerances.hpp).
#
#   tolerances.sh [ROOT]     ROOT: folder of the sources, the repository if not given
#
# Exit code 0: each Approx has its epsilon or margin; 1: some have not, and are listed.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../..}"

# An Approx with its arguments, on one line or several, that no tolerance follows.
bare='\bApprox(\((?:[^()]++|(?1))*+\))(?!\s*\.\s*(?:epsilon|margin)\b)'
status=0
found=$(grep -rPzo --include='*.[ch]pp' "$bare" tests | tr '\0' '\n') || status=$?
((status == 1)) && exit 0 # none
echo "tolerances.sh: no epsilon or margin, use within() or give one: $found" >&2
exit 1
