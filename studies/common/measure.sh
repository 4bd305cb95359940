# shellcheck shell=sh disable=SC2154
# measure.sh, sourced: measure FILE ARGUMENT... makes $folder/FILE from what "$bin/$program" prints with these
# arguments. What is there is not measured again, so that an interrupted call goes on where it stood.
measure() {
  file=$folder/$1
  shift
  [ -e "$file" ] && return
  echo "$program $*" >&2
  "$bin/$program" "$@" > "$file.partial"
  mv "$file.partial" "$file"
}
