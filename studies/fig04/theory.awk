# awk -f theory.awk -v part=curve history.csv            force over approach, as driven
# awk -f theory.awk -v part=reference -v energy=N/mm curve.csv
#                                                        Hertz, then Johnson, Kendall and Roberts, for its largest
#                                                        approach
# awk -f theory.awk -v part=row -v label=A,B,… reference.csv curve.csv
#                                                        how far the curve is from the reference, with its heading
# Two equal hemispheres of radius 0.1 mm, E = 5000 MPa, nu = 0.3, tips 1e-6 mm apart; mm and N. Parts of fig04 and
# fig05.
BEGIN {
  FS = ","
  pi = atan2(0, -1)
  radius = 0.1
  gap = 1e-6
  youngs_modulus = 5000
  reduced = youngs_modulus / (2 * (1 - 0.3^2))
  mean_radius = radius / 2
  unit = youngs_modulus * radius^2
  if (part == "curve") print "branch,approach [R],force [E R^2]"
}

# ---------------------------------------------------------------------------------------- curve
# The force is the mean of both grips', in which the inertia of the hemispheres cancels.
part == "curve" && FNR == 1 {
  for (i = 1; i <= NF; ++i) {
    name = $i
    sub(/ *\[.*$/, "", name)
    column[name] = i
  }
  next
}
part == "curve" {
  stress = 0.5 * ($column["wall_stress_4"] + $column["wall_stress_5"])
  force = stress * $column["box_lengths_0"] * $column["box_lengths_1"]
  printf "%s,%.6e,%.6e\n", ($column["stage"] == 0 ? "loading" : "unloading"), \
         (2 * radius + gap - $column["box_lengths_2"]) / radius, force / unit
}

# ---------------------------------------------------------------------------------------- reference
part == "reference" && $1 == "loading" { approach = sprintf("%.6g", $2 * radius) }
# Loading and unloading with adhesion that acts only after contact, for a work of adhesion `energy` after loading until
# the flat faces have approached by `approach`.
#
# Loading is Hertz: a^2 = Rbar h, F = 4 E* a^3/(3 Rbar), with Rbar = R/2 and 1/E* = 2 (1 - nu^2)/E. Unloading keeps the
# contact radius until the energy release rate at its edge reaches the work of adhesion; from there on it is the branch
# of Johnson, Kendall and Roberts (Proc. R. Soc. A 324, 1971): F = 4 E* a^3/(3 Rbar) - sqrt(8 pi w E* a^3),
# h = a^2/Rbar - sqrt(2 pi w a/E*).
#
# These forms are for half-spaces. A hemisphere driven at its equator lacks the compliance of what lies behind it: its
# approach is smaller by C F/(E R). C follows from converged axisymmetric finite-element solutions of a hemisphere,
# whose forces are 1.019, 1.030, 1.045, 1.068, 1.087, 1.105 times Hertz at h/R = 0.005, 0.01, 0.02, 0.04, 0.06, 0.08
# (tests/reference/README.md, hertz-finite-sphere).
function compliance(force,   i) {
  if (force <= knot_force[1]) return knot_c[1]
  for (i = 2; i <= knots; ++i)
    if (force <= knot_force[i] || i == knots)
      return knot_c[i - 1] + \
             (knot_c[i] - knot_c[i - 1]) * (force - knot_force[i - 1]) / (knot_force[i] - knot_force[i - 1])
}

function hertz(h) { return 4 * reduced * sqrt(mean_radius * h)^3 / (3 * mean_radius) / unit }

# h and a in mm, force in E R^2.
function line(branch, h, force, a) {
  printf "%s,%.6e,%.6e,%.6e,%.6e\n", branch, h / radius, force, h / radius - compliance(force) * force, a / radius
}
function reference(   i, h, a, drop, largest, largest_h, last) {
  points = 200
  knots = split("0.005 0.01 0.02 0.04 0.06 0.08", knot_h, " ")
  split("1.019 1.030 1.045 1.068 1.087 1.105", factor, " ")
  for (i = 1; i <= knots; ++i) {
    knot_force[i] = factor[i] * hertz(knot_h[i] * radius)
    knot_c[i] = knot_h[i] * (factor[i]^(2 / 3) - 1) / knot_force[i]
  }
  largest_h = approach # of half-spaces
  for (i = 0; i < 20; ++i) largest_h = approach + radius * compliance(hertz(largest_h)) * hertz(largest_h)

  print "branch,approach_of_half_spaces [R],force [E R^2],approach [R],contact_radius [R]"
  for (i = 0; i <= points; ++i) {
    h = largest_h * i / points
    line("hertz", h, hertz(h), sqrt(mean_radius * h))
  }
  largest = sqrt(mean_radius * largest_h)
  drop = sqrt(8 * pi * energy * reduced * largest^3)
  for (i = 0; i <= 50; ++i)
    line("constant_radius", largest_h - drop * i / 50 / (2 * reduced * largest), \
         hertz(largest_h) - drop * i / 50 / unit, largest)
  last = (pi * energy * mean_radius^2 / (8 * reduced))^(1 / 3) # where the branch ends when the approach is driven
  for (i = 0; i <= points && last < largest; ++i) {
    a = largest + (last - largest) * i / points
    line("jkr", a^2 / mean_radius - sqrt(2 * pi * energy * a / reduced), \
         (4 * reduced * a^3 / (3 * mean_radius) - sqrt(8 * pi * energy * reduced * a^3)) / unit, a)
  }
}

# ---------------------------------------------------------------------------------------- row
# Loading: mean and largest difference from a fifth of the largest approach on, in parts of the reference. Unloading:
# root mean square down to the reference's pull-off, in parts of the range of forces. Pull-off force in parts of the
# reference's.
part == "row" && FNR == 1 { ++file; next }

part == "row" && file == 1 {
  h = $4
  if ($1 == "hertz") { ++n; load_h[n] = h; load_f[n] = $3; if ($3 > top) top = $3 }
  else { ++m; away_h[m] = h; away_f[m] = $3; if ($3 < lowest) { lowest = $3; lowest_h = h } }
}

# Reference force at an approach; the arrays run in either direction.
function on_loading(h,   i) {
  for (i = 2; i <= n; ++i)
    if (h <= load_h[i])
      return load_f[i - 1] + (load_f[i] - load_f[i - 1]) * (h - load_h[i - 1]) / (load_h[i] - load_h[i - 1])
  return load_f[n] + (load_f[n] - load_f[n - 1]) * (h - load_h[n]) / (load_h[n] - load_h[n - 1])
}
function on_unloading(h,   i) {
  for (i = 2; i <= m; ++i)
    if (h >= away_h[i])
      return away_f[i - 1] + (away_f[i] - away_f[i - 1]) * (h - away_h[i - 1]) / (away_h[i] - away_h[i - 1])
  return away_f[m]
}

part == "row" && file == 2 && $1 == "loading" {
  if ($2 > largest_h) largest_h = $2
  ++rows
  row_h[rows] = $2
  row_f[rows] = $3
}
part == "row" && file == 2 && $1 == "unloading" {
  # Beyond the end of the reference's branch two free bodies ring.
  if ($2 >= away_h[m] && $3 < pull_off) { pull_off = $3; pull_off_h = $2 }
  if (m && $2 >= lowest_h) {
    d = ($3 - on_unloading($2)) / (top - lowest)
    squares += d * d
    ++counted
  }
}

END {
  if (part == "reference") reference()
  if (part != "row") exit
  for (i = 1; i <= rows; ++i)
    if (row_h[i] >= 0.2 * largest_h) {
      d = row_f[i] / on_loading(row_h[i]) - 1
      if (d < 0) d = -d
      sum += d
      if (d > most) most = d
      ++used
    }
  # Largest tension that the bonded area can bear, sigma_0 pi a_max^2 with a_max = 1.25 a_p, over 1.5 pi w Rbar:
  # in Maugis' units (lambda/2) pi 1.25^2 (3/2)^(2/3)/1.5.
  split(label, c, ",")
  print "case,series,energy [N/mm],lambda,fineness,penalty_factor,speed_factor,loading_mean_error," \
        "loading_largest_error,unloading_error,pull_off_over_jkr,strength_cap_over_jkr,element"
  printf "%s,%s,%s,%s,%s,%s,%s,%.5f,%.5f,%.5f,%.5f,%.5f,%s\n", \
         c[1], c[2], c[3], c[4], c[5], c[6], c[7], sum / used, most, \
         (counted ? sqrt(squares / counted) : 0), (lowest < 0 ? pull_off / lowest : 0), \
         c[4] / 2 * 3.14159265 * 1.25^2 * 1.5^(2 / 3) / 1.5, c[8]
}
