# gnuplot -c plot.gp png|svg FOLDER IMAGE: the walks of FOLDER, a row for each softening law. Separations in nm.
call 'studies/common/style.gp' ARG1
if (ARG1 eq 'svg') {
  set terminal svg size 1350,850 dynamic enhanced font 'DejaVu Sans,14' background 'white'
} else {
  set terminal pngcairo size 2025,1275 enhanced font 'DejaVu Sans,18' linewidth 1.5
}
set output ARG3
walk(mode, law) = sprintf('%s/%s-%s.csv', ARG2, mode, law)
nm = 1e6
set zeroaxis linewidth 1 linecolor rgb '#888888' linetype 1
set style arrow 1 nohead dashtype 2 linewidth 1.2 linecolor rgb '#666666'
set xtics 40
set ytics 10
set yrange [-22:44]
set multiplot layout 2,3 margins 0.06,0.985,0.085,0.955 spacing 0.08,0.16
do for [law in 'exponential energy'] {
  set title sprintf('opening, law "%s"', law)
  set xlabel 'opening δ_n / nm'
  set ylabel 'normal traction / MPa'
  set xrange [-10:170]
  set arrow 1 from -10,25 to 170,25 arrowstyle 1
  set label 1 '25 MPa' at 168,27 right textcolor rgb '#444444'
  set label 2 'closed: undamaged penalty' at 4,-12 textcolor rgb '#444444'
  set label 3 'unloading, reloading' at (law eq 'energy' ? 48 : 60),(law eq 'energy' ? 16 : 15) textcolor rgb '#444444'
  plot walk('normal', law) using (nm * column('opening_mm')):'normal_traction_MPa' with lines linetype 1
  unset label 2; unset label 3

  set title sprintf('sliding, law "%s"', law)
  set xlabel 'sliding δ_s / nm'
  set ylabel 'shear traction / MPa'
  set xrange [-50:170]
  set arrow 1 from -50,18 to 170,18 arrowstyle 1
  set label 1 '18 MPa' at 168,20 right
  set label 2 'back and to the other side' at -8,-12 textcolor rgb '#444444'
  plot walk('shear', law) using (nm * column('shear1_mm')):'shear1_traction_MPa' with lines linetype 2
  unset label 2

  set title sprintf('opening and sliding alike, law "%s"', law)
  set xlabel 'opening δ_n = sliding δ_s / nm'
  set ylabel 'traction / MPa'
  set xrange [-10:170]
  unset arrow 1; unset label 1
  set key right top Left reverse
  plot walk('mixed', law) using (nm * column('opening_mm')):'normal_traction_MPa' with lines linetype 1 title 'normal', \
    '' using (nm * column('opening_mm')):'shear1_traction_MPa' with lines linetype 2 dashtype 3 linewidth 3 title 'shear'
  set key off
}
unset multiplot
