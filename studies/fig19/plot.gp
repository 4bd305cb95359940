# gnuplot -c plot.gp png|svg damage|plastic tests.csv IMAGE
call 'studies/common/style.gp' ARG1
data = ARG3
set output ARG4
set xlabel 'axial strain ε_a'
set xrange [0:0.15]
set yrange [0:*]
densities = '0.92 0.86 0.80 0.73'
test(d, column) = strcol(2) eq 'energy' && column(4) == d + 0 ? column : NaN
if (ARG2 eq 'damage') {
  set ylabel 'energy dissipated by damage / nJ'
  scale = 1e6
  y = 11
} else {
  set ylabel 'energy dissipated by plastic flow / mJ'
  scale = 1
  y = 10
}
set key title 'largest D_r' left
plot for [i = 1:words(densities)] data skip 1 using (test(word(densities, i), column(6))):(scale * column(y)) with lines linetype i title word(densities, i)
