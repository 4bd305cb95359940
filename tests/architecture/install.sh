#!/usr/bin/env bash
# What cmake --install writes: the three programs, and their man pages or a line that says why there are none.
#
#   install.sh BUILD     BUILD: folder of a complete build
#
# Exit code 0: it does so; 1: not, and the reason is printed.
set -euo pipefail
build=$1
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
fail() {
  echo "install.sh: $*" >&2
  exit 1
}

said=$(cmake --install "$build" --prefix "$prefix")
for program in pack-gen mpfem postproc; do
  [[ -x $prefix/bin/$program ]] || fail "found no bin/$program"
  if [[ -e $build/man/made ]]; then
    [[ -s $prefix/share/man/man1/$program.1 ]] || fail "found no man page of $program"
  fi
done
if [[ -e $build/man/made ]]; then
  [[ $said != *'left out'* ]] || fail "found man pages, and a line that they are left out"
else
  [[ $said == *'Man pages are left out: they need help2man;'* ]] || fail "found neither man pages nor why: $said"
fi
