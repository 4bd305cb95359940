# gnuplot -c plot-path.gp png|svg stress-path.csv yield.csv IMAGE
call 'studies/common/style.gp' ARG1
data = ARG2
yield = ARG3
set output ARG4
set xlabel 'mean stress p / MPa'
set ylabel 'deviatoric stress q / MPa'
set xrange [0:*]
part(name, column) = strcol(1) eq name ? column : NaN
plot data skip 1 using (part('loading', $4)):5 with lines linetype 1 title '(1) isotropic loading', \
     data skip 1 using (part('unloading', $4)):5 with lines linetype 2 title '(2) isotropic unloading', \
     data skip 1 using (part('test', $4)):5 with lines linetype 3 title '(3) probe', \
     yield skip 1 using 2:3 with points linetype 5 pointsize 2 title 'yield'
