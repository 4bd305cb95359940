# gnuplot -c plot.gp png|svg FOLDER IMAGE: loading and bonded unloading of elasto-plastic hemispheres
call 'studies/common/style.gp' ARG1
folder = ARG2
set output ARG3
set xlabel 'approach h/R'
set ylabel 'force F/(ER^2) × 10^3'
set key top left
set xzeroaxis linetype -1 linewidth 0.5
cases = system("cd '" . folder . "' && ls *.curve.csv | sed 's/.curve.csv//' | grep -E '^(table-1|total-strain)' | tr '\n' ' '")
last = word(cases, words(cases))
# A little beyond the largest tension two free bodies ring: no more is drawn.
end(c) = real(system(sprintf("awk -F, 'NR > 1 && $3 < m { m = $3; h = $2 } $2 > t { t = $2 } END { print h - 0.06 * t }' '%s/%s.curve.csv'", folder, c)))
array from[words(cases)]
do for [i = 1:words(cases)] { from[i] = end(word(cases, i)) }
plot 'studies/fig05/finite-elements.csv' skip 1 using 1:($2 * 1e3) with points linetype 5 pointtype 6 pointsize 1.6 title 'finite elements, Table 1', \
     'studies/fig05/finite-elements.csv' skip 1 using 1:($3 * 1e3) with points linetype 5 pointtype 4 pointsize 1.6 title 'finite elements, 160 MPa ε^{0.4}', \
     for [i = 1:words(cases)] folder . '/' . word(cases, i) . '.similarity.csv' skip 1 using (strcol(1) eq 'loading' ? $2 : NaN):($3 * 1e3) with lines linetype 4 dashtype 2 title (i == 1 ? 'similarity law' : ''), \
     for [i = 1:words(cases)] folder . '/' . word(cases, i) . '.similarity.csv' skip 1 using (strcol(1) ne 'loading' ? $2 : NaN):($3 * 1e3) with lines linetype 4 title (i == 1 ? 'its bonded unloading' : ''), \
     for [i = 1:words(cases)] folder . '/' . word(cases, i) . '.curve.csv' skip 1 using (word(cases, i)[1:3] eq 'tab' && (strcol(1) eq 'loading' || $2 >= from[i]) ? $2 : NaN):($3 * 1e3) with lines linetype 1 title (i == 1 ? 'computed, Table 1' : ''), \
     for [i = 1:words(cases)] folder . '/' . word(cases, i) . '.curve.csv' skip 1 using (word(cases, i)[1:3] eq 'tot' && (strcol(1) eq 'loading' || $2 >= from[i]) ? $2 : NaN):($3 * 1e3) with lines linetype 2 title (word(cases, i) eq last && last[1:3] eq 'tot' ? 'computed, 160 MPa ε^{0.4}' : '')
