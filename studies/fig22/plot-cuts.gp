# gnuplot -c plot-cuts.gp png|svg confining-stress|fracture-energy points.csv cuts.csv IMAGE
call 'studies/common/style.gp' ARG1
points = ARG3
cuts_file = ARG4
set output ARG5
set ylabel 'strength q / MPa'
set yrange [0:*]
set key outside right center vertical Left reverse samplen 1.5 spacing 1.3
if (ARG2 eq 'confining-stress') {
  set xlabel 'confining stress p_c / MPa'
  energies = '0.5 0.1 0'
  set key title 'G^c / N mm^{-1}' left
  cut(g, column) = strcol(1) eq 'p' && column(2) == g + 0 ? column : NaN
  plot for [i = 1:words(energies)] cuts_file skip 1 using (cut(word(energies, i), column(3))):4 with lines linetype i title word(energies, i).', fit', \
       for [i = 1:words(energies)] cuts_file skip 1 using (cut(word(energies, i), column(3))):5 with lines linetype i dashtype (2, 3) linewidth 1.2 title word(energies, i).', paper', \
       for [i = 1:words(energies)] points skip 1 using (column(2) == word(energies, i) + 0 ? column(1) : NaN):3 with points linetype i pointsize 1.6 notitle
} else {
  set xlabel 'fracture energy G^c / N mm^{-1}'
  set key title 'p_c = 8 MPa' left
  plot cuts_file skip 1 using (strcol(1) eq 'g' ? $3 : NaN):4 with lines linetype 1 title 'fit', \
       cuts_file skip 1 using (strcol(1) eq 'g' ? $3 : NaN):5 with lines linetype 1 dashtype (2, 3) linewidth 1.2 title 'paper', \
       points skip 1 using ($1 == 8 ? $2 : NaN):3 with points linetype 1 pointsize 1.6 title 'tests'
}
