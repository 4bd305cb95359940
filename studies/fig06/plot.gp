# gnuplot -c plot.gp png|svg FOLDER IMAGE
call 'studies/common/style.gp' ARG1
folder = ARG2
set output ARG3
set xlabel 'diameter / mm'
set ylabel 'cumulative fraction by number'
set xrange [0.09:0.22]
set yrange [0:1.02]
set key right bottom Right noreverse
plot folder.'/target.csv' skip 1 using 1:2 with lines linetype 2 title 'target', \
     folder.'/size-distribution.csv' skip 1 using 1:2 with points linetype 1 pointsize 0.6 title 'grains'
