# awk -f case.awk -v sets='default large' cases.csv: the cases as words for make,
# CASE|SCENE|MESH|SCENARIO|OPTIONS|RECOVERY, blanks in options as ';'. MESH is KIND-FINENESS as mesh.sh reads it,
# OPTIONS are KEY=VALUE words of the scenario, RECOVERY those of recovery.toml, which packings go on with ('-': no such
# run). Scenes with friction are run by the program friction-accuracy: SCENARIO is the header that defines the scene,
# OPTIONS are its arguments, MESH is '-'.
#
# Masses of hemispheres follow the step that they are made for, 4e-7 s/mm times the element size (studies/fig04):
# mass_factor times the mass is a step longer by the root of it.

BEGIN {
  FS = ","
  split(sets, names, " ")
  for (i in names) wanted[names[i]] = 1
  kind["hertz"] = kind["flattened"] = "free"
  scenario["hertz"] = "studies/accuracy/sphere-elastic.toml"
  scenario["flattened"] = "studies/accuracy/sphere-plastic.toml"
  scenario["confined"] = "studies/accuracy/sphere-confined.toml"
  scenario["pair"] = "studies/accuracy/pair.toml"
  scenario["pull-off"] = "studies/fig04/hemispheres.toml"
  scenario["small"] = scenario["full"] = "studies/compaction/compaction.toml"
  scenario["partial-slip"] = "tests/support/partial_slip.hpp"
  scenario["die-column"] = "tests/support/die_column.hpp"
  # Contact radius at an approach of 0.08 R (similarity law) and at the pull-off with 0.1 N/mm, mm: as in mesh.sh.
  contact_radius["pair"] = 0.0278586
  contact_radius["pull-off"] = 0.00685143
}
NR == 1 || /^#/ || !($9 in wanted) { next }
{
  scene = $2
  if (!(scene in scenario)) {
    print "cases.csv: " $1 ": no scene " scene > "/dev/stderr"
    exit 1
  }
  if (scenario[scene] ~ /hpp$/) {
    print $1 "|" scene "|-|" scenario[scene] "|" scene ";" $4 ";" $5 "|-"
    next
  }
  options = "element.type=" $4 " contact.stiffness_factor=" $6
  if ($3 == "precision") options = options " element.precision=mixed"
  if ($3 == "surface") options = options " contact.surface=smooth"
  recovery = "-"
  if (scene in contact_radius) {
    options = options sprintf(" numerics.mass_scaling_step=%.4g", 4e-7 * contact_radius[scene] / $5 * sqrt($8))
    options = options speed(0, 300)
  } else if ($8 != 1) options = options " numerics.mass_scaling=" $8
  # Maugis' lambda = 2; pressing until the contact radius is 1.25 of that at the pull-off, then away
  # (studies/fig04/figure.toml).
  if (scene == "pull-off")
    options = options speed(1, 300) \
              " bond.fracture_energy=0.1 bond.tensile_strength=438.48 bond.shear_strength=438.48" \
              " stages.0.displacement=-0.00146798 stages.1.displacement=0.00240583"
  if (scene == "hertz") options = options speed(0, 2000)
  if (scene == "flattened") options = options speed(0, 4000)
  if (scene == "confined") options = options speed(0, 4000) speed(1, 4000)
  if (scene == "small" || scene == "full") {
    recovery = options speed(1, 1000) speed(3, 1000)
    if ($3 == "pace") options = options " stages.0.quasi_static.stress_tolerance=0.05" # of the compaction alone
    options = options speed(0, 4000) " output.snapshot_relative_densities=[] output.snapshot_at_stage_end=false"
  }
  gsub(/ /, ";", options)
  gsub(/ /, ";", recovery)
  print $1 "|" scene "|" (scene in kind ? kind[scene] : scene) "-" $5 "|" scenario[scene] "|" options "|" recovery
}
function speed(stage, value) {
  return sprintf(" stages.%d.%s=%g", stage, scene in contact_radius ? "speed" : "wall_speed", value * $7)
}
