# gnuplot -c plot.gp png|svg FOLDER IMAGE
call 'studies/common/style.gp' ARG1
folder = ARG2
data = folder.'/load-density.csv'
set output ARG3
set xlabel 'relative density D_r'
set ylabel 'mean stress p / MPa'
set xrange [*:0.93]
set yrange [0:*]
set xtics 0.05
meshes = 'smoke coarse intermediate medium paper'
label(m) = m eq 'smoke' ? '0.03 mm, small packing' : m eq 'coarse' ? '0.03 mm' : m eq 'intermediate' ? '0.025 mm' : \
           m eq 'medium' ? '0.015 mm' : '0.0075 mm'
present = ''
do for [m in meshes] {
  if (int(system(sprintf("grep -c '^%s,' '%s' || true", m, data))) > 0) { present = present . ' ' . m }
}
set key title 'element size' left
plot for [i = 1:words(present)] data skip 1 \
  using 2:(strcol(1) eq word(present, i) ? column(3) : NaN) with lines linetype i title label(word(present, i)), \
  for [i = 1:several] folder.'/at-densities.spread.csv' skip 1 using 3:5:6 with yerrorbars linetype 5 pointsize 1.2 title spread_title
