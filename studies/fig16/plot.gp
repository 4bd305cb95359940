# gnuplot -c plot.gp png|svg modulus|strength FOLDER IMAGE
call 'studies/common/style.gp' ARG1
picture = ARG2
folder = ARG3
set output ARG4
set xlabel 'fracture energy G^c / (N/mm)'
set xrange [0:0.55]
set yrange [0:*]
set key outside center above maxcols 1
table(law) = folder.'/energy'.law.'.csv'
fit(law) = folder.'/energy'.law.'.'.picture.'.fits.csv'
if (picture eq 'modulus') {
  set ylabel 'Young''s modulus of the compact E_p / MPa'
  paper = 2312.73
  plot fit('') skip 1 using 1:2 with lines linetype 1 title 'inverse exponential', \
       table('') skip 1 using 3:5:6 with yerrorbars linetype 1 pointsize 1.5 title 'D_r^{max} = 0.77, softening law exponential', \
       fit('-energy-law') skip 1 using 1:2 with lines linetype 2, \
       table('-energy-law') skip 1 using 3:5:6 with yerrorbars linetype 2 pointsize 1.5 title '0.77, softening law energy', \
       fit('-energy-law-dense') skip 1 using 1:2 with lines linetype 3, \
       table('-energy-law-dense') skip 1 using 3:5:6 with yerrorbars linetype 3 pointsize 1.5 title '0.92, softening law energy', \
       paper with lines linetype 5 dashtype 3 linewidth 1 title 'saturated value of the paper'
} else {
  set ylabel 'unconfined strength / MPa'
  plot fit('') skip 1 using 1:2 with lines linetype 1 title 'exponential', \
       '' skip 1 using 1:3 with lines linetype 1 dashtype 2 linewidth 1 title 'inverse exponential', \
       table('') skip 1 using 3:10:11 with yerrorbars linetype 1 pointsize 1.5 title 'computed, softening law exponential', \
       fit('-energy-law') skip 1 using 1:2 with lines linetype 2, \
       '' skip 1 using 1:3 with lines linetype 2 dashtype 2 linewidth 1, \
       table('-energy-law') skip 1 using 3:10:11 with yerrorbars linetype 2 pointsize 1.5 title 'softening law energy'
}
