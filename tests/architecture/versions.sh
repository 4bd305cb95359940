#!/usr/bin/env bash
# One version: CMakeLists.txt, CITATION.cff and the first version in CHANGELOG.md.
#
#   versions.sh [ROOT]     ROOT: folder of the sources, the repository if not given
#
# Exit code 0: they agree; 1: they do not.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../..}"

program=$(sed -n 's/^project(mpfem VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
citation=$(sed -n 's/^version: //p' CITATION.cff)
changelog=$(sed -n 's/^## \([0-9][0-9.]*\).*/\1/p' CHANGELOG.md | head -n 1)
[[ -n $program && $citation == "$program" && $changelog == "$program" ]] || {
  echo "versions.sh: found $program in CMakeLists.txt, $citation in CITATION.cff, $changelog in CHANGELOG.md" >&2
  exit 1
}
