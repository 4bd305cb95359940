# gnuplot -c plot.gp png|svg force-displacement FOLDER IMAGE
load 'studies/common/style.gp'
folder = ARG3
set output ARG4
energies = '0.05 0.1 0.2 0.3 0.4 0.5'
set linetype 6 linecolor rgb '#e69f00' linewidth 2 pointtype 15
set xlabel 'displacement of the upper plate towards the lower / mm'
set ylabel 'force of the upper plate / N'
set xrange [0:*]
set yrange [0:*]
set key right bottom title 'G^c / (N/mm)'
plot for [i=1:words(energies)] folder.'/force-displacement.csv' skip 1 using 2:($1 == word(energies, i) + 0 ? $3 : NaN) with lines linetype i title word(energies, i)
