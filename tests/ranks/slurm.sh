#!/usr/bin/env bash
# slurm.sh BIN: two ranks under Slurm are stopped in the ways that docs/cluster.md lists (but for Ctrl-C and errors),
# continued with --resume, and give bitwise the run of one process. Needs a working Slurm (docs/cluster.md sets one up
# on a single machine) and a build with MPI. Not run by ctest. Some three minutes on two idle cores.
set -euo pipefail
bin=$(realpath "${1:?usage: slurm.sh BIN}")
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() { echo "slurm.sh: $*" >&2 && exit 1; }
"$bin/pack-gen" spheres --quiet "$source/pack-gen/examples/mcc_ph102.toml" -o spheres.h5
"$bin/pack-gen" mesh --quiet spheres.h5 --size 0.05 -o packing.h5
mpfem=("$bin/mpfem" run "$source/studies/branches/compaction.toml" --set "packing=$folder/packing.h5"
  --set stages.0.relative_density=0.7 --set 'output.checkpoint_relative_densities=[]' --set output.checkpoint_interval=1
  --quiet)
ranks() { srun --mpi=pmix -n2 --job-name=mpfem-slurm-test "${mpfem[@]}" -o "$1" "${@:2}"; }
job() { squeue -h -t RUNNING --name=mpfem-slurm-test -o %A; }

"${mpfem[@]}" -o one.h5 >one.txt 2>&1 || fail "a run on one process failed: $(tail -n 1 one.txt)"
ranks two.h5 >two.txt 2>&1 || fail "a run on two ranks failed: $(tail -n 1 two.txt)"
"$bin/../tests/compare-runs" one.h5 two.h5 || fail "two ranks differ from one process"

# NAME EXIT_CODE COMMAND...: stops a run by a command some seconds after its start, continues and compares it.
stopped() {
  local name=$1 expected=$2 code=0
  ranks "$name.h5" >"$name.txt" 2>&1 &
  local launcher=$!
  for ((i = 0; i < 100; ++i)); do
    [[ ! -e $name.checkpoint.h5 ]] || break
    sleep 0.2
  done
  "${@:3}" || true
  wait "$launcher" || code=$?
  [[ $code == "$expected" ]] || fail "$name: exit code $code, expected $expected: $(tail -n 1 "$name.txt")"
  ranks "$name.h5" --resume >>"$name.txt" 2>&1 || fail "$name: --resume failed: $(tail -n 1 "$name.txt")"
  "$bin/../tests/compare-runs" one.h5 "$name.h5" || fail "$name: the continued run differs"
  echo "$name: exit code $code, continued, the same as one process"
}
# shellcheck disable=SC2317 # called by name
cancel() { scancel "$(job)"; }
# shellcheck disable=SC2317
cancel_usr1() { scancel --signal=USR1 "$(job)"; }
# shellcheck disable=SC2317
kill_rank() { pkill -KILL -n -f "^$bin/mpfem run .* -o kill-9.h5"; }
# shellcheck disable=SC2317
usr1_to_srun() { kill -USR1 "$(pgrep -f "^srun .* -o usr1-to-srun.h5" | head -n 1)"; }
# shellcheck disable=SC2317
term_to_srun() { kill -TERM "$(pgrep -f "^srun .* -o term-to-srun.h5" | head -n 1)"; }

stopped scancel 5 cancel
stopped scancel-usr1 5 cancel_usr1
stopped kill-9 137 kill_rank
stopped usr1-to-srun 5 usr1_to_srun
stopped term-to-srun 137 term_to_srun
