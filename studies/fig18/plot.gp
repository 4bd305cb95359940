# gnuplot -c plot.gp png|svg deviatoric-stress|volumetric-strain tests.csv IMAGE
call 'studies/common/style.gp' ARG1
data = ARG3
set output ARG4
set xlabel 'axial strain ε_a'
set xrange [0:0.15]
densities = '0.92 0.86 0.80 0.73'
test(law, d, column) = strcol(2) eq law && column(4) == d + 0 ? column : NaN
if (ARG2 eq 'deviatoric-stress') {
  set ylabel 'deviatoric stress q / MPa'
  set yrange [0:*]
  y = 9
} else {
  set ylabel 'volumetric strain ε_v (contraction positive)'
  y = 7
}
set key outside right center vertical Left reverse samplen 1.5 spacing 1.3
set key title 'largest D_r' left
plot for [i = 1:words(densities)] data skip 1 using (test('energy', word(densities, i), column(6))):y \
       with lines linetype i title word(densities, i), \
     for [i = 1:words(densities)] data skip 1 using (test('exponential', word(densities, i), column(6))):y \
       with lines linetype i dashtype (8, 4) title (word(densities, i) eq '0.92' || word(densities, i) eq '0.80' ? word(densities, i).', exponential' : '')
