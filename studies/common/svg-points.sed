# Draws the points of gnuplot's terminal svg as its terminal pngcairo does: less than half as large, with outlines as
# wide as lines. `postproc figure plot` does the same (with_points_as_in_png).
1,/<\/defs>/{
  s/ id='gpPt(7|13)' stroke-width='[0-9.]+'/ id='gpPt\1' transform='scale(0.3)' vector-effect='non-scaling-stroke'/
  s/ id='gpPt([0-9]+)' stroke-width='[0-9.]+'/ id='gpPt\1' transform='scale(0.4)' vector-effect='non-scaling-stroke'/
  s/'rotate\(45\)'\/>/'rotate(45) scale(0.7)'\/>/
}
