# awk -f case.awk -v case=NAME -v mesh=MESH -v part=list|mesh|run|energy cases.csv
# What one case of cases.csv means: options of pack-gen hemispheres, of mpfem run, or its fracture energy.
#
# Everything scales with the contact radius at the pull-off of Johnson, Kendall and Roberts, a_p = (9 pi w Rbar^2/(8 E*))^(1/3):
# element size a_p/fineness, pressing until the contact radius is 1.25 a_p, unloading by 2 a_p^2/R beyond the first touch.
# The strength follows from Maugis' parameter, lambda = 2 sigma_0 (Rbar/(pi w K^2))^(1/3), K = 4 E*/3.

BEGIN { FS = ","; pi = atan2(0, -1); radius = 0.1; reduced = 5000 / (2 * (1 - 0.3^2)); mean_radius = radius / 2 }
NR == 1 { next }
part == "list" { if (mesh != "smoke" || $8) printf "%s ", $1; next }
$1 == case {
  energy = $3
  fineness = mesh == "smoke" ? $5 / 3 : $5
  speed_factor = mesh == "smoke" ? 2 * $7 : $7
  a = (9 * pi * energy * mean_radius^2 / (8 * reduced))^(1 / 3)
  size = a / fineness
  approach = (1.25 * a)^2 / mean_radius
  if (part == "energy") print energy
  if (part == "mesh") printf "--radius %g --size %g --contact-size %.4g --contact-radius %.4g --bulk-size %.4g --gap 1e-6\n", \
                             radius, 0.12 * radius, size, 1.4 * a, 2 * size
  if (part == "run") {
    if ($2 == "law") printf "--set bond.softening=energy "
    if ($9 != "tet4-anp") printf "--set element.type=%s ", $9
    strength = $4 / 2 * (pi * energy * (4 * reduced / 3)^2 / mean_radius)^(1 / 3)
    step = 4e-7 * size
    speed = speed_factor * 300 * a / 0.00685
    printf "--set bond.fracture_energy=%g --set bond.tensile_strength=%.6g --set bond.shear_strength=%.6g " \
           "--set contact.stiffness_factor=%g --set numerics.mass_scaling_step=%.4g " \
           "--set stages.0.displacement=%.8g --set stages.0.speed=%.4g --set stages.1.displacement=%.8g --set stages.1.speed=%.4g\n", \
           energy, strength, strength, $6, step, -(approach + 1e-6), speed, approach + 2 * a * a / radius, speed
  }
}
