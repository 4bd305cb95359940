# gnuplot -c plot.gp png|svg loading|modulus FOLDER IMAGE
call 'studies/common/style.gp' ARG1
picture = ARG2
folder = ARG3
set output ARG4
if (picture eq 'loading') {
  set xlabel 'axial strain (logarithmic, since the beginning)'
  set ylabel 'axial stress / MPa'
  set yrange [0:*]
  of(stage) = strcol(1) eq stage ? $3 : NaN
  plot folder.'/loading.csv' skip 1 using 2:(of('loading')) with lines linetype 1 title '1: isotropic loading', \
       '' skip 1 using 2:(of('unloading')) with lines linetype 3 title '2: isotropic unloading', \
       '' skip 1 using 2:(of('reloading')) with lines linetype 2 title '3: unconfined reloading'
} else {
  fit(law) = folder.'/modulus'.law.'.spriggs.fits.csv'
  # Spriggs' lines carried on to zero porosity.
  stats fit('') skip 1 using 1:(log($2)) name 'E' nooutput
  stats fit('-energy-law') skip 1 using 1:(log($2)) name 'F' nooutput
  beyond(x, x0, x1, y0, y1) = x < x1 ? NaN : exp(y1 + (y1 - y0) / (x1 - x0) * (x - x1))
  set xlabel 'maximum relative density D_r^{max}'
  set ylabel 'normalised Young''s modulus E_p / E'
  set xrange [0.68:1]
  set samples 1000
  set yrange [0:*]
  set format x '%.2f'
  plot beyond(x, E_min_x, E_max_x, E_min_y, E_max_y) with lines linetype 1 dashtype 2 linewidth 1, \
       fit('') skip 1 using 1:2 with lines linetype 1 title 'Spriggs, with an offset', \
       folder.'/modulus.csv' skip 1 using 4:7:($6/$2) with yerrorbars linetype 1 pointsize 1.5 title 'computed, softening law exponential', \
       beyond(x, F_min_x, F_max_x, F_min_y, F_max_y) with lines linetype 2 dashtype 2 linewidth 1, \
       fit('-energy-law') skip 1 using 1:2 with lines linetype 2, \
       folder.'/modulus-energy-law.csv' skip 1 using 4:7:($6/$2) with yerrorbars linetype 2 pointsize 1.5 title 'softening law energy', \
       for [i = 1:several] folder.'/modulus.spread.csv' skip 1 using 3:5:6 with yerrorbars linetype 5 pointtype 6 pointsize 1.5 title spread_title, \
       for [i = 1:several] folder.'/modulus-energy-law.spread.csv' skip 1 using 3:5:6 with yerrorbars linetype 4 pointtype 6 pointsize 1.5 notitle
}
