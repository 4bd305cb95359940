#!/usr/bin/env bash
# Messages have one form: what was found, a comma, "allowed:" and what is allowed.
#
#   messages.sh [ROOT]     ROOT: folder of the sources, the repository if not given
#
# Exit code 0: no semicolon stands before "allowed:", not even where a message goes on in the next line; 1: some do, and
# are listed.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../..}"

status=0
found=$(grep -rPzo --include='*.[ch]pp' --include='*.md' --include='*.mk' '[^\n]*;\s*("\s*")?allowed:' \
  common results-schema surfaces pack-gen solver postproc tests docs studies/*.mk README.md | tr '\0' '\n') || status=$?
((status == 1)) && exit 0 # none
echo "messages.sh: found '; allowed:', allowed: ', allowed:': $found" >&2
exit 1
