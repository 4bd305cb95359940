# bash completion for pack-gen, mpfem and postproc. Subcommands and options come from their --help, so that this file
# knows none of them.

_mpfem_words() {
  "$@" --help 2>/dev/null | awk '
    /^Subcommands:/ { listed = 1; next }
    /^[^ ]/ { listed = 0 }
    listed && /^  [a-z]/ { print $1 }
    /^  -/ { n = split($1, words, ","); for (i = 1; i <= n; ++i) if (words[i] ~ /^--/) print words[i] }'
}

_mpfem() {
  local program=${COMP_WORDS[0]} word=${COMP_WORDS[COMP_CWORD]}
  local command=("$program")
  if ((COMP_CWORD > 1)) && [[ ${COMP_WORDS[1]} != -* ]]; then command+=("${COMP_WORDS[1]}"); fi
  COMPREPLY=()
  if [[ $word == -* ]] || ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$(_mpfem_words "${command[@]}")" -- "$word")
  fi
}

complete -o default -F _mpfem pack-gen mpfem postproc
