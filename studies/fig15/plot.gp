# gnuplot -c plot.gp png|svg force-displacement|force-displacement-energy-law FOLDER IMAGE
call 'studies/common/style.gp' ARG1
folder = ARG3
set output ARG4
energies = '0.01 0.02 0.05 0.1 0.2 0.3 0.4 0.5'
table = folder.'/'.ARG2.'.csv'
set linetype 6 linecolor rgb '#e69f00' linewidth 2
set linetype 7 linecolor rgb '#56b4e9' linewidth 2
set linetype 8 linecolor rgb '#999999' linewidth 2
set xlabel 'displacement of the upper plate towards the lower / mm'
set ylabel 'force of the upper plate / N'
set title (ARG2 eq 'force-displacement' ? 'softening law exponential' : 'softening law energy')
set xrange [0:*]
set yrange [0:*]
set key right bottom title 'G^c / (N/mm)'
present = ''
do for [e in energies] {
  if (int(system(sprintf("grep -c '^%s,' '%s' || true", e, table))) > 0) { present = present . ' ' . e }
}
plot for [i=1:words(present)] table skip 1 using 2:($1 == word(present, i) + 0 ? $3 : NaN) with lines linetype i title word(present, i)
