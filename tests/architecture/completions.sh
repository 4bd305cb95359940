#!/usr/bin/env bash
# completions.sh COMPLETIONS BIN: the completion of each installed shell (bash, zsh, fish) offers every subcommand and
# every long option that --help of the programs in BIN names. Exit code 1: it does not, and the differences are printed.
# shellcheck disable=SC2016,SC2317 # programs of other shells in quotes; functions called by the name of a shell
set -euo pipefail
completions=$1
export PATH="$2:$PATH"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Lines to complete on standard input; "LINE: WORD" for each word offered.
bash_offers() {
  # shellcheck source=/dev/null
  source "$completions/completion.bash"
  while IFS= read -r line; do
    read -ra COMP_WORDS <<<"$line"
    [[ $line != *' ' ]] || COMP_WORDS+=('')
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _mpfem
    printf "$line: %s\n" "${COMPREPLY[@]}"
  done
}
zsh_offers() {
  zsh -f -c '
    _files() { }
    compadd() { shift; print -l -- "$line: "${^@}; }
    complete_line() { source $1; }
    while IFS= read -r line; do
      words=(${(s: :)line})
      [[ $line != *" " ]] || words+=("")
      CURRENT=$#words
      complete_line $1
    done' zsh "$completions/completion.zsh"
}
fish_offers() {
  fish --no-config -c '
    source $argv[1]
    while read -l --delimiter=\n line
      for word in (complete -C "$line"); echo "$line: $word"; end
    end' "$completions/completion.fish"
}

# Of a program or, as further words, one of its subcommands.
options_of() { "$@" --help | grep -oE '^  (-[a-zA-Z],)?--[a-z0-9-]+' | grep -oE -e '--[a-z0-9-]+'; }
subcommands_of() { "$1" --help | sed '1,/^Subcommands:/d' | grep -oE '^  [a-z][a-z0-9-]*' | tr -d ' '; }

for program in pack-gen mpfem postproc; do
  subcommands_of "$program" | sed "s/^/$program : /"
  for command in "$program" $(subcommands_of "$program" | sed "s/^/$program#/"); do
    # shellcheck disable=SC2086 # program and subcommand
    options_of ${command//#/ } | sed "s/^/${command//#/ } --: /"
  done
done | sort -u >"$work/expected"
(($(wc -l <"$work/expected") > 200)) || { echo "completions.sh: the programs have too few options" >&2 && exit 1; }
sed 's/: .*//' "$work/expected" | sort -u >"$work/lines"

code=0
for shell in bash zsh fish; do
  command -v $shell >/dev/null || continue
  $shell -n "$completions/completion.$shell" || code=1
  # At the first word options may be offered too.
  "${shell}_offers" <"$work/lines" | grep -vE '^[a-z-]+ : -' | grep -vE -- ' --: [^-]' | sort -u >"$work/$shell"
  diff "$work/expected" "$work/$shell" >"$work/difference" ||
    { echo "completion of $shell, named by --help < and > offered:" && head -20 "$work/difference" && code=1; }
done
exit "$code"
