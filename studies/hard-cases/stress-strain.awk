# awk -f ../common/verdict.awk -f stress-strain.awk history.csv: mean stress and that of each axis (mean of its two
# walls, MPa) against the closing of each wall (mm), the logarithmic strain of an edge, and the relative density; every
# tenth row.
BEGIN {
  FS = ","
  print "closing [mm],strain,relative_density,mean_stress [MPa],stress_x [MPa],stress_y [MPa],stress_z [MPa]," \
        "kinetic_over_internal"
}
NR == 1 { read_header(); next }
{
  if (NR == 2) start = $need("box_lengths_2")
  if ((NR - 2) % 10) next
  internal = $need("elastic_energy") + $need("plastic_dissipation")
  printf "%.4f,%.5f,%.5f,%.5g,%.5g,%.5g,%.5g,%.2e\n", \
         (start - $column["box_lengths_2"]) / 2, $need("axial_strain"), $need("relative_density"), \
         $need("mean_stress"), axis(0), axis(1), axis(2), (internal > 0 ? $need("kinetic_energy") / internal : 0)
}
function axis(a) { return ($need("wall_stress_" 2 * a) + $need("wall_stress_" 2 * a + 1)) / 2 }
