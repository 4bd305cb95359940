#!/usr/bin/env bash
# Includes point one way: a folder includes its own files and those that the table below allows, nothing else.
#
#   includes.sh [ROOT]     ROOT: folder of the sources, the repository if not given
#
# Exit code 0: as the table says; 1: an include that it does not allow, or an exception that nothing needs any more.
set -euo pipefail
cd "${1:-$(dirname "${BASH_SOURCE[0]}")/../..}"

# FOLDER: the folders that it may include; several lines of one folder add up.
allowed='
common:
results-schema: common
surfaces: common solver/physics
pack-gen: common results-schema surfaces solver/physics
postproc: common postproc/commands postproc/figure postproc/picture
postproc/fits: common
postproc/run_data: common results-schema postproc/fits
postproc/files: common results-schema postproc/run_data
postproc/metrics: common results-schema postproc/fits postproc/run_data postproc/files
postproc/drawing: common results-schema postproc/fits postproc/run_data postproc/files postproc/metrics
postproc/picture: common results-schema postproc/run_data postproc/files postproc/drawing postproc/commands
postproc/view: common results-schema postproc/run_data postproc/files postproc/drawing postproc/picture
postproc/watch: common results-schema postproc/run_data
postproc/figure: common results-schema postproc/fits postproc/run_data postproc/files postproc/metrics postproc/view
postproc/figure: postproc/drawing
postproc/commands: common results-schema postproc/fits postproc/run_data postproc/files postproc/metrics
postproc/commands: postproc/drawing postproc/view postproc/watch
solver/physics:
solver/scenario: common solver/physics
solver/parallel: common
solver/model: common results-schema solver/physics solver/scenario solver/parallel
solver/kernels: common solver/physics solver/parallel solver/model
solver/boundary: common surfaces solver/physics solver/parallel solver/model
solver/output: common results-schema solver/physics solver/scenario solver/parallel solver/model
solver/output: solver/kernels solver/boundary
solver/run: common surfaces solver/physics solver/scenario solver/parallel solver/model solver/kernels
solver/run: solver/boundary solver/output
solver/bench: common solver/physics solver/scenario solver/parallel solver/model solver/kernels
solver/bench: solver/boundary solver/output solver/run
solver: common surfaces solver/scenario solver/parallel solver/model solver/output solver/run solver/bench
'
# FOLDER FOLDER: an include that exists and is to be removed.
open=''

folders='common results-schema surfaces pack-gen postproc solver'
# shellcheck disable=SC2086 # folders are several words
grep -rnE --include='*.cpp' --include='*.hpp' '^ *# *include +"' $folders |
  awk -v allowed="$allowed" -v open="$open" '
    function folder(path) { # of a file: its first two parts in solver/ and postproc/, its first part elsewhere
      n = split(path, part, "/")
      return n == 1 ? "" : part[1] ~ /^(solver|postproc)$/ && n > 2 ? part[1] "/" part[2] : part[1]
    }
    BEGIN {
      lines = split(allowed, line, "\n")
      for (i = 1; i <= lines; ++i) {
        words = split(line[i], word, " ")
        sub(":", "", word[1])
        for (j = 1; j <= words; ++j) may[word[1], word[j]] = 1
      }
      lines = split(open, line, "\n")
      for (i = 1; i <= lines; ++i) if (line[i] != "") is_open[line[i]] = 1
    }
    {
      split($0, field, ":")
      from = folder(field[1])
      match($0, /"[^"]*"/)
      to = folder(substr($0, RSTART + 1, RLENGTH - 2))
      if (to == "" || (from, to) in may) next # a file beside it, or allowed
      if ((from " " to) in is_open) { ++used[from " " to]; next }
      print field[1] ":" field[2] ": " from " must not include " to
      failed = 1
    }
    END {
      for (pair in is_open) {
        if (pair in used) { print "still open: " pair " (" used[pair] " includes)"; continue }
        print "no longer needed, remove it from the exceptions: " pair
        failed = 1
      }
      exit failed
    }'
