# gnuplot -c plot.gp png|svg strength-density|strength-area FOLDER IMAGE
load 'studies/common/style.gp'
picture = ARG2
folder = ARG3
set output ARG4
set ylabel 'unconfined strength / MPa'
table = folder.'/strength.csv'
if (picture eq 'strength-density') {
  set xlabel 'maximum relative density D_r^{max}'
  set xrange [0.61:0.78]
  set yrange [0:*]
  set format x '%.2f'
  fit = folder.'/strength.density.fits.csv'
  plot fit skip 1 using 1:2 with lines linetype 2 title 'Ryshkewitch–Duckworth', \
       fit skip 1 using 1:3 with lines linetype 5 dashtype 2 linewidth 1 title 'Rumpf', \
       table skip 1 using 4:5:6 with yerrorbars linetype 1 pointsize 1.5 title 'computed'
} else {
  set xlabel 'contact-area ratio'
  set logscale xy
  set format x '%.2g'
  plot folder.'/strength.area.fits.csv' skip 1 using 1:2 with lines linetype 2 title 'power law (at D_r^{max})', \
       table skip 1 using 11:5:6 with yerrorbars linetype 1 pointsize 1.5 title 'computed, contact area at D_r^{max}', \
       table skip 1 using 12:5:6 with yerrorbars linetype 3 pointsize 1.5 title 'contact area after unloading'
}
