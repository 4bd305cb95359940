# Reports of pack-gen quality, named quality-SIZE.txt, and paper.csv (size_mm, grains, tets) -> one row for each size.
BEGIN { FS = "," }
FNR == 1 {
  size = FILENAME
  sub(/^.*quality-/, "", size)
  sub(/\.txt$/, "", size)
}
FILENAME ~ /paper\.csv$/ {
  if (FNR > 1) {
    order[++sizes] = $1 + 0
    paper_grains[$1 + 0] = $2
    paper_tets[$1 + 0] = $3
  }
  next
}
/^grains, nodes, tets/ { split($0, word, " +"); grains[size + 0] = word[4]; nodes[size + 0] = word[5]; tets[size + 0] = word[6] }
/^quality, smallest and median/ { split($0, word, " +"); quality[size + 0] = word[5] }
/^facet gap, smallest/ { split($0, word, " +"); gap[size + 0] = word[4] }
END {
  print "size_mm,grains,nodes,tets,paper_tets,paper_tets_per_grain,smallest_quality,smallest_facet_gap_mm"
  for (i = 1; i <= sizes; ++i) {
    s = order[i]
    printf "%s,%s,%s,%s,%s,%.2f,%s,%s\n", s, grains[s], nodes[s], tets[s], paper_tets[s], paper_tets[s] / paper_grains[s], \
           quality[s], gap[s]
  }
}
