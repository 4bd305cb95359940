#!/usr/bin/env bash
# tests/fuzz/run.sh SECONDS [NAME…]: runs each fuzzer of build-fuzz/ (or those named) for so many seconds. They begin at
# the repository's own examples and at what was found before. Fails where one finds a crash, a leak, an input that takes
# more than 5 s or more than 1 GiB, and keeps that input in build-fuzz/found/NAME/: mend the reader, then add the input
# to tests/inputs/found/NAME/, where a test reads it from then on. With SEED=N and INPUTS=M in the environment, each
# fuzzer tries M inputs, nearly the same ones every time, unless the seconds are over before.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

(($# >= 1)) || {
  sed -n '2,6s/^# //p' "${BASH_SOURCE[0]}"
  exit 2
}
seconds=$1
shift
names=("$@")
((${#names[@]} > 0)) || names=(scenario assignments bond powder spheres points stl)

build='build-fuzz'
cmake --preset fuzz -DCMAKE_CXX_COMPILER_LAUNCHER=ccache >/dev/null
ninja --quiet -C $build

# Begins a corpus: what the repository holds already.
seed() {
  local name=$1 corpus=$2 file
  case $name in
    scenario) for file in studies/*/*.toml; do cp "$file" "$corpus/${file//\//-}"; done ;;
    powder) cp pack-gen/examples/*.toml "$corpus" ;;
    bond)
      for file in studies/fig03/*.csv; do
        { cat studies/fig03/law.toml; echo ---; cat "$file"; } >"$corpus/${file//\//-}"
      done
      ;;
    *) ;;
  esac
  for file in tests/fuzz/seeds/"$name"/* tests/inputs/found/"$name"/*; do
    if [[ -f $file ]]; then cp "$file" "$corpus"; fi
  done
}

# The keys and words that a reader knows, from its source.
dictionary() {
  grep -ohE '"[a-z][a-z_0-9-]+"' solver/scenario/*.cpp solver/run/bond_programme.cpp \
    pack-gen/packing_description.cpp | sort -u
}
dictionary >$build/words.dict

# Runs one fuzzer, and says what it found where it found anything.
fuzz() {
  local name=$1 failed=0
  local corpus=$build/corpus/$name found=$build/found/$name log=$build/$name.log
  # What earlier runs kept would change the sequence of inputs.
  if [[ -n ${INPUTS:-} ]]; then
    corpus=$build/corpus/same-inputs/$name
    rm -rf "$corpus"
  fi
  local same_addresses=() # the sequence depends on addresses too; some containers do not let them be fixed
  if [[ -n ${INPUTS:-} ]] && setarch --addr-no-randomize true 2>/dev/null; then
    same_addresses=(setarch --addr-no-randomize)
  fi
  mkdir -p "$corpus" "$found"
  seed "$name" "$corpus"
  "${same_addresses[@]}" "$build/bin/fuzz-$name" "$corpus" -max_total_time="$seconds" -timeout=5 \
    -rss_limit_mb=1024 -max_len=8192 -dict=$build/words.dict -artifact_prefix="$found/" -print_final_stats=1 \
    "-seed=${SEED:-0}" "-runs=${INPUTS:--1}" >"$log" 2>&1 || failed=1
  printf '%-12s %s inputs tried, %s kept\n' "$name" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" "$(find "$corpus" -type f | wc -l)"
  ((failed == 0)) || {
    tail -n 40 "$log"
    echo "FAILED: $name; the input is in $found/"
    return 1
  }
}

# As many at a time as there are cores.
export -f fuzz seed
export seconds build
printf '%s\n' "${names[@]}" | xargs -P "$(nproc)" -I{} bash -euo pipefail -c 'fuzz {}'
