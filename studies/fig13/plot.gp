# gnuplot -c plot.gp png|svg strength-density|strength-area FOLDER IMAGE
call 'studies/common/style.gp' ARG1
picture = ARG2
folder = ARG3
set output ARG4
set ylabel 'unconfined strength / MPa'
set logscale y
table(law) = folder.'/strength'.law.'.csv'
fit(law, what) = folder.'/strength'.law.'.'.what.'.fits.csv'
if (picture eq 'strength-density') {
  set xlabel 'maximum relative density D_r^{max}'
  set xrange [0.61:0.78]
  set format x '%.2f'
  set key right bottom
  plot fit('', 'density') skip 1 using 1:2 with lines linetype 1 title 'Ryshkewitch–Duckworth', \
       '' skip 1 using 1:3 with lines linetype 1 dashtype 2 linewidth 1 title 'Rumpf', \
       table('') skip 1 using 4:5:6 with yerrorbars linetype 1 pointsize 1.5 title 'computed, softening law exponential', \
       fit('-energy-law', 'density') skip 1 using 1:2 with lines linetype 2, \
       '' skip 1 using 1:3 with lines linetype 2 dashtype 2 linewidth 1, \
       table('-energy-law') skip 1 using 4:5:6 with yerrorbars linetype 2 pointsize 1.5 title 'softening law energy', \
       for [i = 1:several] folder.'/strength.spread.csv' skip 1 using 3:7:8 with yerrorbars linetype 5 pointtype 6 pointsize 1.5 title spread_title, \
       for [i = 1:several] folder.'/strength-energy-law.spread.csv' skip 1 using 3:7:8 with yerrorbars linetype 4 pointtype 6 pointsize 1.5 notitle
} else {
  set xlabel 'contact-area ratio'
  set logscale x
  set xtics (0.005, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3)
  set key left top
  plot fit('', 'area') skip 1 using 1:2 with lines linetype 1 title 'power law', \
       table('') skip 1 using 11:5:6 with yerrorbars linetype 1 pointsize 1.5 title 'contact area at D_r^{max}, law exponential', \
       table('') skip 1 using 12:5:6 with yerrorbars linetype 3 pointsize 1.5 title 'after unloading', \
       fit('-energy-law', 'area') skip 1 using 1:2 with lines linetype 2, \
       table('-energy-law') skip 1 using 11:5:6 with yerrorbars linetype 2 pointsize 1.5 title 'at D_r^{max}, law energy', \
       for [i = 1:several] folder.'/strength.spread.csv' skip 1 using 5:7:8 with yerrorbars linetype 5 pointtype 6 pointsize 1.5 title spread_title, \
       for [i = 1:several] folder.'/strength-energy-law.spread.csv' skip 1 using 5:7:8 with yerrorbars linetype 4 pointtype 6 pointsize 1.5 notitle
}
