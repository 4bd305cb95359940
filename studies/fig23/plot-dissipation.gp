# gnuplot -c plot-dissipation.gp png|svg dissipation.csv yield.csv IMAGE: total dissipation over its value at the end of unloading.
call 'studies/common/style.gp' ARG1
data = ARG2
yield = ARG3
set output ARG4
set xlabel 'time / µs'
set ylabel 'dissipated energy over its value after unloading'
part(name, column) = strcol(1) eq name ? column : NaN
stats data skip 1 using (part('test', $2)) nooutput
set yrange [0:1.15]
set key at graph 0.02,0.82 left top Left
set arrow 1 from graph 0,first 1.003 to graph 1,first 1.003 nohead dashtype (8, 4) linecolor rgb '#777777'
set multiplot
plot data skip 1 using (part('loading', $2)):5 with lines linetype 1 title '(1) isotropic loading', \
     data skip 1 using (part('unloading', $2)):5 with lines linetype 2 title '(2) isotropic unloading', \
     data skip 1 using (part('test', $2)):5 with lines linetype 3 title '(3) probe', \
     yield skip 1 using 1:(1.003) with points linetype 5 pointsize 2 title 'yield: 1.003'
set origin 0.53,0.16
set size 0.44,0.45
unset key
set xrange [STATS_min - 0.15 * (STATS_max - STATS_min) : STATS_max]
set yrange [0.9995:1.0045]
set xlabel ''
set ylabel ''
set tics font ',14'
set format y '%.3f'
set ytics 0.001
set xtics auto
set object 1 rectangle from graph -0.16,-0.16 to graph 1.02,1.02 behind fillcolor rgb 'white' fillstyle solid noborder
replot
unset multiplot
