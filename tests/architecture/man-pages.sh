#!/usr/bin/env bash
# man-pages.sh BIN: man pages of the programs in BIN keep the lines of examples and snippets, and that of `postproc
# picture` has its options. Pages are rendered where `man` is found. Exit code 1: they do not, and the lines are
# printed; 77: help2man, which makes them, is missing.
set -euo pipefail
here=$(dirname "${BASH_SOURCE[0]}")
bin=$1
command -v help2man >/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$here/../../packaging/man-pages.sh" "$bin" "$work"

# Lines of a page between .nf and .fi, as they are shown.
kept_of() { sed -n '/^\.nf$/,/^\.fi$/p' "$1" | sed 's/\\-/-/g; s/\\e/\\/g; s/^\\&//'; }
# Lines of a page as a wide terminal shows them, without indentation and marks of bold letters.
rendered_of() { MANWIDTH=300 man -l "$1" 2>/dev/null | sed 's/.\x08//g; s/^ *//'; }

code=0
lines=0
# expect PAGE LINE: the line stands in the page by itself.
expect() {
  lines=$((lines + 1))
  grep -qxF -- "$2" "$work/kept" || { echo "man-pages.sh: $1: not kept: $2" >&2 && code=1; }
  [[ ! -s $work/rendered ]] || grep -qxF -- "${2#"${2%%[! ]*}"}" "$work/rendered" ||
    { echo "man-pages.sh: $1: not shown as a line: $2" >&2 && code=1; }
}

for program in pack-gen mpfem postproc; do
  for page in "$work/$program"*.1; do
    name=$(basename "$page" .1)
    subcommand=${name#"$program"}
    kept_of "$page" >"$work/kept"
    : >"$work/rendered"
    ! command -v man >/dev/null || rendered_of "$page" >"$work/rendered"
    # shellcheck disable=SC2086 # none or one word
    while IFS= read -r line; do expect "$name" "$line"; done < <("$bin/$program" ${subcommand#-} --help |
      sed '/^Usage:/,$d' | grep -E '^(  |Example: )')
  done
done
((lines > 80)) || { echo "man-pages.sh: found only $lines lines of examples in all pages" >&2 && code=1; }
grep -q -- '\\-\\-camera' "$work/postproc-picture.1" ||
  { echo "man-pages.sh: postproc-picture.1 lacks the options of picture" >&2 && code=1; }
exit $code
