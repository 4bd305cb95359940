#!/usr/bin/env bash
# readable.sh POSTPROC: postproc reads every study of this folder with every mesh, also those that no test runs. Parts
# that studies include have no question of their own and are read with them. Exit code 1: a study is refused; its
# message is printed.
set -euo pipefail
postproc=$1
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mapfile -t studies < <(grep -l '^question' studies/*/*.toml)
((${#studies[@]} > 40)) || { echo "readable.sh: only ${#studies[@]} studies found" >&2 && exit 1; }

read -ra meshes < <(sed -n 's/^meshes := //p' studies/rules.mk)
((${#meshes[@]} > 4)) || { echo "readable.sh: only ${#meshes[@]} meshes found" >&2 && exit 1; }
all=$(IFS=, && echo "${meshes[*]}")
code=0
for mesh in "${meshes[@]}"; do
  for study in "${studies[@]}"; do
    "$postproc" depends "$study" --mesh "$mesh" --results "out/$mesh" --meshes "$all" --packing packing.h5 \
      --description powder.toml >/dev/null || { echo "readable.sh: $study with MESH=$mesh" >&2 && code=1; }
  done
done
exit "$code"
