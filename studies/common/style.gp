# The look of all plots.   call 'studies/common/style.gp' png|svg   (load would hide the format: it has no arguments of
# its own)
if (ARG1 eq 'svg') {
  # Letters, dashes and ticks as long as in a png; studies/common/gnuplot.sh does the same for points.
  set terminal svg size 1200,900 dynamic enhanced font 'DejaVu Sans,20' fontscale 1.3333 linewidth 1.5 \
    dashlength 0.5 background 'white'
  set tics scale 0.8
} else {
  set terminal pngcairo size 1200,900 enhanced font 'DejaVu Sans,20' linewidth 1.5
}
# Dashes, dots and long dashes: gnuplot's own patterns differ from format to format.
set dashtype 2 (12, 10)
set dashtype 3 (4, 6)
set dashtype 4 (24, 10)
set encoding utf8
set datafile separator ','
set border 3 linewidth 1.2
set tics nomirror out
set grid linecolor rgb '#dddddd' linetype 1
set key left top Left reverse samplen 2 spacing 1.2 noautotitle
# With SEEDS: `gnuplot -e 'packings = N'`. Error bars are drawn `for [i = 1:several]`, never without.
several = exists('packings') ? 1 : 0
spread_title = several ? sprintf('mean and standard deviation of %d packings', packings) : ''
# Colours that stay apart for colour-blind readers (Okabe and Ito).
set linetype 1 linecolor rgb '#0072b2' linewidth 2 pointtype 7
set linetype 2 linecolor rgb '#d55e00' linewidth 2 pointtype 5
set linetype 3 linecolor rgb '#009e73' linewidth 2 pointtype 9
set linetype 4 linecolor rgb '#cc79a7' linewidth 2 pointtype 11
set linetype 5 linecolor rgb '#000000' linewidth 2 pointtype 13
set linetype 6 linecolor rgb '#56b4e9' linewidth 2 pointtype 2
