# gnuplot -c plot.gp png|svg ROTATIONS.csv IMAGE: mean error of the contact force and its spread over orientations
call 'studies/common/style.gp' ARG1
set output ARG3
set xlabel 'approach/R'
set ylabel 'force over the reference, less 1, %'
set xrange [0.007:0.06]
set logscale x
set xtics (0.01, 0.02, 0.04)
set yrange [0:*]
set key top right
cases = system("awk -F, 'NR > 1 && $2 == \"exact\" && $5 == \"pair\" { k = $1 \",\" $3; if (!(k in s)) { s[k] = 1; printf \"%s \", k } }' '" . ARG2 . "'")
wanted(c, contact) = strcol(1) . ',' . strcol(3) eq c && strcol(2) eq 'exact' && strcol(5) eq contact
plot for [i = 1:words(cases)] ARG2 skip 1 using ($4 * (0.97 + 0.012 * i)):(wanted(word(cases, i), 'pair') ? 100 * $7 : NaN):(100 * $8) with yerrorbars linetype i title 'sphere on sphere, ' . word(cases, i)[1:strstrt(word(cases, i), ',') - 1] . ', R/h = ' . word(cases, i)[strstrt(word(cases, i), ',') + 1:*], \
     for [i = 1:words(cases)] ARG2 skip 1 using ($4 * (0.97 + 0.012 * i)):(wanted(word(cases, i), 'wall') ? 100 * $7 : NaN) with points linetype i pointtype 6 pointsize 1.6 title (i == 1 ? 'sphere on wall' : '')
