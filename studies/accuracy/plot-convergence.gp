# gnuplot -c plot-convergence.gp png|svg locking|packing runs.csv values.csv references.csv IMAGE: values over tets, all
# elements, and the reference
call 'studies/common/style.gp' ARG1
what = ARG2
runs = ARG3
values = ARG4
references = ARG5
set output ARG6
# Rows tets,value of a scene's quantity with an element, in the order of tets.
rows(scene, quantity, element) = sprintf( \
  "< awk -F, 'NR == FNR { if ($2 == \"%s\" && $3 == \"mesh\" && $4 == \"%s\") tets[$1] = $9; next } " . \
  "$1 in tets && $2 == \"%s\" { print tets[$1] \",\" $3 }' '%s' '%s' | LC_ALL=C sort -t, -k1,1g", \
  scene, element, quantity, runs, values)
known(scene, quantity, column) = real(system(sprintf( \
  "awk -F, '$1 == \"%s\" && $2 == \"%s\" { x = $%d } END { print x + 0 }' '%s'", \
  scene, quantity, column, references)))
set logscale x
set format x '10^{%L}'
names = 'tet4 tet4-anp tet4-patch'
if (what eq 'locking') {
  scenes = 'flattened flattened confined confined'
  quantities = 'force-0.042 force-0.135 axial-stress-0.7 axial-stress-0.92'
  factors = '100 100 1 1'
  array titles = ['between planes, at 0.042 R', 'between planes, at 0.135 R', \
                  'in a die, at D_r = 0.70', 'in a die, at D_r = 0.92']
  array labels = ['100 F/(ER^2)', '100 F/(ER^2)', 'axial stress / MPa', 'axial stress / MPa']
} else {
  scenes = 'small small small full'
  quantities = 'mean-stress-0.92 recovery modulus mean-stress-0.92'
  factors = '1 100 0.001 1'
  array titles = ['25 grains, D_r = 0.92', '25 grains', '25 grains', '329 grains, D_r = 0.92']
  array labels = ['mean stress / MPa', 'elastic recovery / %', 'E_p / GPa', 'mean stress / MPa']
}
set multiplot layout 2,2 margins 0.135,0.975,0.1,0.94 spacing 0.13,0.13
set key top right Right noreverse font ',17' samplen 1.5
do for [p = 1:4] {
  s = word(scenes, p)
  q = word(quantities, p)
  f = real(word(factors, p))
  r = f * known(s, q, 3)
  u = f * known(s, q, 4)
  set title titles[p] offset 0, -0.7
  set ylabel labels[p] offset 0.8, 0
  set xlabel p > 2 ? 'tets' : '' offset 0, 0.3
  unset object
  if (r > 0) { set object 1 rect from graph 0, first r - u to graph 1, first r + u \
                   fillcolor rgb '#dddddd' fillstyle solid noborder behind }
  plot for [i = 1:3] rows(s, q, word(names, i)) using 1:(f * $2) \
         with linespoints linetype i pointtype 7 pointsize 1.3 title (p == 2 ? word(names, i) : ''), \
       (r > 0 ? r : NaN) with lines linetype 5 linewidth 1 dashtype 2 title (p == 2 ? 'reference' : '')
}
unset multiplot
