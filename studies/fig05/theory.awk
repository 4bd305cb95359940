# awk -f theory.awk -v part=similarity -v approach=mm
#                                                        the similarity law, and its bonded unloading
# awk -f theory.awk -v part=row -v hardening=power|total_strain -v label=A,B,…
#     finite-elements.csv similarity.csv curve.csv       how far the curve is from both, with its heading
# awk -f theory.awk -v part=gather NAME.curve.csv …      all curves with their cases, without the ringing after the
#                                                        pull-off
# The curves themselves: ../fig04/theory.awk. mm and N.
BEGIN {
  FS = ","
  pi = atan2(0, -1)
  radius = 0.1
  youngs_modulus = 5000
  reduced = youngs_modulus / (2 * (1 - 0.3^2))
  mean_radius = radius / 2
  coefficient = 160 # of the flow curve that the law takes, MPa
  exponent = 0.4
  energy = 0.01 # N/mm
  if (part == "similarity") { similarity(); exit }
}

# ---------------------------------------------------------------------------------------- gather
# A little beyond the largest tension two free bodies ring: no more is given.
part == "gather" && FNR == 1 {
  give()
  name = FILENAME
  sub(/.*\//, "", name)
  sub(/\.(curve|similarity)\.csv$/, "", name)
  if (NR == 1) print "case," $1 "," $2 "," $3
  next
}
part == "gather" {
  row[++held] = name "," $1 "," $2 "," $3
  row_branch[held] = $1
  row_h[held] = $2
  if ($3 < least) { least = $3; end = $2 }
  if ($2 > top) top = $2
}
function give(   i) {
  for (i = 1; i <= held; ++i) if (row_branch[i] != "unloading" || row_h[i] >= end - 0.06 * top) print row[i]
  held = least = top = 0
}
END { if (part == "gather") give() }

# ---------------------------------------------------------------------------------------- similarity
# Similarity law of two equal elasto-plastic spheres that bond where they touch, as the paper's Fig. 5 uses it, in mm
# and N. Columns: branch, approach over radius, force over E R^2, contact radius over radius.
#
# Loading (Storakers, Biwa and Larsson 1997; Mesarovic and Johnson 2000; Gonzalez 2019), flow curve sigma = kappa eps^p:
#   a^2 = 2 c^2 Rbar gamma, P = n_P a^(2 + p), n_P = pi k Rbar^-p (2 kappa^(-1/p))^-p, k = 3 6^-p,
#   c^2 = 1.43 exp(-0.97 p).
# Unloading with toughness K = sqrt(2 G^c E*), x = a/a_P, p_0 = P_P/(pi a_P^2): the contact radius stays at a_P with
# slope 2 E* a_P until the force has fallen by 2 sqrt(pi) K a_P^1.5, then
#   P = (2 P_P/pi)(asin x - x sqrt(1 - x^2)) - 2 sqrt(pi) K a^1.5,
#   gamma = gamma_P - (2 p_0/E*) sqrt(a_P^2 - a^2) - sqrt(pi a) K/E*.
function line(branch, h, force, a) {
  printf "%s,%.6e,%.6e,%.6e\n", branch, h / radius, force / (youngs_modulus * radius^2), a / radius
}
function asin(x) { return atan2(x, sqrt(1 - x * x)) }
function contact_radius(h) { return sqrt(2 * c2 * mean_radius * h) }
function similarity(   i, h, a, x, force, last_h, stiffness, toughness, largest, top, pressure, drop) {
  c2 = 1.43 * exp(-0.97 * exponent)
  stiffness = pi * 3 * 6^(-exponent) * mean_radius^(-exponent) * (2 * coefficient^(-1 / exponent))^(-exponent)
  toughness = sqrt(2 * energy * reduced)
  points = 200
  print "branch,approach [R],force [E R^2],contact_radius [R]"
  for (i = 0; i <= points; ++i) {
    h = approach * i / points
    a = contact_radius(h)
    force = stiffness * a^(2 + exponent)
    line("loading", h, force, a)
  }
  largest = a
  top = force
  pressure = top / (pi * largest^2)
  drop = 2 * sqrt(pi) * toughness * largest^1.5
  for (i = 0; i <= 50; ++i)
    line("constant_radius", approach - drop * i / 50 / (2 * reduced * largest), top - drop * i / 50, largest)
  for (i = 0; i <= points; ++i) {
    x = 1 - 0.7 * i / points
    a = x * largest
    h = approach - 2 * pressure / reduced * sqrt(largest^2 - a^2) - sqrt(pi * a) * toughness / reduced
    if (i > 0 && h > last_h) break # where the branch ends when the approach is driven
    line("bonded", h, 2 * top / pi * (asin(x) - x * sqrt(1 - x * x)) - 2 * sqrt(pi) * toughness * a^1.5, a)
    last_h = h
  }
}

# ---------------------------------------------------------------------------------------- row
# How far a computed curve is from the converged finite-element rows (loading, from a quarter of the largest approach
# on) and from the similarity law: loading, unloading down to the law's pull-off (root mean square, in parts of the
# law's range of forces), pull-off.
part == "row" && FNR == 1 { ++file; next }
part == "row" && file == 1 { ++n; h[n] = $1; f[n] = hardening == "power" ? $2 : $3; next }
part == "row" && file == 2 {
  if ($3 > top) top = $3
  if ($3 < lowest) { lowest = $3; lowest_h = $2 }
  if ($1 == "loading") { ++m; law_h[m] = $2; law_f[m] = $3 }
  else { ++away; away_h[away] = -$2; away_f[away] = $3 } # approaches fall: between() wants them rising
  next
}
part == "row" && $1 == "loading" { ++rows; row_h[rows] = $2; row_f[rows] = $3; if ($2 > largest) largest = $2 }
part == "row" && $1 == "unloading" {
  if (!(unloading++) || $2 < end_h) end_h = $2
  if ($3 < pull_off) { pull_off = $3; at = $2 }
  if ($2 >= lowest_h && -$2 >= away_h[1]) {
    d = ($3 - between(-$2, away_h, away_f, away)) / (top - lowest)
    squares += d * d
    ++counted
  }
}
function between(x, xs, ys, count,   i) {
  for (i = 2; i <= count; ++i)
    if (x <= xs[i] || i == count) return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1])
}
END {
  if (part != "row") exit
  split(label, c, ",")
  for (i = 1; i <= n; ++i)
    if (h[i] >= 0.24 * largest && h[i] <= largest * 1.001) {
      d = between(h[i], row_h, row_f, rows) / f[i] - 1
      sum += d
      if (d < 0) d = -d
      if (d > most) most = d
      ++used
      if (h[i] >= 0.0199) {
        e = between(h[i], row_h, row_f, rows) / between(h[i], law_h, law_f, m) - 1
        if (e < 0) e = -e
        if (e > law) law = e
      }
    }
  print "case,hardening,approach [R],strength [MPa],fineness,speed_factor,penalty_factor,mean_error,largest_error," \
        "largest_error_similarity,pull_off_over_similarity,element,unloading_error_similarity"
  printf "%s,%s,%s,%s,%s,%s,%s,%.5f,%.5f,%.5f,%.5f,%s,%.5f\n", \
         c[1], c[2], c[3], c[4], c[5], c[6], c[7], sum / used, most, law, \
         pull_off / lowest, c[8], counted ? sqrt(squares / counted) : 0
}
