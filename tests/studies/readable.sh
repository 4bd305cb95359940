#!/usr/bin/env bash
# readable.sh POSTPROC: postproc reads every study of this folder, also those that no test runs. Parts that studies
# include have no question of their own and are read with them. Exit code 1: a study is refused; its message is printed.
set -euo pipefail
postproc=$1
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mapfile -t studies < <(grep -l '^question' studies/*/*.toml)
((${#studies[@]} > 40)) || { echo "readable.sh: only ${#studies[@]} studies found" >&2 && exit 1; }

meshes=$(sed -n 's/^meshes := //p' studies/rules.mk | tr ' ' ,)
code=0
for study in "${studies[@]}"; do
  "$postproc" depends "$study" --meshes "$meshes" --packing packing.h5 --description powder.toml >/dev/null || code=1
done
exit "$code"
