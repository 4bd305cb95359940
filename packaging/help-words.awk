# The subcommands and long options in the --help of a program or a subcommand, one a line; a flag that says no is shown
# as --no-bonds{false}. Stands in single quotes in the completions of all shells: no backslash, no single quote.
/^Subcommands:/ { listed = 1; next }
/^[^ ]/ { listed = 0 }
listed && /^  [a-z]/ { print $1 }
/^  -/ {
  sub(/[{].*/, "", $1)
  n = split($1, words, ",")
  for (i = 1; i <= n; ++i) if (words[i] ~ /^--/) print words[i]
}
