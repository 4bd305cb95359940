# awk -f vibration.awk vibration-*.csv: a row a run: oscillations in its first and last tenth, energy, frequency.
BEGIN {
  FS = OFS = ","
  print "element,size_ratio,tets,mode,speed [mm/s],viscosity,steps,energy_error_at_end,largest_energy_error," \
        "pressure_rms_first [MPa],pressure_rms_last [MPa],tet_oscillation_first [MPa],tet_oscillation_last [MPa]," \
        "node_oscillation_first [MPa],node_oscillation_last [MPa],frequency [1/s],frequency_error"
}
FNR == 1 { next }
$7 == 1 { rms = $13; tet = $14 * $13; node = $15 * $13 }
$7 == 10 {
  printf "%s,%s,%s,%s,%s,%s,%d,%s,%s,%s,%s,%.4f,%.4f,%.4f,%.4f,%s,%s\n", $1, $2, $3, $4, $5, $6, $8, $10, $11, \
         rms, $13, tet, $14 * $13, node, $15 * $13, $16, $17
}
