#!/usr/bin/env bash
# tests/reliability/kills.sh BIN COMPARE [KILLS]: kills runs of every kind of stage, branches of them, and a small study
# with two jobs, KILLS times in all (default 10) with kill -9 at random moments, lets them go on, and compares every
# file with those of undisturbed runs: all exist and are bitwise the same except for wall-clock times. BIN: folder of
# the executables, COMPARE: compare-runs. Exit code 0: all are the same. SEED in the environment repeats a sequence of
# moments.
set -euo pipefail
bin=$(realpath "$1")
compare=$(realpath "$2")
kills=${3:-10}
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
RANDOM=${SEED:-$$}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here"/*.toml "$work"
cd "$work"
"$bin/pack-gen" spheres packing.toml -o spheres.h5 --quiet
"$bin/pack-gen" mesh spheres.h5 --size 0.05 -o packing.h5 --quiet

now() { date +%s%N; }
killed=0

# in_parts KILLS NANOSECONDS COMMAND...: kills the command so many times within the time that it takes, then lets it
# end.
in_parts() {
  local wanted=$1 time=$2 done_before=$killed name=$5
  shift 2
  while ((killed - done_before < wanted)); do
    "$@" &
    local victim=$!
    sleep "$(awk -v r="$RANDOM" -v t="$time" 'BEGIN { print t * 1e-9 * r / 32768 }')"
    if kill -KILL "$victim" 2>/dev/null; then killed=$((killed + 1)); fi
    wait "$victim" 2>/dev/null || true
    if [ -e "$name.h5" ] && [ ! -e "$name.checkpoint.h5" ]; then rm -rf "$name".*; fi # complete: start again
  done
  ("$@")
}

# all_alike A B: run B has the same files as run A, with the same content, and no others.
all_alike() {
  local file other count=0
  for file in "$1".*h5; do
    other=$2${file#"$1"}
    "$compare" "$file" "$other"
    count=$((count + 1))
  done
  for other in "$2".*; do
    [ -e "$1${other#"$2"}" ] || { echo "$other should not be there" >&2; exit 1; }
  done
  echo "$2: $count files alike"
}

# run SCENARIO NAME OPTIONS...
run() { exec "$bin/mpfem" run "$1.toml" -o "$2.h5" --threads 1 --quiet "${@:3}"; }

share=$((kills / 6)) # of each run; the study gets the other half
for scenario in loadings grips; do
  begun=$(now)
  (run "$scenario" "$scenario-whole")
  time=$(($(now) - begun))
  in_parts "$share" "$time" run "$scenario" "$scenario-killed" --resume
  all_alike "$scenario-whole" "$scenario-killed"
done
begun=$(now)
(run branch branch-whole --from loadings-whole.cycles.checkpoint.h5)
time=$(($(now) - begun))
in_parts "$share" "$time" run branch branch-killed --from loadings-whole.cycles.checkpoint.h5 --resume
all_alike branch-whole branch-killed

# The rules of the studies themselves, with a short study: a compaction, what begins at its checkpoints, and a table.
repository=$(realpath "$here/../..")
for name in whole killed; do
  mkdir -p "study-$name/pack-gen"
  cp -r "$repository/Makefile.studies" "$repository/studies" "study-$name"/
  cp -r "$repository/pack-gen/examples" "study-$name/pack-gen"/
  sed -i 's/^relative_density = .*/relative_density = 0.52/; s/^wall_speed = .*/wall_speed = 20000/' \
    "study-$name/studies/branches/compaction.toml"
done
study=(make -s -f Makefile.studies -j2 "BIN=$bin" THREADS=1 STUDY=../study.toml out/own/study/index.html)
begun=$(now)
(cd study-whole && "${study[@]}")
time=$(($(now) - begun))

study_alike() {
  local run remaining
  for run in parent left right; do
    all_alike "study-whole/out/own/$run/run" "study-killed/out/own/$run/run"
    all_alike "study-whole/out/own/$run/work/run" "study-killed/out/own/$run/work/run"
  done
  cmp study-whole/out/own/study/ends.csv study-killed/out/own/study/ends.csv
  remaining=$(cd study-killed && "${study[@]}" -n)
  [ -z "$remaining" ] || { echo "make has more to do: $remaining" >&2; exit 1; }
}
while ((killed < kills)); do
  (cd study-killed && exec setsid "${study[@]}" >/dev/null 2>&1) &
  group=$!
  sleep "$(awk -v r="$RANDOM" -v t="$time" 'BEGIN { print t * 1e-9 * r / 32768 }')"
  if kill -KILL -- "-$group" 2>/dev/null; then
    killed=$((killed + 1))
    wait "$group" 2>/dev/null || true
  else # it has ended: compare it and start again
    wait "$group"
    study_alike
    rm -r study-killed/out
  fi
done
(cd study-killed && "${study[@]}")
study_alike
# A parent's checkpoint that is lost is made again where a branch needs it.
rm study-killed/out/own/parent/work/run.D0.480.checkpoint.h5 study-killed/out/own/left/run.h5
(cd study-killed && "${study[@]}")
study_alike
echo "$killed kills, all files alike"
