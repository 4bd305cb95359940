# gnuplot -c plot.gp png|svg meshes.csv IMAGE: tetrahedra of a grain against nominal size, beside the paper's.
call 'studies/common/style.gp' ARG1
data = ARG2
set output ARG3
set xlabel 'nominal element size / mm'
set ylabel 'tetrahedra of a grain, mean'
set logscale xy
set xrange [0.006:0.036]
set yrange [300:60000]
set xtics (0.0075, 0.01, 0.015, 0.02, 0.025, 0.03)
set format y '%.0f'
set key right top Right noreverse
plot data skip 1 using 1:6 with points linetype 2 pointsize 2.2 title 'Ku et al., Fig. 7', \
     data skip 1 using 1:($4 > 0 ? $4/$2 : NaN) with points linetype 1 pointsize 1.6 title 'here'
