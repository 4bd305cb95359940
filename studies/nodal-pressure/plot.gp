# gnuplot -c plot.gp png|svg CYCLES.csv IMAGE: oscillation of tets' own pressure about the averaged one, over half
# cycles
call 'studies/common/style.gp' ARG1
set output ARG3
set xlabel 'half cycle (odd: at the high stress, even: at the low one)'
set ylabel 'root mean square over tets, MPa'
set yrange [0:400]
set key top left
plot for [e in 'tet4-anp tet4-patch tet4'] ARG2 skip 1 \
       using 3:(strcol(1) eq e && strcol(2) eq 'cycles' && $6 > 30 ? $9 : NaN) \
       with points title e . ': own less averaged pressure', \
     for [e in 'tet4-anp tet4-patch tet4'] ARG2 skip 1 \
       using 3:(strcol(1) eq e && strcol(2) eq 'cycles' && $6 > 30 ? $10 : NaN) \
       with points title e . ': node less neighbours'
