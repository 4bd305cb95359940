# awk -f ../common/verdict.awk -f values.awk -v scene=SCENE curve.csv [recovery.curve.csv]: what a case came to,
# quantity,value.
#
#   hertz       force on a sphere over E R^2 at an approach of 0.02 R and 0.04 R to either plane, mean of four spheres
#   flattened   the same at 0.042, 0.088 and 0.135 R
#   confined    axial stress in MPa at relative densities of 0.70, 0.80 and 0.92
#   pair        force over E R^2 at an approach of the flat faces of 0.02, 0.04, 0.06 and 0.08 R
#   pull-off    the same at 0.01 R, and the largest tension
#   small, full mean stress in MPa at relative densities of 0.70, 0.80 and 0.92; elastic recovery and Young's modulus of
#               the compact in MPa, the slope of axial stress over axial strain from 0.004 to 0.010
#
# What the scenes with friction came to is defined in tests/benchmarks/friction_accuracy.cpp.
#
# E = 5000 MPa, R = 0.1 mm in all.

BEGIN {
  FS = ","
  unit = 5000 * 0.1^2
  gap = 1e-6 # between the tips of hemispheres
  print "quantity,value"
}

FNR == 1 { ++file; split("", column); read_header(); split("", last); next }

{
  density = $need("relative_density")
  height = $need("box_lengths_2")
  axial = ($need("wall_stress_4") + $need("wall_stress_5")) / 2
  force = axial * $need("box_lengths_0") * $need("box_lengths_1") / unit
  stage = $need("stage")
}

# Prints what y is when x, which rises, first passes one of `marks`.
function passing(name, x, y, marks,   many, mark, i, t) {
  many = split(marks, mark, " ")
  for (i = 1; i <= many; ++i)
    if (!((name, i) in done) && x >= mark[i] * (1 - 1e-9)) {
      t = (name, "x") in last ? (mark[i] - last[name, "x"]) / (x - last[name, "x"]) : 1
      printf "%s-%s,%.6e\n", name, mark[i], (name, "y") in last ? last[name, "y"] + t * (y - last[name, "y"]) : y
      done[name, i] = 1
    }
  last[name, "x"] = x
  last[name, "y"] = y
}

scene == "hertz" { passing("force", 1 - height / 0.2, force / 4, "0.02 0.04") }
scene == "flattened" { passing("force", 1 - height / 0.2, force / 4, "0.042 0.088 0.135") }
scene == "confined" && stage == 1 { passing("axial-stress", density, axial, "0.7 0.8 0.92") }
scene == "pair" { passing("force", (0.2 + gap - height) / 0.1, force, "0.02 0.04 0.06 0.08") }
scene == "pull-off" && stage == 0 { passing("force", (0.2 + gap - height) / 0.1, force, "0.01") }
# Beyond the end of the theory's branch, at -0.0065 R, two free bodies ring.
scene == "pull-off" && stage == 1 && (0.2 + gap - height) / 0.1 > -0.0065 && -force > tension { tension = -force }

(scene == "small" || scene == "full") && file == 1 {
  passing("mean-stress", density, $need("mean_stress"), "0.7 0.8 0.92")
}
(scene == "small" || scene == "full") && file == 2 {
  if (density > densest) densest = density
  if (stage == 1) unloaded = density
  if (stage == 2) rested = height
  if (stage == 3) {
    strain = log(rested / height)
    if (strain >= 0.004 && strain <= 0.010) {
      ++n
      sx += strain
      sy += axial
      sxx += strain * strain
      sxy += strain * axial
    }
  }
}

END {
  if (failed) exit 1
  if (scene == "pull-off") printf "pull-off,%.6e\n", tension
  if (file == 2) {
    printf "recovery,%.6e\n", (densest - unloaded) / densest
    printf "modulus,%.6e\n", (n * sxy - sx * sy) / (n * sxx - sx * sx)
  }
}
