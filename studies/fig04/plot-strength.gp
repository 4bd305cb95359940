# gnuplot -c plot-strength.gp png|svg cohesive.csv summary.csv IMAGE: pull-off force against strength
call 'studies/common/style.gp' ARG1
set output ARG4
set logscale x
set xrange [0.08:4]
set yrange [0:1.4]
set xlabel "strength as Maugis' λ = 2 σ_0 (R/(2π w K^2))^{1/3}"
set ylabel 'pull-off force over that of JKR'
set key below maxcols 2 width -4
# Maugis, J. Colloid Interface Sci. 150, 1992: pull-off over (pi w R/2), here divided by 1.5.
$maugis << EOD
0.067,1.3147
0.246,1.2333
0.5,1.1453
1,1.0673
2,1.0233
3,1.0113
5,1.0040
EOD
cap(l) = l / 2 * pi * 1.25**2 * 1.5**(2.0 / 3) / 1.5
plot 1 with lines linetype 5 dashtype 2 title 'JKR: no limit of the strength', \
     $maugis using 1:2 with lines linetype 3 title 'Maugis–Dugdale: attraction outside the contact, too', \
     cap(x) with lines linetype 4 title 'σ_0 on all of the bonded area', \
     ARG2 skip 1 using ($1 == 0.1 ? $2 : NaN):4 with lines linetype 2 title 'this bond, boundary elements', \
     ARG3 skip 1 using (strcol(2) eq 'strength' || strcol(1) eq 'mesh-8' ? $4 : NaN):11 with points linetype 1 pointsize 1.6 title 'computed'
