# gnuplot -c plot.gp png|svg NAME loops.csv IMAGE: p over D_r of one sample, with the lower ends of the loops enlarged.
call 'studies/common/style.gp' ARG1
data = ARG3
set output ARG4
set xlabel 'relative density D_r'
set ylabel 'mean stress p / MPa'
set yrange [0:100]
sample(column) = strcol(1) eq ARG2 ? column : NaN
set key left top
set multiplot
# Cycles one after the other from light to dark.
set cbrange [0:8]
set palette defined (0 '#c6dbef', 4 '#4292c6', 8 '#08306b')
set cblabel 'cycle'
set colorbox user origin 0.90,0.2 size 0.02,0.6
set rmargin at screen 0.86
plot data skip 1 using (sample(column(3))):4:2 with lines linewidth 1.5 palette
stats data skip 1 using (strcol(1) eq ARG2 && $2 >= 2 && $4 < 12 ? $3 : NaN) nooutput
set origin 0.14,0.42
set size 0.42,0.48
set rmargin -1
unset colorbox
set xrange [STATS_min - 0.0005 : STATS_max + 0.0005]
set yrange [0:12]
set xlabel ''
set ylabel ''
set tics font ',14'
set format x '%.3f'
set xtics STATS_max - STATS_min < 0.009 ? 0.002 : 0.005
set object 1 rectangle from graph -0.14,-0.12 to graph 1.02,1.04 behind fillcolor rgb 'white' fillstyle solid noborder
replot
unset multiplot
