# awk -f case.awk -v case=NAME -v mesh=MESH -v part=list|mesh|run|approach|hardening cases.csv
# What one case of cases.csv means. Element size: the contact radius at the largest approach, a = sqrt(2 c^2 Rbar h) with
# c^2 = 1.43 exp(-0.97 . 0.4) of the similarity law, over fineness.

BEGIN { FS = ","; radius = 0.1 }
NR == 1 { next }
part == "list" { if (mesh != "smoke" || $7) printf "%s ", $1; next }
$1 == case {
  h = $3 * radius
  a = sqrt(2 * 1.43 * exp(-0.97 * 0.4) * radius / 2 * h)
  fineness = mesh == "smoke" ? $5 / 2 : $5
  size = a / fineness
  if (part == "approach") print h
  if (part == "hardening") print $2
  if (part == "mesh") printf "--radius %g --size %g --contact-size %.4g --contact-radius %.4g --bulk-size %.4g --gap 1e-6\n", \
                             radius, 0.12 * radius, size, 1.1 * a, 2 * size
  if (part == "run") {
    speed = 300 * (mesh == "smoke" ? 2 : 1) * $6
    if ($2 == "power")
      printf "--set material.hardening.law=power --set material.hardening.yield_stress=25 --set material.hardening.coefficient=125 --set material.hardening.exponent=0.3 "
    if ($9 != "tet4-anp") printf "--set element.type=%s ", $9
    if ($8 != 10) printf "--set contact.stiffness_factor=%g ", $8
    printf "--set bond.tensile_strength=%g --set bond.shear_strength=%g --set numerics.mass_scaling_step=%.4g " \
           "--set stages.0.displacement=%.8g --set stages.0.speed=%.4g --set stages.1.displacement=%.8g --set stages.1.speed=%.4g --set stages.2.displacement=%.8g --set stages.2.speed=%.4g\n", \
           $4, $4, 4e-7 * size, -(h + 1e-6), speed, 0.45 * h, speed, 0.25 * h, speed
  }
}
