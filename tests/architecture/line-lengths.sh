#!/usr/bin/env bash
# No line of code has more than 120 columns, comments included.
#
#   line-lengths.sh [ROOT]     ROOT: folder of the sources, the repository if not given
#
# Exit code 0: none is longer; 1: some are, and are listed.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../..}"

find . -path './build*' -prune -o -path ./out -prune -o -path ./.git -prune -o -type f \
  \( -name '*.[ch]pp' -o -name '*.sh' -o -name '*.awk' -o -name '*.gp' -o -name '*.mk' -o -name '*.cmake' \
  -o -name 'CMakeLists.txt' -o -name 'Makefile*' -o -name bootstrap -o -path './.ci/*' \) -print0 |
  { LC_ALL=C.UTF-8 xargs -0 grep -nE '^.{121,}' || true; } |
  awk -F: '{ sub(/^\.\//, ""); print $1 ":" $2 ": more than 120 columns"; failed = 1 } END { exit failed }'
