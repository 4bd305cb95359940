#!/usr/bin/env bash
# No line of code has more than 120 columns, comments included.
#
#   line-lengths.sh [ROOT]     ROOT: folder of the sources, the repository if not given
#
# Exit code 0: none is longer; 1: lines that are, or an exception that nothing needs any more.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../..}"

# Folders and files where longer lines are still there and shall go.
open=''

find . -path './build*' -prune -o -path ./out -prune -o -path ./.git -prune -o -type f \
  \( -name '*.[ch]pp' -o -name '*.sh' -o -name '*.awk' -o -name '*.gp' -o -name '*.mk' -o -name '*.cmake' \
  -o -name 'CMakeLists.txt' -o -name 'Makefile*' -o -name bootstrap -o -path './.ci/*' \) -print0 |
  { LC_ALL=C.UTF-8 xargs -0 grep -nE '^.{121,}' || true; } |
  awk -v open="$open" '
    BEGIN { places = split(open, place, " ") }
    {
      sub(/^\.\//, "")
      for (i = 1; i <= places; ++i)
        if (index($0, place[i] "/") == 1 || index($0, place[i] ":") == 1) { ++used[place[i]]; next }
      split($0, field, ":")
      print field[1] ":" field[2] ": more than 120 columns"
      failed = 1
    }
    END {
      for (i = 1; i <= places; ++i) {
        if (place[i] in used) { print "still open: " place[i] " (" used[place[i]] " lines)"; continue }
        print "no longer needed, remove it from the exceptions: " place[i]
        failed = 1
      }
      exit failed
    }'
