# awk -F, -v left=X -v right=X -v bottom=Y -v top=Y -f labels.awk ROWS: where plot.gp writes the numbers of the first
# and the last mesh. ROWS are those of points.csv of one scene and measure in the order of work, with the drawn error in
# column 18; the ranges are those of the axes, both logarithmic.
#
# Prints SERIES,X,Y,TEXT with the centre of each label in the units of the axes; SERIES is 1 to 3 for the elements and 4
# for smooth surfaces. A label stands where it covers markers, lines and other labels least, as near to its point as
# that allows.

BEGIN {
  width = 1000; height = 424          # of the drawing area, which has this shape; lengths below are in these units
  letter = 12; line = 18              # width of a letter, height of a line
  pi = atan2(0, -1)
  series["tet4"] = 1; series["tet4-anp"] = 2; series["tet4-patch"] = 3
}

{
  x[NR] = width * log($12 / left) / log(right / left)
  y[NR] = height * log($18 / bottom) / log(top / bottom)
  radius[NR] = $17 == 1 ? 15 : 9
  if ($17 == 1 && front) {
    add_line(x[front], y[front], x[NR], y[front])
    add_line(x[NR], y[front], x[NR], y[NR])
  }
  if ($17 == 1) front = NR
  s = series_of()
  if (!s) next
  if (s in last) add_line(x[last[s]], y[last[s]], x[NR], y[NR])
  else first[s] = NR
  last[s] = NR
  text[NR] = $5
}

END {
  for (s = 1; s <= 4; ++s) {
    if (s in first) add_label(s, first[s])
    if (s in first && last[s] != first[s]) add_label(s, last[s])
  }
  # Each label is moved again once it is known where the others are.
  for (round = 1; round <= 4; ++round)
    for (l = 1; l <= labels; ++l) place(l)
  for (l = 1; l <= labels; ++l)
    printf "%d,%.6g,%.6g,%s\n", of_series[l], left * (right / left)^(at_x[l] / width), \
           bottom * (top / bottom)^(at_y[l] / height), text[point[l]]
}

# Meshes and smooth surfaces at the penalty, speed and mass of the meshes have lines and labels, others have none.
function series_of() {
  if ($3 == "mesh") return series[$4]
  return $3 == "surface" && $4 == "tet4-anp" && $6 == 10 && $7 == 1 && $8 == 1 ? 4 : 0
}

function add_line(x1, y1, x2, y2) {
  ++lines
  from_x[lines] = x1; from_y[lines] = y1
  to_x[lines] = x2; to_y[lines] = y2
}
function add_label(s, i) { ++labels; of_series[labels] = s; point[labels] = i }

# Tries 24 directions at four distances.
function place(l,   i, angle, gap, cx, cy, c, best) {
  i = point[l]
  half_x = length(text[i]) * letter / 2
  half_y = line / 2
  best = 1e9
  for (gap = 0; gap <= 24; gap += 8)
    for (angle = 0; angle < 2 * pi - 0.1; angle += pi / 12) {
      cx = x[i] + cos(angle) * (half_x + radius[i] + gap)
      cy = y[i] + sin(angle) * (half_y + radius[i] + gap)
      c = cost(l, cx, cy) + gap + 3 * (1 - sin(angle))
      if (c < best) { best = c; at_x[l] = cx; at_y[l] = cy }
    }
}

function cost(l, cx, cy,   i, c) {
  c = 0
  if (cx - half_x < 8 || cx + half_x > width || cy - half_y < 4 || cy + half_y > height) c += 1000
  for (i = 1; i <= NR; ++i) c += 20 * most(0, radius[i] - distance(x[i] - cx, y[i] - cy))
  for (i = 1; i <= lines; ++i) c += 2 * covered(i, cx, cy)
  for (i = 1; i <= labels; ++i) if (i != l && i in at_x) c += label_cost(i, cx, cy)
  # A label nearer to the end of another curve than to its own would be read there.
  for (i = 1; i <= labels; ++i)
    if (of_series[i] != of_series[l])
      c += 2 * most(0, distance(x[point[l]] - cx, y[point[l]] - cy) - distance(x[point[i]] - cx, y[point[i]] - cy))
  return c
}

function most(a, b) { return a > b ? a : b }
function size(a) { return a < 0 ? -a : a }

# From the label's box to a point at (dx, dy) from its centre.
function distance(dx, dy) {
  dx = most(0, size(dx) - half_x)
  dy = most(0, size(dy) - half_y)
  return sqrt(dx^2 + dy^2)
}

# Length of line i inside the label's box, in steps of 2.
function covered(i, cx, cy,   x1, y1, dx, dy, n, k, inside) {
  x1 = from_x[i] - cx; dx = to_x[i] - from_x[i]
  y1 = from_y[i] - cy; dy = to_y[i] - from_y[i]
  if (size(2 * x1 + dx) > size(dx) + 2 * half_x + 4 || size(2 * y1 + dy) > size(dy) + 2 * half_y + 4) return 0
  n = int(sqrt(dx^2 + dy^2) / 2) + 1
  for (k = 0; k <= n; ++k) inside += distance(x1 + dx * k / n, y1 + dy * k / n) < 2
  return 2 * inside
}

function label_cost(i, cx, cy,   free_x, free_y) {
  free_x = size(at_x[i] - cx) - half_x - length(text[point[i]]) * letter / 2
  free_y = size(at_y[i] - cy) - line
  return free_x < 6 && free_y < 2 ? 500 : 0
}
