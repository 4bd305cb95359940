# gnuplot -c plot.gp png|svg damage|plastic cycles.csv IMAGE
call 'studies/common/style.gp' ARG1
data = ARG3
set output ARG4
set xlabel 'cycle'
set xrange [0.5:*]
set xtics 1
sample(name, column) = strcol(1) eq name ? column : NaN
set key right top Right noreverse
if (ARG2 eq 'damage') {
  set logscale y
  set format y '10^{%L}'
} else {
  set yrange [0:*]
}
y = ARG2 eq 'damage' ? 9 : 8
set ylabel ARG2 eq 'damage' ? 'energy dissipated by damage in the cycle / mJ' : 'energy dissipated by plastic flow in the cycle / mJ'
plot data skip 1 using (sample('energy-g0.5', $2)):y with linespoints linetype 1 pointsize 1.4 title 'with cohesion', \
     data skip 1 using (sample('g0', $2)):(ARG2 eq 'damage' ? NaN : column(y)) with linespoints linetype 2 pointsize 1.4 title (ARG2 eq 'damage' ? '' : 'without'), \
     data skip 1 using (sample('g0.5', $2)):y with linespoints linetype 3 dashtype (8, 4) pointsize 1.4 title 'with, exponential'
