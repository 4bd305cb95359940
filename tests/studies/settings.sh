#!/usr/bin/env bash
# settings.sh POSTPROC: make refuses settings that it cannot use, in one line that says what is allowed, before it makes
# anything. Exit code 1: one is taken or refused otherwise; it is printed.
set -euo pipefail
bin=$(dirname "$(realpath "$1")")
here=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cp "$here/studies/examples/own-powder.toml" my.toml
sed '/^seed/d' my.toml >no-seed.toml
for name in 'my study' "a\$b" 'a#b' 'a%b' 'a:b' "a'b"; do cp my.toml "$name.toml"; done
mkdir 'my studies'
cp -r "$here/studies" 'my studies/'

code=0
# refused WORDS MAKE-ARGUMENTS: make says WORDS in the line of its error, and leaves no file.
refused() {
  local words=$1 message
  shift
  if message=$(make BIN="$bin" "$@" 2>&1); then
    echo "settings.sh: make $* is taken" && code=1
  elif [[ $(grep -c . <<<"$message") != 1 || $message != *"$words"* || -e out ]]; then
    echo "settings.sh: make $* says: $message" && code=1
  fi
}
study=(-f "$here/studies/rules.mk" study)

for name in 'my study' "a\$b" 'a#b' 'a%b' 'a:b' "a'b"; do
  refused "STUDY=$name.toml: allowed: a path of letters" "${study[@]}" STUDY="$name.toml"
done
refused "STUDY=none.toml: allowed: the file of a study" "${study[@]}" STUDY=none.toml
mkdir other
for name in fig06 compaction; do
  echo 'title = "without a powder"' >"other/$name.toml"
  refused "STUDY=other/$name.toml: the toolkit itself has something called $name" "${study[@]}" STUDY="other/$name.toml"
done
for name in report hard-cases FORCE; do
  cp my.toml "$name.toml"
  refused "STUDY=$name.toml: the toolkit itself has something called $name" "${study[@]}" STUDY="$name.toml"
done
study+=(STUDY=my.toml)
for threads in x 0 1.5 "'" '2 x'; do
  refused "THREADS=$threads: allowed: a whole" "${study[@]}" THREADS="$threads"
done
for setting in MESH='coarse paper' MESH=% MESH= SURFACE='facets smooth' ELEMENT='tet4 tet4-anp'; do
  refused "$setting: allowed: one of" "${study[@]}" "$setting"
done
refused 'SEED=2 3: found several, allowed: one' "${study[@]}" SEED='2 3'
refused 'BESIDE=a b: allowed: one name' "${study[@]}" BESIDE='a b'
for seeds in x "'" '2 x'; do refused "SEEDS=$seeds: allowed: whole" "${study[@]}" SEEDS="$seeds"; done
refused 'BIN=my studies: allowed: a path without spaces' "${study[@]}" BIN='my studies'
refused 'SEEDS=1: 1 is the seed of my.toml itself' "${study[@]}" SEEDS=1
refused 'SEEDS=2 1: 1 is the seed of no-seed.toml itself' "${study[@]}" STUDY=no-seed.toml SEEDS='2 1'
study[1]="$work/my studies/studies/rules.mk"
refused "${study[1]}: allowed: a path without spaces" "${study[@]}"
study[1]=$here/studies/rules.mk
make -n "${study[@]}" SEEDS='2 3' THREADS=2 BIN="$bin" >plan 2>&1 || { cat plan && code=1; }

# SEEDS without a series that shows a spread has no effect, and make says so.
note='note: SEEDS=2 3 has no effect: no series has spread = true'
grep -q "$note" plan || { echo "settings.sh: make says nothing of SEEDS without effect" && code=1; }
columns='["compaction_stress", "strength"]'
sed "s/^name = \"strength\"$/&\nspread = $columns/; s/group = [^,]*, title = [^,]* }/spread = true }/" my.toml |
  awk '/^\[\[plots/ { plots = 1 } !(plots && /^spread/)' >spread.toml
make -n "${study[@]}" STUDY=spread.toml SEEDS='2 3' BIN="$bin" >plan 2>&1 || { cat plan && code=1; }
grep -q 'SEED=2 out/own-seed2/spread/strength.csv' plan || { echo "settings.sh: SEEDS makes no packings" && code=1; }
! grep -q "$note" plan || { echo "settings.sh: make says that SEEDS of spread.toml has no effect" && code=1; }

# MESH does not change the mesh of a study with its own powder; make says so once, also where it calls itself.
note='note: MESH=smoke selects cases of my.toml, not its mesh'
make -n "${study[@]}" MESH=smoke SEEDS=2 BIN="$bin" >plan 2>&1 || { cat plan && code=1; }
[[ $(grep -c "$note" plan) == 1 ]] || { echo "settings.sh: make does not say once: $note" && code=1; }

# Plots depend on the tables that are drawn beside them.
mkdir -p out/other/my
touch out/other/my/strength.csv
make -n -p "${study[@]}" BESIDE=other BIN="$bin" >plan 2>&1 || true
grep -q '^out/own/my/strength.png:.* out/other/my/strength.csv' plan ||
  { echo 'settings.sh: strength.png does not depend on the table of BESIDE' && code=1; }
rm -r out

# A figure without cases for a mesh says so.
message=$(make -f "$here/studies/rules.mk" fig04 MESH=coarser BIN="$bin" 2>&1) && code=1
[[ $message == *"fig04/figure.toml has no cases with MESH=coarser, allowed: smoke coarse"* ]] ||
  { echo "settings.sh: make fig04 MESH=coarser says: $message" && code=1; }
rm -r out

# What SURFACE and ELEMENT replace in a scenario of the study's own is said, once.
sed 's/^surface = .*/surface = "smooth"/' "$here/studies/branches/press-and-crush.toml" >press.toml
sed 's/^programme = .*/programme = "press.toml"/' my.toml >own-scenario.toml
replaced='press.toml: contact.surface = facets of make replaces "smooth"; common_settings = false in [[runs]] keeps it'
notes_of() {
  make -n -f "$here/studies/rules.mk" study STUDY="$1" BIN="$bin" 2>&1 >plan | grep -cF "note: $replaced" || true
}
[[ $(notes_of own-scenario.toml) == 1 ]] || { echo "settings.sh: make does not say once that $replaced" && code=1; }
sed -i 's/^programme = .*/&\ncommon_settings = false/' own-scenario.toml
[[ $(notes_of own-scenario.toml) == 0 ]] || { echo "settings.sh: make says $replaced, which it does not" && code=1; }

# No name of a study is that of a variable of the rules: the plans of such studies differ only in their names.
plan_of() {
  cp my.toml "$1.toml"
  make -n -f "$here/studies/rules.mk" study STUDY="$1.toml" BIN="$bin" 2>&1
}
plan=$(plan_of plain-name)
for name in own table plot fit metric picture traced spread script verdict declared; do
  [[ $(plan_of "$name") == "${plan//plain-name/$name}" ]] ||
    { echo "settings.sh: make STUDY=$name.toml has another plan than other studies" && code=1; }
done

# A study has the name of its file or folder, wherever make is called. Another study of that name is refused.
mkdir -p one/tablet two/tablet
cp my.toml one/tablet/figure.toml
cp my.toml two/tablet/figure.toml
make -n -f "$here/studies/rules.mk" study STUDY=one/tablet/figure.toml BIN="$bin" >plan
grep -q 'out/own/tablet/' plan || { echo "settings.sh: one/tablet is not out/own/tablet" && code=1; }
(cd one/tablet && make -n -f "$here/studies/rules.mk" study STUDY=./figure.toml SURFACE=smooth BIN="$bin" >../plan)
grep -q 'out/own-smooth/tablet/' one/plan || { echo "settings.sh: ./figure.toml is not tablet" && code=1; }
mkdir -p out/own/tablet
realpath one/tablet/figure.toml >out/own/tablet/study.path
message=$(make -n -f "$here/studies/rules.mk" study STUDY=two/tablet/figure.toml BIN="$bin" 2>&1) && code=1
[[ $message == *"out/own/tablet/ has the results of $work/one/tablet/figure.toml, allowed"* ]] ||
  { echo "settings.sh: two studies of one name: $message" && code=1; }
rm -r out

# So it is in a folder whose path has spaces. The same study is taken again.
mkdir -p "it's a folder/"{one,two}
cp my.toml "it's a folder/one/s.toml"
cp my.toml "it's a folder/two/s.toml"
in_folder() {
  (cd "it's a folder" && make -n -f "$here/studies/rules.mk" study STUDY="$1/s.toml" BIN="$bin" 2>&1)
}
mkdir -p "it's a folder/out/own/s"
realpath "it's a folder/one/s.toml" >"it's a folder/out/own/s/study.path"
message=$(in_folder one) || { echo "settings.sh: $message" && code=1; }
[[ $(cat "it's a folder/out/own/s/study.path") == "$work/it's a folder/one/s.toml" ]] ||
  { echo "settings.sh: study.path has: $(cat "it's a folder/out/own/s/study.path")" && code=1; }
message=$(in_folder two) && code=1
[[ $message == *"has the results of $work/it's a folder/one/s.toml, allowed"* ]] ||
  { echo "settings.sh: two studies of one name in a folder with spaces: $message" && code=1; }

# clean with STUDY removes results of that study alone, with SEEDS those of all packings.
# cleans WHAT MAKE-ARGUMENTS
cleans() {
  local what=$1 plan
  shift
  plan=$(cd "$here" && make -n -f Makefile.studies clean BIN="$bin" "$@" 2>&1) || true
  [[ $plan == "rm -rf $what" ]] || { echo "settings.sh: make clean $* says: $plan" && code=1; }
}
cleans out/coarse
message=$(cd "$here" && make -n -f Makefile.studies clean BIN="$bin" STUDY=none.toml 2>&1) && code=1
[[ $message == *'STUDY=none.toml: allowed: the file of a study'* ]] ||
  { echo "settings.sh: make clean STUDY=none.toml says: $message" && code=1; }
cleans 'out/coarse out/coarse-seed2' SEEDS=2
cleans out/own/my STUDY="$work/my.toml"
cleans 'out/own/my out/own-seed2/my out/own-seed3/my' STUDY="$work/my.toml" SEEDS='2 3'

# Two studies must not replace each other's runs in a folder that both name.
folder='folder = "shared-{compaction_stress}-{fracture_energy}"'
for name in one two; do sed "s/^programme = .*/&\n$folder/" my.toml >"$name.toml"; done
mkdir -p out/own/two
realpath two.toml >out/own/two/study.path
message=$(make -n -f "$here/studies/rules.mk" study STUDY=one.toml BIN="$bin" 2>&1) && code=1
[[ $message == *"one.toml: folder: found 'shared-"*"/two.toml has another run, allowed: a folder of its own"* ]] ||
  { echo "settings.sh: two studies with one folder of runs: $message" && code=1; }
rm two.toml
message=$(make -n -f "$here/studies/rules.mk" study STUDY=one.toml BIN="$bin" 2>&1) ||
  { echo "settings.sh: a study that is no more keeps its folder: $message" && code=1; }
rm -r out

# A source tree takes its own build, whatever lies in a folder bin beside it; an installation takes its own programs.
mkdir -p bin tree share/mpfem
printf '#!/bin/sh\necho "bin beside" >&2\nexit 1\n' >bin/postproc
chmod +x bin/postproc
cp -r "$here/studies" tree/
cp "$here/studies/rules.mk" share/mpfem/Makefile.studies
# takes WORDS MAKEFILE
takes() {
  local message
  message=$(make -f "$2" study STUDY=my.toml 2>&1) || true
  [[ $message == *"$1"* ]] || { echo "settings.sh: make -f $2 says: $message" && code=1; }
}
takes 'tree/build/bin/postproc is not built' tree/studies/rules.mk
takes 'bin beside' share/mpfem/Makefile.studies
exit "$code"
