#!/usr/bin/env bash
# man-pages.sh BIN FOLDER: writes a man page (section 1) of each program in BIN and of each of its subcommands into
# FOLDER, from their --help, through help2man.
set -euo pipefail
export LC_ALL=C.UTF-8 # ranges in --help have an ellipsis
bin=$1
folder=$2

declare -A names=(
  [pack-gen]='pack spheres of a size distribution and mesh them'
  [mpfem]='compaction of deformable grains by the multi-particle finite element method'
  [postproc]='curves, numbers and pictures of mpfem runs'
)

# "NAME DESCRIPTION" of each subcommand, as the program's own --help lists them.
subcommands() {
  "$bin/$1" --help |
    awk '/^Subcommands:/ { listed = 1; next } listed && /^  [a-z]/ { sub(/\.$/, ""); $1 = $1; print }'
}

here=$(dirname "${BASH_SOURCE[0]}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# page EXECUTABLE NAME DESCRIPTION; all programs have the same version.
page() {
  help2man --locale C.UTF-8 --no-info --no-discard-stderr --section 1 --source mpfem --manual 'User commands' \
    --name "$3" --version-string "$version" --output "$work/page" "$bin/$1"
  # shellcheck disable=SC2086 # program and subcommand
  "$bin/"$1 --help >"$work/help"
  awk -f "$here/man-text.awk" "$work/help" "$work/page" >"$folder/$2.1"
}

command -v help2man >/dev/null || {
  echo 'man-pages.sh: help2man is missing; on Debian: apt-get install help2man' >&2
  exit 1
}
mkdir -p "$folder"
rm -f "$folder"/*.1
version=$("$bin/postproc" --version | cut -d ' ' -f 2)
for program in "${!names[@]}"; do
  page "$program" "$program" "${names[$program]}"
  while read -r subcommand description; do
    page "$program $subcommand" "$program-$subcommand" "$description"
  done < <(subcommands "$program")
done
