# gnuplot -c plot-profile.gp png|svg FOLDER IMAGE: contact pressure of every node of a flattened pair over its distance
# from the axis
call 'studies/common/style.gp' ARG1
folder = ARG2
set output ARG3
set xlabel 'distance from the axis over R'
set ylabel 'contact pressure, MPa'
set xrange [0:*]
set yrange [0:*]
set key top left
plot folder . '/profile-tet4-7-10.csv' skip 1 using 2:3 with points linetype 2 title 'tet4, R/h = 7', \
     folder . '/profile-tet4-anp-7-10.csv' skip 1 using 2:3 with points linetype 1 title 'tet4-anp, R/h = 7', \
     folder . '/profile-tet4-anp-7-10.csv' skip 1 using 2:4 with points linetype 4 pointtype 6 \
       title 'tet4-anp, its own gap times K'
