# gnuplot -c plot-surface.gp png|svg points.csv grid.csv IMAGE
call 'studies/common/style.gp' ARG1
points = ARG2
grid_file = ARG3
set output ARG4
set xlabel 'confining stress p_c / MPa' rotate parallel offset 0,-0.5
set ylabel 'fracture energy G^c / N mm^{-1}' rotate parallel offset 0,-0.5
set ytics 0,0.1,0.4 offset -0.8,0
set zlabel 'strength q / MPa' rotate by 90 offset -1
set xrange [0:16]
set yrange [0:0.5]
set zrange [0:100]
set ticslevel 0
set xyplane 0
set border 4095 linewidth 0.6
set view 62,320
set key at screen 0.02,0.98 left top Left reverse maxrows 2 samplen 2 width -1
splot grid_file skip 1 using 1:2:3 with lines linecolor rgb '#56b4e9' linewidth 0.8 title 'fit of Eq. 13', \
      points skip 1 using 1:2:3 with points linetype 2 pointsize 1.8 title 'triaxial tests', \
      points skip 1 using (16):2:($1 == 8 ? $3 : NaN) with points linetype 3 pointsize 1.5 title 'at p_c = 8 MPa, projected', \
      points skip 1 using 1:(0.5):($2 == 0 || $2 == 0.1 || $2 == 0.5 ? $3 : NaN) with points linetype 4 pointsize 1.5 title 'at G^c = 0, 0.1, 0.5, projected'
