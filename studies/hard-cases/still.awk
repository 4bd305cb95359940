# awk -f ../common/verdict.awk -f still.awk history.csv: what a million steps changed in a compact at rest; energies as
# parts of the elastic energy at the beginning.
BEGIN { FS = "," }
NR == 1 { read_header(); next }
{
  if (!n++) {
    elastic = $need("elastic_energy")
    bonds = $need("bond_energy")
    plastic = $need("plastic_dissipation")
    damage = $need("damage_dissipation")
    stress = $need("mean_stress")
    first = $need("step")
    residual = $need("energy_residual")
    begin_kinetic = $need("kinetic_energy")
  }
  if ($column["kinetic_energy"] > kinetic && n > 1) kinetic = $column["kinetic_energy"]
  last = $column["step"]
  end_elastic = $column["elastic_energy"]
  end_bonds = $column["bond_energy"]
  end_plastic = $column["plastic_dissipation"]
  end_damage = $column["damage_dissipation"]
  end_stress = $column["mean_stress"]
  end_residual = $column["energy_residual"]
  end_kinetic = $column["kinetic_energy"]
}
END {
  if (failed) exit 1
  print "quantity,value"
  printf "steps,%d\n", last - first
  printf "elastic energy at the beginning [mJ],%.6g\n", elastic
  printf "change of elastic energy,%.2e\n", end_elastic / elastic - 1
  printf "change of the energy of bonds,%.2e\n", (bonds > 0 ? end_bonds / bonds - 1 : 0)
  printf "plastic dissipation over elastic energy,%.2e\n", (end_plastic - plastic) / elastic
  printf "damage dissipation over elastic energy,%.2e\n", (end_damage - damage) / elastic
  printf "kinetic over elastic energy at the beginning,%.2e\n", begin_kinetic / elastic
  printf "largest kinetic over elastic energy after that,%.2e\n", kinetic / elastic
  printf "kinetic over elastic energy at the end,%.2e\n", end_kinetic / elastic
  printf "change of mean stress,%.2e\n", end_stress / stress - 1
  printf "residual over elastic energy,%.2e\n", (end_residual - residual) / elastic
}
