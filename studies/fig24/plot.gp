# gnuplot -c plot.gp png|svg yield.csv IMAGE
call 'studies/common/style.gp' ARG1
data = ARG2
set output ARG3
set xlabel 'mean stress p / MPa'
set ylabel 'deviatoric stress q / MPa'
set xrange [0:*]
set xzeroaxis linewidth 1 linecolor rgb '#777777' linetype 1
set key outside top center horizontal Left reverse samplen 2
yield(law, g) = strcol(1) eq law && column(2) == g ? column(5) : NaN
# The lines on which a wall would have to pull.
set samples 200
lateral(x) = 3 * x
axial(x) = -1.5 * x
set yrange [-80:80]
plot data skip 1 using (yield('energy', 0.5)):6 with linespoints linetype 1 pointsize 1.6 title 'with cohesion', \
     data skip 1 using (yield('exponential', 0)):6 with linespoints linetype 2 pointsize 1.6 title 'without', \
     data skip 1 using (yield('exponential', 0.5)):6 with linespoints linetype 3 dashtype (8, 4) pointsize 1.6 title 'with, exponential', \
     lateral(x) with lines linewidth 1 dashtype (2, 3) linecolor rgb '#777777' title 'a wall bears nothing', \
     axial(x) with lines linewidth 1 dashtype (2, 3) linecolor rgb '#777777' notitle
