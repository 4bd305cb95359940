# gnuplot -c plot.gp png|svg normalised|energy|release FOLDER IMAGE
call 'studies/common/style.gp' ARG1
picture = ARG2
folder = ARG3
set output ARG4
moduli = '3000 4000 5000 6000 7000 8000'
set linetype 6 linecolor rgb '#e69f00' linewidth 2 pointtype 15
of(modulus, part, value) = (column(1) == modulus && strcol(2) eq part) ? value : NaN
if (picture eq 'release') {
  set xlabel 'Young''s modulus of the grains E / GPa'
  set ylabel 'energy / (E R̄^3)'
  set logscale y
  set format y '10^{%L}'
  set xrange [2.5:8.5]
  set yrange [*:*]
  set key right center
  table = folder.'/release.csv'
  plot table skip 1 using ($2/1000):13 with linespoints linetype 1 pointsize 1.5 title 'elastic energy released', \
       '' skip 1 using ($2/1000):14 with linespoints linetype 2 pointsize 1.5 title 'dissipated by damage, in all', \
       '' skip 1 using ($2/1000):15 with linespoints linetype 3 pointsize 1.5 title 'of it during unloading'
} else {
  set xlabel 'relative density D_r'
  normalised = picture eq 'normalised'
  set ylabel normalised ? 'elastic energy / (E R̄^3)' : 'elastic energy / mJ'
  value = normalised ? 5 : 4
  set xrange [0.55:0.95]
  set yrange [0:*]
  set key title 'E / GPa; dashed: unloading'
  plot for [i=1:words(moduli)] folder.'/curves.csv' skip 1 using 3:(of(word(moduli, i) + 0, 'loading', column(value))) with lines linetype i \
         title sprintf('%.0f', word(moduli, i) / 1000.0), \
       for [i=1:words(moduli)] folder.'/curves.csv' skip 1 using 3:(of(word(moduli, i) + 0, 'unloading', column(value))) with lines linetype i dashtype 2
}
