# gnuplot -c plot.gp png|svg stress-path.csv IMAGE
call 'studies/common/style.gp' ARG1
data = ARG2
set output ARG3
set xlabel 'mean stress p / MPa'
set ylabel 'deviatoric stress q / MPa'
set xrange [0:*]
set key right top Right noreverse
part(name, column) = strcol(1) eq name ? column : NaN
plot data skip 1 using (part('loading', $4)):5 with lines linetype 1 title 'isotropic compression', \
     data skip 1 using (part('unloading', $4)):5 with lines linetype 2 title 'isotropic unloading', \
     data skip 1 using (part('test', $4)):5 with lines linetype 3 title 'triaxial compression'
