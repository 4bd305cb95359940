# awk -f reference.awk -v radius=0.1 -v youngs_modulus=5000 -v poissons_ratio=0.3 -v energy=0.1 -v approach=0.0015
# Loading and unloading of two equal elastic hemispheres with adhesion that acts only after contact, in mm and N, for a
# work of adhesion `energy` (N/mm) after loading until the flat faces have approached by `approach` (mm).
#
# Loading is Hertz: a^2 = Rbar h, F = 4 E* a^3/(3 Rbar), with Rbar = R/2 and 1/E* = 2 (1 - nu^2)/E. Unloading keeps the
# contact radius until the energy release rate at its edge reaches the work of adhesion; from there on it is the branch of
# Johnson, Kendall and Roberts (Proc. R. Soc. A 324, 1971): F = 4 E* a^3/(3 Rbar) - sqrt(8 pi w E* a^3),
# h = a^2/Rbar - sqrt(2 pi w a/E*).
#
# These forms are for half-spaces. A hemisphere driven at its equator lacks the compliance of what lies behind it: its
# approach is smaller by C F/(E R). C follows from converged axisymmetric finite-element solutions of a hemisphere, whose
# forces are 1.019, 1.030, 1.045, 1.068, 1.087, 1.105 times Hertz at h/R = 0.005, 0.01, 0.02, 0.04, 0.06, 0.08
# (tests/reference/README.md, hertz-finite-sphere).

function compliance(force,   i) {
  if (force <= knot_force[1]) return knot_c[1]
  for (i = 2; i <= knots; ++i)
    if (force <= knot_force[i] || i == knots)
      return knot_c[i - 1] + (knot_c[i] - knot_c[i - 1]) * (force - knot_force[i - 1]) / (knot_force[i] - knot_force[i - 1])
}

function hertz(h) { return 4 * reduced * sqrt(mean_radius * h)^3 / (3 * mean_radius) / unit }

# h and a in mm, force in E R^2.
function line(branch, h, force, a) {
  printf "%s,%.6e,%.6e,%.6e,%.6e\n", branch, h / radius, force, h / radius - compliance(force) * force, a / radius
}

BEGIN {
  pi = atan2(0, -1)
  reduced = youngs_modulus / (2 * (1 - poissons_ratio^2))
  mean_radius = radius / 2
  unit = youngs_modulus * radius^2
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
    line("constant_radius", largest_h - drop * i / 50 / (2 * reduced * largest), hertz(largest_h) - drop * i / 50 / unit, largest)
  last = (pi * energy * mean_radius^2 / (8 * reduced))^(1 / 3) # where the branch ends when the approach is driven
  for (i = 0; i <= points && last < largest; ++i) {
    a = largest + (last - largest) * i / points
    line("jkr", a^2 / mean_radius - sqrt(2 * pi * energy * a / reduced), \
         (4 * reduced * a^3 / (3 * mean_radius) - sqrt(8 * pi * energy * reduced * a^3)) / unit, a)
  }
}
