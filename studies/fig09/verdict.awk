# awk -f ../common/verdict.awk -f verdict.awk -v mesh=MESH load-density.csv curve.csv
# First file: all curves, of which this computes differences; second: this mesh's own history, for its quality.

BEGIN {
  FS = ","
  fineness = split("coarse,intermediate,medium,paper", order, ",")
  low = 0.70   # below, the packing hardly carries load and fluctuations dominate a relative difference
  high = 0.92
}

FNR == 1 { ++file; split("", column); read_header(); next }
/^#/ { next }

file == 1 {
  n = ++rows[$1]
  density[$1, n] = $2
  stress[$1, n] = $3
}

file == 2 && $need("relative_density") >= low {
  kinetic = $need("kinetic_energy") / ($need("elastic_energy") + $need("plastic_dissipation"))
  if (kinetic > largest_kinetic) largest_kinetic = kinetic
  if ($need("max_penetration") > largest_penetration) largest_penetration = $column["max_penetration"]
  residual = absolute($need("energy_residual") / $need("external_work"))
  if (residual > largest_residual) largest_residual = residual
  ++quality_rows
}

# Mean stress of a mesh at a density, between the rows that enclose it.
function stress_at(name, value,   i, t) {
  for (i = 2; i <= rows[name]; ++i)
    if (density[name, i] >= value * (1 - 1e-6)) {
      t = (value - density[name, i - 1]) / (density[name, i] - density[name, i - 1])
      return stress[name, i - 1] + t * (stress[name, i] - stress[name, i - 1])
    }
  return stress[name, rows[name]]
}

# Largest |difference| of two meshes from `low` to `high`, relative to the second.
function largest_difference(first, second,   value, d, most) {
  for (value = low; value <= high + 1e-9; value += 0.01) {
    d = absolute(stress_at(first, value) / stress_at(second, value) - 1)
    if (d > most) most = d
  }
  return most
}

function percent(x) { return sprintf("%.2g %%", 100 * x) }

END {
  if (failed) exit 1
  if (!rows[mesh] || !quality_rows) {
    print "verdict: no rows of mesh '" mesh "' from D_r = " low > "/dev/stderr"
    exit 1
  }
  top = stress_at(mesh, high)
  statement("Mean stress at a relative density of 0.92 lies above the 60 MPa to which the paper unloads from there (fig24)", \
            "> 60 MPa", sprintf("%.1f MPa", top), (mesh == "smoke" ? -1 : top > 60), \
            mesh == "smoke" ? "a packing this small has another curve; judged from MESH=coarse on" : "no stress of this curve is stated in the text")

  if (rows["medium"] && rows["paper"]) {
    d = largest_difference("medium", "paper")
    statement("The curves of 0.015 mm and 0.0075 mm nearly coincide", "nearly coincide", \
              percent(d) " largest difference from D_r = 0.70", d <= 0.03, "taken as agreement: at most 3 %")
  } else
    statement("The curves of 0.015 mm and 0.0075 mm nearly coincide", "nearly coincide", "not run", -1, \
              "needs MESH=medium and MESH=paper")

  present = 0
  for (i = 1; i <= fineness; ++i) if (rows[order[i]]) name[++present] = order[i]
  if (present >= 2) {
    falling = 1
    list = ""
    for (i = 1; i <= present; ++i) {
      list = list sprintf("%s%s %.1f MPa", (i > 1 ? ", " : ""), name[i], stress_at(name[i], high))
      if (i > 1 && stress_at(name[i], high) > stress_at(name[i - 1], high)) falling = 0
    }
    statement("Coarser meshes are stiffer: at D_r = 0.92 the stress falls with every refinement", "coarse meshes too stiff", \
              list, falling, "")
  } else
    statement("Coarser meshes are stiffer: at D_r = 0.92 the stress falls with every refinement", "coarse meshes too stiff", \
              "one mesh only", -1, "needs at least two of MESH=coarse, intermediate, medium, paper")

  statement("The loading is quasi-static: kinetic over internal energy from D_r = 0.70", "quasi-static", \
            percent(largest_kinetic), largest_kinetic <= 0.01, "taken as quasi-static: at most 1 %")
  statement("The energy balance closes: residual over external work from D_r = 0.70", "not stated", \
            percent(largest_residual), largest_residual <= 0.01, "own requirement: at most 1 %")
  statement("Contact penetration stays small against the element size from D_r = 0.70", "not significant", \
            percent(largest_penetration), largest_penetration <= 0.05, "own requirement: at most 5 %")
  end_of_verdict()
}
