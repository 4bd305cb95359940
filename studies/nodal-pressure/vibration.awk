# awk -f vibration.awk vibration-*.csv: a row a run: oscillations in its first and last tenth, energy, frequency.
BEGIN {
  FS = OFS = ","
  print "element,size_ratio,tets,mode,steps,energy_error_at_end,largest_energy_error,pressure_rms_first [MPa],pressure_rms_last [MPa],tet_oscillation_first [MPa],tet_oscillation_last [MPa],node_oscillation_first [MPa],node_oscillation_last [MPa],frequency [1/s],frequency_error"
}
FNR == 1 { next }
$5 == 1 { rms = $11; tet = $12 * $11; node = $13 * $11 }
$5 == 10 {
  printf "%s,%s,%s,%s,%d,%s,%s,%s,%s,%.4f,%.4f,%.4f,%.4f,%s,%s\n", $1, $2, $3, $4, $6, $8, $9, rms, $11, tet, $12 * $11, node, $13 * $11, $14, $15
}
