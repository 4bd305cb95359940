# gnuplot -c plot.gp png|svg FOLDER IMAGE: loading and unloading of three fracture energies against theory
call 'studies/common/style.gp' ARG1
folder = ARG2
set output ARG3
set multiplot layout 1,3 margins 0.12,0.965,0.13,0.92 spacing 0.075
set xlabel 'approach h/R × 10^3'
set ylabel 'force F/(ER^2) × 10^4' 
small = ARG1 eq 'svg' ? ',12' : ',15'
set key top left samplen 1 font small
set xzeroaxis linetype -1 linewidth 0.5
do for [w in '0.01 0.1 0.5'] {
  set title sprintf('G^c = %s N/mm', w)
  step = w eq "0.01" ? 1 : w eq "0.1" ? 5 : 20
  set xtics step
  case = folder . '/w' . w
  # Beyond the end of the theory's branch two free bodies ring.
  end = real(system("tail -n 1 '" . case . ".reference.csv' | cut -d, -f4"))
  set xrange [1.3 * end * 1e3 : *]
  plot case . '.reference.csv' skip 1 using (strcol(1) eq 'hertz' ? $4 * 1e3 : NaN):($3 * 1e4) with lines linetype 5 dashtype 2 title (w eq '0.01' ? 'Hertz' : ''), \
       case . '.reference.csv' skip 1 using (strcol(1) ne 'hertz' ? $4 * 1e3 : NaN):($3 * 1e4) with lines linetype 5 title (w eq '0.01' ? 'JKR' : ''), \
       case . '.curve.csv' skip 1 every 6 using (strcol(1) eq 'loading' ? $2 * 1e3 : NaN):($3 * 1e4) with points linetype 1 pointsize 0.9 title (w eq '0.01' ? 'loading' : ''), \
       case . '.curve.csv' skip 1 every 4 using (strcol(1) eq 'unloading' && $2 >= end ? $2 * 1e3 : NaN):($3 * 1e4) with points linetype 2 pointsize 0.9 title (w eq '0.01' ? 'unloading' : '')
  unset ylabel
}
unset multiplot
