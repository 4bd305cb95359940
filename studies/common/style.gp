# The look of all plots.   call 'studies/common/style.gp' png|svg   (load would hide the format: it has no arguments of
# its own)
if (ARG1 eq 'svg') {
  set terminal svg size 800,600 dynamic enhanced font 'DejaVu Sans,16' background 'white'
} else {
  set terminal pngcairo size 1200,900 enhanced font 'DejaVu Sans,20' linewidth 1.5
}
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
