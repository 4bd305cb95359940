# awk -f similarity.awk -v radius=0.1 -v youngs_modulus=5000 -v poissons_ratio=0.3 -v coefficient=160 -v exponent=0.4 \
#     -v energy=0.01 -v approach=0.004
# Similarity law of two equal elasto-plastic spheres that bond where they touch, as the paper's Fig. 5 uses it, in mm and N.
# Columns: branch, approach over radius, force over E R^2, contact radius over radius.
#
# Loading (Storakers, Biwa and Larsson 1997; Mesarovic and Johnson 2000; Gonzalez 2019), flow curve sigma = kappa eps^p:
#   a^2 = 2 c^2 Rbar gamma, P = n_P a^(2 + p), n_P = pi k Rbar^-p (2 kappa^(-1/p))^-p, k = 3 6^-p, c^2 = 1.43 exp(-0.97 p).
# Unloading with toughness K = sqrt(2 G^c E*), x = a/a_P, p_0 = P_P/(pi a_P^2): the contact radius stays at a_P with slope
# 2 E* a_P until the force has fallen by 2 sqrt(pi) K a_P^1.5, then
#   P = (2 P_P/pi)(asin x - x sqrt(1 - x^2)) - 2 sqrt(pi) K a^1.5,
#   gamma = gamma_P - (2 p_0/E*) sqrt(a_P^2 - a^2) - sqrt(pi a) K/E*.

function line(branch, h, force, a) { printf "%s,%.6e,%.6e,%.6e\n", branch, h / radius, force / (youngs_modulus * radius^2), a / radius }
function asin(x) { return atan2(x, sqrt(1 - x * x)) }
function contact_radius(h) { return sqrt(2 * c2 * mean_radius * h) }

BEGIN {
  pi = atan2(0, -1)
  reduced = youngs_modulus / (2 * (1 - poissons_ratio^2))
  mean_radius = radius / 2
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
  for (i = 0; i <= 50; ++i) line("constant_radius", approach - drop * i / 50 / (2 * reduced * largest), top - drop * i / 50, largest)
  for (i = 0; i <= points; ++i) {
    x = 1 - 0.7 * i / points
    a = x * largest
    h = approach - 2 * pressure / reduced * sqrt(largest^2 - a^2) - sqrt(pi * a) * toughness / reduced
    if (i > 0 && h > last_h) break # where the branch ends when the approach is driven
    line("bonded", h, 2 * top / pi * (asin(x) - x * sqrt(1 - x * x)) - 2 * sqrt(pi) * toughness * a^1.5, a)
    last_h = h
  }
}
