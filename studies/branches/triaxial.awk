# Shared by verdicts on tables of stage-curves.awk: read_curves() for every row; then, by run, in the order of the file,
# run[1..runs], value at the end, largest q and where, and how well the test was done.

function read_curves(   r, error) {
  r = $need("run")
  if (!(r in rows)) {
    run[++runs] = r
    softening[r] = $need("softening")
    fracture_energy[r] = $need("fracture_energy_N_per_mm") + 0
    density[r] = $need("relative_density_max") + 0
    confinement[r] = $need("confining_stress_MPa") + 0
    q_max[r] = contraction_max[r] = -1e9
  }
  ++rows[r]
  strain[r] = $need("axial_strain")
  volumetric[r] = $need("volumetric_strain")
  q[r] = $need("deviatoric_stress_MPa")
  plastic[r] = $need("plastic_dissipation_mJ")
  damage[r] = $need("damage_dissipation_mJ")
  mean_damage[r] = $need("mean_damage")
  if (q[r] > q_max[r]) { q_max[r] = q[r]; q_max_at[r] = strain[r] }
  if (volumetric[r] > contraction_max[r]) { contraction_max[r] = volumetric[r]; contraction_max_at[r] = strain[r] }
  if (strain[r] > 0.02) {
    error = absolute($need("lateral_force_ratio") - 1)
    if (error > force_error[r]) force_error[r] = error
    ++force_rows[r]
    force_square[r] += error * error
  }
  if ($need("kinetic_ratio") > kinetic_max[r]) kinetic_max[r] = $column["kinetic_ratio"]
}

# A fall of 2 % from the largest q, as `postproc strength` has it.
function softens(r) { return q[r] < 0.98 * q_max[r] }

# Statements on how the tests were done, the same for every figure of them.
function statements_of_quality(   i, r, force, other, other_mean, mean, kinetic) {
  for (i = 1; i <= runs; ++i) {
    r = run[i]
    mean = force_rows[r] ? sqrt(force_square[r] / force_rows[r]) : 0
    if (!softens(r)) { if (force_error[r] > force) force = force_error[r] }
    else {
      if (force_error[r] > other) other = force_error[r]
      if (mean > other_mean) other_mean = mean
    }
    if (kinetic_max[r] > kinetic) kinetic = kinetic_max[r]
  }
  statement("The force on the lateral walls stays what it is at the confining stress: departure after 2 % of axial strain", \
            "constant", sprintf("at most %.2g %% where samples harden; at most %.2g %%, root mean square %.2g %%, where they soften", \
                                100 * force, 100 * other, 100 * other_mean), \
            force <= 0.01 && other_mean <= 0.01 && other <= 0.1, \
            "own requirement: 1 %; in the root mean square where bonds break and grains jerk loose, and 10 % at most")
  statement("The tests are quasi-static: largest kinetic over internal energy", "quasi-static", sprintf("%.2g %%", 100 * kinetic), \
            kinetic <= 0.01, "own requirement: at most 1 %")
}
