# awk -f ../common/verdict.awk -f stress-strain.awk history.csv: mean stress (MPa) against the closing of each wall (mm), the logarithmic
# strain of an edge, and the relative density; every tenth row.
BEGIN { FS = ","; print "closing [mm],strain,relative_density,mean_stress [MPa],kinetic_over_internal" }
NR == 1 { read_header(); next }
{
  if (NR == 2) start = $need("box_lengths_2")
  if ((NR - 2) % 10) next
  internal = $need("elastic_energy") + $need("plastic_dissipation")
  printf "%.4f,%.5f,%.5f,%.5g,%.2e\n", (start - $column["box_lengths_2"]) / 2, $need("axial_strain"), $need("relative_density"), \
         $need("mean_stress"), (internal > 0 ? $need("kinetic_energy") / internal : 0)
}
