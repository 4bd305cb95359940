# gnuplot -c plot.gp png|svg points.csv SCENE MEASURE TITLE NUMBERS IMAGE: error over cost of one measure, and the
# front. NUMBERS says what the numbers at the meshes are.
call 'studies/common/style.gp' ARG1
small = ',16'
number = ',15'
data = ARG2
scene = ARG3
measure = ARG4
set output ARG7
set title offset 0, -0.7 ARG5 . "\n{/*0.8 numbers at the first and the last mesh: " . ARG6 . '}'
set logscale xy
set xlabel 'work: tets × steps × time of a tet-step / s on one core'
set ylabel 'error, mean of absolute values / %'
set format y '%g'
set format x '10^{%L}'
# The key lies below the axis title, which it would touch without this margin.
set bmargin at screen 0.385
set key at screen 0.5, 0.24 center top vertical maxrows 6 spacing 1.05 width 1 font small
# Column 18 is the error in per cent, 19 the reference's uncertainty; what is smaller than a third of it is drawn there.
here = sprintf("awk -F, -v s='%s' -v m='%s' 'NR > 1 && $2 == s && $9 == m " . \
  "{ d = 100 * $16; e = 100 * $14; print $0 \",\" (e < 0.3 * d ? 0.3 * d : e) \",\" d }' '%s'", scene, measure, data)
sorted(condition) = sprintf("< %s | awk -F, '%s' | LC_ALL=C sort -t, -k12,12g", here, condition)
# The values of a column of these points, for the key; '' where there are none.
values(condition, column, before) = system(sprintf("%s | awk -F, '%s { print $%d }' | LC_ALL=C sort -gu | " . \
  "awk '{ t = t (NR > 1 ? \", \" : \"\") \"%s\" $1 } END { print t }'", here, condition, column, before))
named(name, list) = list eq '' ? '' : name . ' ' . list
doubt = real(system(here . " | awk -F, '$19 > d { d = $19 } END { print d + 0 }'"))
lowest = real(system(here . " | awk -F, '!n++ || $18 < m { m = $18 } END { print m }'"))
lowest = lowest < 0.3 * doubt ? 0.3 * doubt : lowest
highest = real(system(here . " | awk -F, '$18 > m { m = $18 } END { print m }'"))
bottom = 10**floor(log10(0.7 * lowest)) < 0.05 ? 0.05 : 0.6 * lowest
top = 1.9 * highest
set yrange [bottom:top]
# Both ends of the axis stay free for labels.
cheapest = real(system(here . " | awk -F, '!n++ || $12 < m { m = $12 } END { print m }'"))
dearest = real(system(here . " | awk -F, '$12 > m { m = $12 } END { print m }'"))
left = cheapest * (cheapest / dearest)**0.08
right = dearest * (dearest / cheapest)**0.08
set xrange [left:right]
# The numbers at the meshes are darker than their curves.
set print $numbers
print system(sprintf("%s | LC_ALL=C sort -t, -k12,12g | awk -F, -v left=%g -v right=%g -v bottom=%g -v top=%g " . \
  '-f studies/accuracy/labels.awk', here, left, right, bottom, top))
set print
dark = '#004a74 #a04600 #00664a #2a7fb3'
set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)
set style rect fillcolor rgb '#eeeeee' fillstyle solid noborder
if (doubt > bottom) { set object 1 rect from graph 0, first bottom to graph 1, first doubt behind }
of(e, l) = sprintf('$4 == "%s" && $3 == "%s"', e, l)
# Smooth surfaces at the penalty, speed and mass of the meshes, and with others.
smooth = of('tet4-anp', 'surface') . ' && $6 == 10 && $7 == 1 && $8 == 1'
smooth_other = of('tet4-anp', 'surface') . ' && ($6 != 10 || $7 != 1 || $8 != 1)'
points_of(condition) = int(system(sprintf("%s | awk -F, '%s' | wc -l", here, condition)))
# Elements differ by colour and by shape: circle, square, triangle; hollow with another penalty.
names = 'tet4 tet4-anp tet4-patch'
filled = '7 5 9'
hollow = '6 4 8'
plot \
  for [i = 1:3] sorted(of(word(names, i), 'mesh')) using 12:18 \
    with linespoints linetype i pointtype int(word(filled, i)) pointsize 1.5 \
    title (points_of(of(word(names, i), 'mesh')) ? word(names, i) : ''), \
  for [i = 1:3] sorted(of(word(names, i), 'penalty')) using 12:18 \
    with points linetype i pointtype int(word(hollow, i)) pointsize 1.7 \
    title named(word(names, i) . ', K h/E =', values(of(word(names, i), 'penalty'), 6, '')), \
  sorted(of('tet4-anp', 'speed')) using 12:18 with points linetype 4 pointtype 12 pointsize 1.7 \
    title named('tet4-anp, speed', values(of('tet4-anp', 'speed'), 7, '×')), \
  sorted(of('tet4-anp', 'mass')) using 12:18 with points linetype 4 pointtype 11 pointsize 1.5 \
    title named('tet4-anp, mass', values(of('tet4-anp', 'mass'), 8, '×')), \
  sorted(smooth) using 12:18 with linespoints linetype 6 dashtype 3 pointtype 13 pointsize 1.8 \
    title (points_of(smooth) ? 'tet4-anp, smooth surface' : ''), \
  sorted(smooth_other) using 12:18 with points linetype 6 pointtype 2 pointsize 1.5 \
    title (points_of(smooth_other) ? 'smooth, other K, speed or mass' : ''), \
  sorted(of('tet4-anp', 'precision')) using 12:18 with points linetype 5 pointtype 1 pointsize 1.8 \
    title (points_of(of('tet4-anp', 'precision')) ? 'tet4-anp, mixed precision' : ''), \
  sorted('$17 == 1') using 12:18 with steps linetype 5 linewidth 1.2 dashtype 2, \
  sorted('$17 == 1') using 12:18 with points linetype 5 linewidth 1.2 pointtype 6 pointsize 2.8 \
    title 'on the front', \
  for [i = 1:4] $numbers using ($1 == i ? $2 : NaN):3:(strcol(4)) \
    with labels font number textcolor rgb word(dark, i), \
  NaN with filledcurves fillcolor rgb '#dddddd' title (doubt > bottom ? 'uncertainty of the reference' : '')
