# gnuplot -c plot-energies.gp png|svg envelopes.csv IMAGE: how the fracture energy stretches the law, both axes in ratios.
call 'studies/common/style.gp' ARG1
if (ARG1 eq 'svg') {
  set terminal svg size 1200,560 dynamic enhanced font 'DejaVu Sans,14' background 'white'
} else {
  set terminal pngcairo size 1800,840 enhanced font 'DejaVu Sans,19' linewidth 1.5
}
data = ARG2
set output ARG3
energies = '0.001 0.01 0.1 0.5'
set logscale xy
set xrange [1:1e6]
set yrange [1:2000]
set format x '10^{%T}'
set xlabel 'opening δ_n / nm'
set ylabel 'normal traction / MPa'
set style arrow 1 nohead dashtype 2 linewidth 1.2 linecolor rgb '#666666'
set arrow 1 from 1,25 to 1e6,25 arrowstyle 1
set label 1 '25 MPa' at 8e5,29 right textcolor rgb '#444444'
set multiplot layout 1,2 margins 0.085,0.98,0.13,0.93 spacing 0.09,0
do for [law in 'exponential energy'] {
  set title sprintf('law "%s"', law)
  set key left top title 'G^c / (N/mm)' left
  plot for [i = 1:words(energies)] data skip 1 using (strcol(1) eq law && strcol(2) eq word(energies, i) && \
    column(4) > 0 ? 1e6 * column(3) : NaN):4 with lines linetype i title word(energies, i)
}
unset multiplot
