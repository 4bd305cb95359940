#!/usr/bin/env bash
# tests/ranks/ranks.sh BIN COMPARE MPIEXEC: runs of several ranks hold the numbers of a run of one, to the bit but for
# wall-clock times; their checkpoints go on with any number of ranks; and whatever ends one rank ends all, with the exit
# code and the one message that a single process would have. BIN: folder of the executables, COMPARE: compare-runs.
set -euo pipefail
bin=$(realpath "$1")
compare=$(realpath "$2")
mpiexec=$3
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here"/*.toml "$here"/*.stl "$here"/../reliability/*.toml "$work"
cd "$work"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_hwloc_base_binding_policy=none

fail() { printf 'ranks.sh: %s\n' "$*" >&2; exit 1; }
# mpfem RANKS ARGUMENTS...
mpfem() {
  if [[ $1 == 1 ]]; then "$bin/mpfem" "${@:2}"; else "$mpiexec" -n "$1" "$bin/mpfem" "${@:2}"; fi
}
# run RANKS THREADS SCENARIO NAME OPTIONS...
run() { mpfem "$1" run "$3.toml" -o "$4.h5" --threads "$2" --quiet --set output.checkpoint_interval=0.5 "${@:5}"; }
# alike NAME NAME: compares all files of two runs.
alike() {
  local file
  for file in "$1".h5 "$1".*.checkpoint.h5; do
    "$compare" "$file" "$2${file#"$1"}" || fail "$file and $2${file#"$1"} differ"
  done
}
# ends CODE COMMAND...: the exit code, and one line of error.
ends() {
  local wanted=$1 code=0
  "${@:2}" >log 2>&1 || code=$?
  [[ $code == "$wanted" ]] || { cat log >&2; fail "exit code $code instead of $wanted: ${*:2}"; }
  [[ $(grep -c '^mpfem: error: ' log) == 1 ]] || { cat log >&2; fail "not one line of error: ${*:2}"; }
}

"$bin/pack-gen" spheres packing.toml -o spheres.h5 --quiet
"$bin/pack-gen" mesh spheres.h5 --size 0.05 -o packing.h5 --quiet
"$bin/pack-gen" spheres die-packing.toml -o die-spheres.h5 --quiet
"$bin/pack-gen" mesh die-spheres.h5 --size 0.05 -o die-packing.h5 --quiet

for scenario in loadings grips friction tools die shapes; do
  run 1 1 "$scenario" "$scenario-alone"
  run 2 2 "$scenario" "$scenario-two"
  alike "$scenario-alone" "$scenario-two"
  run 4 1 "$scenario" "$scenario-four"
  alike "$scenario-alone" "$scenario-four"
  echo "$scenario: runs of one, two and four ranks are alike"
done

# Ranks that keep their cores move messages on while they compute.
OMPI_MCA_mpi_yield_when_idle=0 run 2 2 friction polling
alike friction-alone polling
rm -f polling.*

# More ranks than grains have nothing to do.
run 13 1 friction crowd
alike friction-alone crowd

# Another law of bonds, another precision and another element.
for setting in bond.softening=energy element.precision=mixed element.type=tet4-patch; do
  run 1 1 loadings one --set "$setting"
  run 2 1 loadings two --set "$setting"
  alike one two
  rm -f one.* two.*
  echo "$setting: runs of one and two ranks are alike"
done

# A checkpoint is one file: three ranks begin, one and two go on; four branch from what two have written.
for scenario in loadings friction tools die shapes; do
  for share in 3 1 2; do
    code=0
    run "$share" 1 "$scenario" parts --resume --time-limit 0.15 2>/dev/null || code=$?
    [[ $code == 5 || $code == 0 ]] || fail "exit code $code of a run with a time limit"
  done
  run 2 1 "$scenario" parts --resume
  alike "$scenario-alone" parts
  rm -rf parts*
done
echo "checkpoints go on with other numbers of ranks"

# branches SCENARIO PARENT STAGE OPTIONS...: begin at the end of a stage of PARENT, from what one, two and four ranks
# have written.
branches() {
  local from=$2 stage=$3.checkpoint.h5
  run 1 1 "$1" branch-alone --from "$from-alone.$stage" "${@:4}"
  run 4 1 "$1" branch-four --from "$from-two.$stage" "${@:4}"
  run 2 2 "$1" branch-two --from "$from-four.$stage" "${@:4}"
  alike branch-alone branch-four
  alike branch-alone branch-two
  rm -f branch-*
}
branches branch loadings cycles
branches friction friction compaction --set stages.0.relative_density=0.65
branches tools tools press
branches die die press --set stages.0.axial_stress=60
branches shapes shapes press --set stages.0.axial_stress=45
echo "branches are alike, with friction and tools too"

# process_of RANK NAME: the process of one rank of a run.
process_of() {
  local process
  for process in $(pgrep -f "^$bin/mpfem run loadings.toml -o $2.h5 "); do
    if grep -qzx "OMPI_COMM_WORLD_RANK=$1" "/proc/$process/environ"; then echo "$process"; fi
  done
}
# stopped SIGNAL RANK|launcher CODE TEXT [RANKS]: two ranks run, and one of them or the launcher gets a signal. The run
# ends with an exit code and a text, no rank is left, and the next call goes on with RANKS (2).
often=(--set output.checkpoint_interval=0.05) # the first one is there long before the end
run 1 1 loadings unstopped "${often[@]}"
stopped() {
  local name=stopped-$1-$2 launcher process code=0
  run 2 1 loadings "$name" "${often[@]}" >log 2>&1 &
  launcher=$!
  until [[ -e $name.checkpoint.h5 ]]; do
    kill -0 "$launcher" 2>/dev/null || { cat log >&2; fail "no checkpoint before the end of $name"; }
    sleep 0.02
  done
  "$bin/postproc" watch "$name.h5" --once >frame || fail "a run of two ranks cannot be watched"
  grep -q "^$name.checkpoint.h5: mpfem is running" frame || { cat frame >&2; fail "watch does not see two ranks"; }
  if [[ $2 == launcher ]]; then
    process=$(pgrep -f "^$mpiexec -n 2 $bin/mpfem run loadings.toml -o $name.h5 ")
  else
    process=$(process_of "$2" "$name")
  fi
  kill "-$1" "$process"
  wait "$launcher" || code=$?
  [[ $code == "$3" ]] || { cat log >&2; fail "exit code $code instead of $3 after SIG$1 to $2"; }
  grep -q "$4" log || { cat log >&2; fail "no '$4' after SIG$1 to $2"; }
  [[ -z $(pgrep -f "^$bin/mpfem run loadings.toml -o $name.h5 ") ]] || fail "a rank is left after SIG$1 to $2"
  run "${5:-2}" 1 loadings "$name" "${often[@]}" --resume
  alike unstopped "$name"
}

# A rank that is killed takes the other along.
stopped KILL 0 137 'process rank 0 .* exited on signal 9'
stopped KILL 1 137 'process rank 1 .* exited on signal 9'
# All save their state together if one is asked to stop, or the launcher, which passes SIGUSR1 on.
stopped TERM 0 5 '^mpfem: error: '
stopped TERM 1 5 '^mpfem: error: '
stopped USR1 1 5 '^mpfem: error: '
stopped USR1 launcher 5 '^mpfem: error: ' 1
echo "what ends one rank ends all, and the run goes on"

# Grains that find new owners while the run goes on leave no trace.
mpfem 1 run loadings.toml -o undivided.h5 --threads 1 --quiet # a checkpoint every 0.05 s
mpfem 3 run loadings.toml -o divided.h5 --threads 1 --redistribute always 2>log ||
  { cat log >&2; fail "no run with new owners"; }
grep -q 'redistributing grains' log || { cat log >&2; fail "grains keep their owners"; }
alike undivided divided
! grep -q 'resumed' log || fail "a run that nobody has resumed says so"
tr '\r' '\n' <log | sed -n 's/^mpfem *\([0-9.]*\) %.*/\1/p' >percentages
sort -n percentages | cmp -s - percentages || { cat percentages >&2; fail "progress falls when grains change owners"; }
echo "grains find new owners"

# What one rank alone sees go wrong ends all ranks with the message of one process.
# goes_wrong TEXT OPTIONS...
goes_wrong() {
  local ranks
  for ranks in 1 2 3; do
    # No checkpoint by time: the message says whether there is one.
    ends 3 run "$ranks" 1 loadings "wrong-$ranks" --set output.checkpoint_interval=3600 "${@:2}"
    grep -a '^mpfem: error: ' log | sed 's/wrong-.//g' >"message-$ranks"
    grep -q "$1" "message-$ranks" || { cat log >&2; fail "another message than '$1'"; }
    cmp "message-1" "message-$ranks" || fail "$ranks ranks have another message"
    [[ -s wrong-$ranks.h5 ]] || fail "the failed state of $ranks ranks is not saved"
    "$compare" wrong-1.h5 "wrong-$ranks.h5" || fail "$ranks ranks save another state"
  done
  rm -rf wrong-*
}
goes_wrong 'behind a wall' --set contact.stiffness_factor=0.05 --set bond.fracture_energy=5 \
  --set stages.0.wall_speed=1e5
goes_wrong 'inside grain' --set contact.stiffness_factor=0.2 --set bond.fracture_energy=5 \
  --set stages.0.wall_speed=1e5
goes_wrong 'energy balance' --set numerics.time_step_factor=2
echo "what goes wrong on one rank ends all alike"

# A mistake is reported once.
ends 2 run 2 1 loadings bad --set stages.0.wall_speed=-1
ends 2 mpfem 2 run missing.toml -o bad.h5
ends 2 run 2 1 loadings bad --set packing=missing.h5
ends 2 run 2 1 loadings missing/bad
ends 2 mpfem 2 check loadings.toml --set element.type=hex8
head -c 3000 packing.h5 >packing-cut.h5
ends 2 run 2 1 loadings bad --set packing=packing-cut.h5
[[ $(mpfem 2 check loadings.toml | grep -c '^packing ') == 1 ]] || fail "check prints more than once"
[[ $(mpfem 2 bench --tets 2000 --grains 8 --steps 6 --quiet | grep -c '^total ') == 1 ]] || fail "bench fails"
ends 2 "$mpiexec" -n 1 "$bin/mpfem" run loadings.toml -o bad.h5 : \
  -n 1 "$bin/mpfem" run loadings.toml -o bad.h5 --set material.youngs_modulus=6000
grep -q 'youngs_modulus = 5000.* on rank 0 and youngs_modulus = 6000.* on rank 1' log ||
  { cat log >&2; fail "two scenarios"; }
echo "mistakes are told once"

# What bench tells of several ranks: the packing of one, and every cost but those of a search and the work of contact.
for ranks in 1 2; do mpfem "$ranks" bench --tets 2000 --grains 8 --steps 6 --json >"bench-$ranks"; done
packing='"(tets|grains|relative_density|bonds|contact_points|candidate_points|flop_per_tet_step)": '
diff <(grep -E "$packing" bench-1) <(grep -E "$packing" bench-2) || fail "bench counts otherwise on two ranks"
keys() { awk -F'"' 'NF > 1 { print $2 }' "$1" | sort; }
[[ $(comm -23 <(keys bench-1) <(keys bench-2) | grep -vcE '^(contact_G|search_|steps_per_search)') == 0 ]] ||
  fail "bench leaves out costs of two ranks"
costs='element_pass_ns|contact_ns|message_wait|sum_wait|imbalance|output_ns|history_row|checkpoint_|memory|triad|fma'
awk -F'[:,]' -v costs="$costs" '$1 ~ costs && !($2 > 0) { print; bad = 1 } END { exit bad }' bench-2 >&2 ||
  fail "bench measures nothing"
echo "bench measures ranks too"
