# gnuplot -c plot.gp png|svg recovery-density|recovery-modulus FOLDER IMAGE
call 'studies/common/style.gp' ARG1
picture = ARG2
folder = ARG3
set output ARG4
set ylabel 'elastic recovery R_E / %'
if (picture eq 'recovery-density') {
  set xlabel 'maximum relative density D_r^{max}'
  set xrange [0.68:0.94]
  set key right bottom
  set yrange [0:*]
  set format x '%.2f'
  plot folder.'/density.recovery.fits.csv' skip 1 using 1:(100*$3) with lines linetype 1 title 'two lines', \
       folder.'/density-energy-law.recovery.fits.csv' skip 1 using 1:(100*$3) with lines linetype 2, \
       folder.'/density.recovery.fits.csv' skip 1 using 1:(100*$2) with lines linetype 1 dashtype 2 linewidth 1 title 'one line', \
       folder.'/density.csv' skip 1 using 4:(100*$5):(100*$6) with yerrorbars linetype 1 pointsize 1.5 title 'computed, softening law exponential', \
       folder.'/density-energy-law.csv' skip 1 using 4:(100*$5):(100*$6) with yerrorbars linetype 2 pointsize 1.5 title 'softening law energy', \
       for [i = 1:several] folder.'/density.spread.csv' skip 1 using 5:(100*$7):(100*$8) with yerrorbars linetype 5 pointtype 6 pointsize 1.5 title spread_title, \
       for [i = 1:several] folder.'/density-energy-law.spread.csv' skip 1 using 5:(100*$7):(100*$8) with yerrorbars linetype 4 pointtype 6 pointsize 1.5 notitle
} else {
  set xlabel 'Young''s modulus of the grains E / GPa'
  set logscale xy
  set xrange [2.7:9]
  set xtics (3, 4, 5, 6, 7, 8)
  set yrange [2:20]
  set ytics (2, 3, 4, 5, 6, 8, 10, 15, 20)
  set key right
  plot folder.'/modulus.recovery.fits.csv' skip 1 using ($1/1000):(100*$2) with lines linetype 2 title 'power law', \
       folder.'/modulus.csv' skip 1 using ($2/1000):(100*$5):(100*$6) with yerrorbars linetype 1 pointsize 1.5 title 'computed', \
       for [i = 1:several] folder.'/modulus.spread.csv' skip 1 using ($3/1000):(100*$7):(100*$8) with yerrorbars linetype 5 pointtype 6 pointsize 1.5 title spread_title
}
