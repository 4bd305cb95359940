# awk -f ../common/verdict.awk -f stage-curves.awk out/MESH/branches/NAME/curve.csv...: triaxial branches as one table. Strains
# are logarithmic, compression positive, and like the dissipated energies counted from the beginning of the test.
# NAME: [energy-]gG-DD-pP-...: softening law, fracture energy in N/mm, largest relative density, confining stress in MPa.
BEGIN {
  FS = ","
  print "run,softening,fracture_energy_N_per_mm,relative_density_max,confining_stress_MPa,axial_strain,volumetric_strain," \
        "mean_stress_MPa,deviatoric_stress_MPa,plastic_dissipation_mJ,damage_dissipation_mJ,mean_damage,lateral_force_ratio,kinetic_ratio"
}

FNR == 1 {
  read_header()
  folders = split(FILENAME, folder, "/")
  name = folder[folders - 1]
  split(name, part, "-")
  softening = part[1] == "energy" ? "energy" : "exponential"
  first = softening == "energy" ? 2 : 1
  energy = substr(part[first], 2)
  density = substr(part[first + 1], 2)
  confinement = substr(part[first + 2], 2)
  begun = 0
  next
}
/^#/ { next }

{
  x = $need("box_lengths_0"); y = $need("box_lengths_1"); z = $need("box_lengths_2")
  if (!begun) {
    begun = 1
    x0 = x; y0 = y; z0 = z
    plastic0 = $need("plastic_dissipation")
    damage0 = $need("damage_dissipation")
  }
  force = ($need("wall_stress_0") + $need("wall_stress_1")) / 2 * y * z + ($need("wall_stress_2") + $need("wall_stress_3")) / 2 * x * z
  kinetic = $need("kinetic_energy") / ($need("elastic_energy") + $column["plastic_dissipation"])
  printf "%s,%s,%s,%s,%s,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.5f,%.3g\n", name, softening, energy, density, confinement, \
         log(z0 / z), log(x0 * y0 * z0 / (x * y * z)), $need("mean_stress"), $need("deviatoric_stress"), \
         $column["plastic_dissipation"] - plastic0, $column["damage_dissipation"] - damage0, $need("mean_damage"), \
         force / (confinement * (y0 * z0 + x0 * z0)), kinetic
}

END { exit failed }
