# awk -f ../common/verdict.awk -f curve.awk -v radius=0.1 -v gap=1e-6 -v youngs_modulus=5000 history.csv
# Force of a driven pair of hemispheres against the approach of their flat faces, from a run's history. The force is the
# mean of both grips', in which the inertia of the hemispheres cancels.

BEGIN { FS = ","; print "branch,approach [R],force [E R^2]" }

NR == 1 { read_header(); next }

{
  area = $column["box_lengths_0"] * $column["box_lengths_1"]
  force = 0.5 * ($column["wall_stress_4"] + $column["wall_stress_5"]) * area
  approach = 2 * radius + gap - $column["box_lengths_2"]
  printf "%s,%.6e,%.6e\n", ($column["stage"] == 0 ? "loading" : "unloading"), approach / radius, force / (youngs_modulus * radius^2)
}
