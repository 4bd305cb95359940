#!/bin/sh
# picture-in-svg.sh PICTURE.png: the same picture as an SVG, for documents that take nothing else. Sections are drawn
# pixel by pixel, so the SVG holds those pixels; what it draws cannot be taken apart.
set -eu
# Width and height are the first two numbers of the first chunk, of four bytes each, the largest first.
size=$(od -An -t u1 -j 16 -N 8 "$1" |
  awk '{ print (($1 * 256 + $2) * 256 + $3) * 256 + $4, (($5 * 256 + $6) * 256 + $7) * 256 + $8 }')
width=${size% *} height=${size#* }
printf '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
printf 'width="%s" height="%s" viewBox="0 0 %s %s">\n' "$width" "$height" "$width" "$height"
printf '<image width="%s" height="%s" xlink:href="data:image/png;base64,' "$width" "$height"
base64 "$1" | tr -d '\n'
printf '"/>\n</svg>\n'
