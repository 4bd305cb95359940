# gnuplot -c plot.gp png|svg points.csv SCENE MEASURE TITLE NUMBERS IMAGE: error over cost of one measure, and the
# front. NUMBERS says what the numbers at the circles are.
call 'studies/common/style.gp' ARG1
data = ARG2
scene = ARG3
measure = ARG4
set output ARG7
set title offset 0, -0.7 ARG5 . "\n{/*0.8 numbers at circles: " . ARG6 . '; at triangles: K h/E}'
set logscale xy
set xlabel 'work: tets × steps × time of a tet-step / s on one core'
set ylabel 'error, mean of absolute values / %'
set format y '%g'
set format x '10^{%L}'
set key below maxcols 3 spacing 1.1 width 1
# Column 18 is the error in per cent, 19 the reference's uncertainty; what is smaller than a third of it is drawn there.
here = sprintf("awk -F, -v s='%s' -v m='%s' 'NR > 1 && $2 == s && $9 == m " . \
  "{ d = 100 * $16; e = 100 * $14; print $0 \",\" (e < 0.3 * d ? 0.3 * d : e) \",\" d }' '%s'", scene, measure, data)
chosen(condition) = sprintf("< %s | awk -F, '%s'", here, condition)
sorted(condition) = sprintf("< %s | awk -F, '%s' | LC_ALL=C sort -t, -k12,12g", here, condition)
doubt = real(system(here . " | awk -F, '$19 > d { d = $19 } END { print d + 0 }'"))
many(condition) = int(system(here . sprintf(" | awk -F, '%s' | wc -l", condition)))
lowest = real(system(here . " | awk -F, '!n++ || $18 < m { m = $18 } END { print m }'"))
lowest = lowest < 0.3 * doubt ? 0.3 * doubt : lowest
highest = real(system(here . " | awk -F, '$18 > m { m = $18 } END { print m }'"))
bottom = 10**floor(log10(0.7 * lowest)) < 0.05 ? 0.05 : 0.6 * lowest
set yrange [bottom:1.6 * highest]
set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
set style rect fillcolor rgb '#eeeeee' fillstyle solid noborder
if (doubt > bottom) { set object 1 rect from graph 0, first bottom to graph 1, first doubt behind }
of(e, l) = sprintf('$4 == "%s" && $3 == "%s"', e, l)
names = 'tet4 tet4-anp tet4-patch'
plot \
  for [i = 1:3] sorted(of(word(names, i), 'mesh')) using 12:18 \
    with linespoints linetype i pointtype 7 pointsize 1.5 title word(names, i), \
  for [i = 1:3] sorted(of(word(names, i), 'mesh')) using 12:18:(strcol(5)) \
    with labels offset character (i == 1 ? 1.8 : -1.8), character (i == 1 ? 0.7 : i == 2 ? 0.1 : -0.8) \
    font ',15' textcolor linetype i, \
  for [i = 1:3] chosen(of(word(names, i), 'penalty')) using 12:18 with points linetype i pointtype 8 pointsize 1.7 \
    title (many(of(word(names, i), 'penalty')) ? word(names, i) . ', other K' : ''), \
  for [i = 1:3] chosen(of(word(names, i), 'penalty')) using 12:18:(strcol(6)) \
    with labels offset character 1.4, character -0.6 font ',13' textcolor linetype i, \
  chosen(of('tet4-anp', 'speed')) using 12:18 with points linetype 4 pointtype 12 pointsize 1.7 \
    title (many(of('tet4-anp', 'speed')) ? 'tet4-anp, other speed' : ''), \
  chosen(of('tet4-anp', 'speed')) using 12:18:('×' . strcol(7)) \
    with labels offset character -1.6, character 0.6 font ',13' textcolor linetype 4, \
  chosen(of('tet4-anp', 'mass')) using 12:18 with points linetype 4 pointtype 4 pointsize 1.5 \
    title (many(of('tet4-anp', 'mass')) ? 'tet4-anp, other mass' : ''), \
  chosen(of('tet4-anp', 'mass')) using 12:18:('×' . strcol(8)) \
    with labels offset character -1.8, character -0.5 font ',13' textcolor linetype 4, \
  sorted(of('tet4-anp', 'surface')) using 12:18 with linespoints linetype 6 dashtype 3 pointtype 2 pointsize 1.5 \
    title (many(of('tet4-anp', 'surface')) ? 'tet4-anp, smooth surface' : ''), \
  sorted(of('tet4-anp', 'surface')) using 12:18:(strcol(5)) \
    with labels offset character -1.8, character 0.5 font ',13' textcolor linetype 6, \
  chosen(of('tet4-anp', 'precision')) using 12:18 with points linetype 2 pointtype 1 pointsize 1.5 \
    title (many(of('tet4-anp', 'precision')) ? 'tet4-anp, mixed precision' : ''), \
  sorted('$17 == 1') using 12:18 with steps linetype 5 linewidth 1.2 dashtype 2, \
  sorted('$17 == 1') using 12:18 with points linetype 5 linewidth 1.2 pointtype 6 pointsize 2.6 title 'on the front', \
  NaN with filledcurves fillcolor rgb '#dddddd' title (doubt > bottom ? 'uncertainty of the reference' : '')
