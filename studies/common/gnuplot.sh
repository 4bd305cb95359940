#!/bin/sh
# gnuplot.sh -c PLOT.gp FORMAT ... IMAGE: gnuplot, whose points in an svg are then those of a png.
set -eu
gnuplot "$@"
for image; do :; done
case " $* " in
  *" svg "*)
    sed -E -f "$(dirname "$0")/svg-points.sed" "$image" > "$image.points"
    mv "$image.points" "$image"
    ;;
esac
