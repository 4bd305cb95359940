# awk -f ../common/verdict.awk -f verdict.awk -v packing=full|smoke meshes.csv
BEGIN { FS = "," }
FNR == 1 { read_header(); next }
$need("tets") + 0 > 0 {
  if (packing == "full") {
    ratio = $column["tets"] / $need("paper_tets")
    statement("Tetrahedra at a nominal size of " $need("size_mm") " mm", $column["paper_tets"], \
              $column["tets"] sprintf(" (%+.1f %%)", 100 * (ratio - 1)), absolute(ratio - 1) <= 0.1, \
              "taken as agreement: within 10 %, since mean edges differ between meshers")
  } else {
    per_grain = $column["tets"] / $need("grains")
    ratio = per_grain / $need("paper_tets_per_grain")
    statement("Tetrahedra of a grain, mean, at a nominal size of " $need("size_mm") " mm", \
              sprintf("%.0f", $column["paper_tets_per_grain"]), sprintf("%.0f (%+.1f %%)", per_grain, 100 * (ratio - 1)), \
              absolute(ratio - 1) <= 0.25, "small packing: mean grain volume differs, so within 25 %")
  }
  statement("Facets of different grains stay apart at " $column["size_mm"] " mm: smallest gap", "no penetration", \
            $need("smallest_facet_gap_mm") " mm", $column["smallest_facet_gap_mm"] > 0, "")
  ++meshes
}
$need("tets") + 0 == 0 {
  statement("Tetrahedra at a nominal size of " $need("size_mm") " mm", $need("paper_tets"), "not meshed", -1, \
            "meshed with a finer MESH")
}
END {
  if (failed || !meshes) exit 1
  end_of_verdict()
}
