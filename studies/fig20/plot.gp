# gnuplot -c plot.gp png|svg deviatoric-stress|volumetric-strain tests.csv IMAGE
call 'studies/common/style.gp' ARG1
data = ARG3
set output ARG4
set xlabel 'axial strain ε_a'
set xrange [0:0.15]
energies = '0.5 0.2 0.1 0.05 0.02'
set linetype 5 linecolor rgb '#e69f00' linewidth 2
set linetype 6 linecolor rgb '#000000' linewidth 2
test(law, g, column) = strcol(2) eq law && column(3) == g + 0 ? column : NaN
if (ARG2 eq 'deviatoric-stress') {
  set ylabel 'deviatoric stress q / MPa'
  set yrange [0:*]
  y = 9
} else {
  set ylabel 'volumetric strain ε_v (contraction positive)'
  y = 7
}
set key outside right center vertical Left reverse samplen 1.5 spacing 1.3
set key title 'G^c / N mm^{-1}' left
plot for [i = 1:words(energies)] data skip 1 using (test('energy', word(energies, i), column(6))):y \
       with lines linetype i title word(energies, i), \
     data skip 1 using (test('exponential', '0', column(6))):y with lines linetype 6 title '0', \
     data skip 1 using (test('exponential', '0.5', column(6))):y with lines linetype 1 dashtype (8, 4) title '0.5, exponential', \
     data skip 1 using (test('exponential', '0.1', column(6))):y with lines linetype 3 dashtype (8, 4) title '0.1, exponential'
