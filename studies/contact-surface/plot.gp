# gnuplot -c plot.gp png|svg ROTATIONS.csv IMAGE: mean error of the contact force and its spread over orientations
call 'studies/common/style.gp' ARG1
set output ARG3
set xlabel 'approach/R'
set ylabel 'force over the reference, less 1, %'
set xrange [0.0085:0.05]
set logscale x
set xtics (0.01, 0.02, 0.04)
set xzeroaxis linetype -1
set key top right
# ELEMENT,SCALING,R/h of every mesh in the table
cases = system("awk -F, 'NR > 1 { k = $1 \",\" $2 \",\" $3; if (!(k in s)) { s[k] = 1; printf \"%s \", k } }' '" . \
               ARG2 . "'")
part(c, n) = system(sprintf("echo '%s' | cut -d, -f%d", c, n))
name(c) = part(c, 1) . ', R/h = ' . part(c, 3) . (part(c, 2) eq 'exact' ? '' : ', nodes on the sphere')
of(c, contact) = strcol(1) . ',' . strcol(2) . ',' . strcol(3) eq c && strcol(5) eq contact
beside(i) = 0.95 + 0.02 * i
plot for [i = 1:words(cases)] ARG2 skip 1 \
       using ($4 * beside(i)):(of(word(cases, i), 'pair') ? 100 * $7 : NaN):(100 * $8) \
       with yerrorbars linetype i title name(word(cases, i)), \
     for [i = 1:words(cases)] ARG2 skip 1 \
       using ($4 * beside(i)):(of(word(cases, i), 'wall') ? 100 * $7 : NaN) \
       with points linetype i pointtype 6 pointsize 1.6 title (i == 1 ? 'open: on the wall' : '')
