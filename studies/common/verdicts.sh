#!/bin/sh
# verdicts.sh POSTPROC: writes docs/verdicts.md from the verdicts that are kept in studies/results.
set -eu
postproc=$1
results=studies/results

# Columns of studies that repeat parts of figures. `add COLUMN STUDY FIGURE…` puts each statement of a study to the
# first of these figures that has a statement of the same text with MESH=coarse, and the others to the last one.
# Statements stand one a line in verdict.json.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
statements() { grep '"statement":' $results/"$1"/verdict.json; }
texts() { statements "$1" | sed 's/,"paper":.*//'; }
as_list() {
  awk 'BEGIN { printf "[" } { sub(/,$/, ""); printf "%s%s", NR == 1 ? "\n" : ",\n", $0 } END { print "\n]" }'
}
add() {
  column=$1 study=$2
  shift 2
  statements "$study" >"$work/left"
  for figure in "$@"; do
    mkdir -p "$work/$column/$figure"
    { if [ $# = 1 ]; then echo; else texts "coarse/$figure"; fi; } >"$work/texts" # an empty line matches all
    grep -Ff "$work/texts" "$work/left" | as_list >"$work/$column/$figure/verdict.json"
    grep -vFf "$work/texts" "$work/left" >"$work/rest" || true
    mv "$work/rest" "$work/left"
    shift
  done
}
add paper-mesh medium-tet4/paper-mesh fig10 fig11 fig12 fig22
add stiff-bonds own/paper-bonds fig20 fig22
add finest own/finest-mesh fig09 fig08
mkdir "$work/finest/fig07"
cp $results/paper/fig07/verdict.json "$work/finest/fig07/"
# The densities between which samples saturate at the paper's modulus, in the words of that study's statement.
saturated=$(statements coarse/saturated-modulus |
  sed -n 's/.*samples compacted to \([0-9.]*\) and to \([0-9.]*\), .*/\1 to \2/p')
[ -n "$saturated" ] || { echo "verdicts.sh: saturated-modulus/verdict.json states no densities" >&2 && exit 1; }

{
  cat <<END
# Verdicts

Every statement that a figure of Ku, Zhao, Mollon and Zhao makes, compared with our result, and why it differs where
that is known.

## Which conclusions of the paper hold

In words; the tables below have the numbers.

| conclusion | holds? | why |
|---|---|---|
| Coarse meshes are too stiff, and 0.015 mm is fine enough for the load curve ([fig09], [finest mesh]) | in part | \
the stress falls with every refinement; at 0.015 mm it still does, because the error of plain tetrahedra falls with \
the square of their size |
| Elastic recovery grows with the density reached and falls with the grains' Young's modulus ([fig10]) | yes | with \
both elements and both contact surfaces; the density at which the slope changes is \
not certain |
| The elastic energy at the largest density hardly depends on the grains' Young's modulus, nor the energy locked in \
once divided by it ([fig11], [locking]) | no | only plain tetrahedra come close, for which the grains' falling and \
the element's rising energy nearly balance; most of what they keep belongs to the element |
| The compact's modulus is exponential in the porosity, and saturates with the fracture energy ([fig12], [fig16]) | \
yes, if samples were compacted to $saturated | these saturate at the paper's value; the paper does not state their \
density |
| Unconfined strength grows exponentially with density and with fracture energy, and samples fail in bands ([fig13], \
[fig14], [fig15], [fig16]) | in part | by Eq. 5 read literally strong bonds outlast the grains, without peak or band, \
and weak ones fail in bands; by the law of Fig. 3 strong ones fail too, in bands that hardly stand out, and strength \
is exponential in the porosity; with fracture energy it saturates by either law |
| Strong bonds make triaxial samples harden and contract, weak ones soften and expand ([fig18], [fig20], [fig21]) | \
yes | by Eq. 5 read literally; by the law of Fig. 3 samples with strong bonds soften and expand too |
| Triaxial strength follows Eq. 13 ([fig22]) | in part | the form fits, and strong bonds agree; grains without bonds \
carry less, and C and D differ; with friction of 0.3 between grains, which \
the paper excludes, B and C match the paper; D does not |
| Cohesion enlarges the yield surface at high mean stress ([fig24]) | yes | with both elements and both contact \
surfaces; here it does so at low mean stress too, where the paper infers the opposite |
| In load cycles samples with cohesion become looser and those without denser, which also dissipate more ([fig25], \
[fig26]) | in part | without cohesion all agrees; with cohesion samples \
become looser in one setting, and very little ([cycle-density]); the ratio of both dissipations is the paper's in some \
settings only |

[fig09]: ../studies/fig09/README.md
[fig10]: ../studies/fig10/README.md
[fig11]: ../studies/fig11/README.md
[fig12]: ../studies/fig12/README.md
[fig13]: ../studies/fig13/README.md
[fig14]: ../studies/fig14/README.md
[fig15]: ../studies/fig15/README.md
[fig16]: ../studies/fig16/README.md
[fig18]: ../studies/fig18/README.md
[fig20]: ../studies/fig20/README.md
[fig21]: ../studies/fig21/README.md
[fig22]: ../studies/fig22/README.md
[fig24]: ../studies/fig24/README.md
[fig25]: ../studies/fig25/README.md
[fig26]: ../studies/fig26/README.md
[cycle-density]: ../studies/cycle-density/README.md
[finest mesh]: ../studies/finest-mesh/README.md
[locking]: ../studies/locking/README.md

## Every statement

- \`coarse\` is the paper's packing of 329 grains at its coarsest mesh (0.03 mm), \`medium\` the same at 0.015 mm,
  \`smoke\` 25 grains. Grains touch with their facets, as in the paper.
- \`finest\` is the paper's packing at 0.0075 mm. Its fig08 and fig09 are those of [finest
  mesh](../studies/finest-mesh/README.md), with walls at 8 instead of 4 m/s.
- \`plain\` is \`coarse\` with plain tetrahedra, the paper's element (\`ELEMENT=tet4\`). The others have averaged nodal
  pressure from fig10 on.
- \`paper-mesh\` is the paper's own choice from fig10 on, plain tetrahedra of 0.015 mm. A round of all figures would
  take days; these are the parts of figures in [paper-mesh](../studies/paper-mesh/README.md).
- \`smooth\` is the packing of 329 grains with smooth surfaces at 0.04 mm (\`MESH=coarser SURFACE=smooth\`). Its mean
  stresses are the closest to the converged ones ([speed against error](speed-against-error/README.md)).
- \`stiff-bonds\` is \`smooth\` with bonds as stiff as those of the paper's mesh, and with slower walls
  ([paper-bonds](../studies/paper-bonds/README.md)).
- The reasons begin with *the paper's choice* (an unstated choice, identified here, explains the difference), *the
  paper's error* (the number belongs to the method and not to the grains) or *open*.
- Where a cell is empty, the figure was not made with this mesh, or the statement needs another one.
- We had the paper's text, but not its plots. What it only draws is judged by what its text says of the curve.
- Statements are judged by the softening law \`energy\`, which reads Eq. 5 literally. The law \`exponential\`, the
  curve that Fig. 3 draws, is reported without verdicts. Exceptions: fig03 judges both laws. fig04 and fig05 are judged
  by the law \`exponential\`, since no mesh there resolves the law \`energy\` with bonds as stiff as the penalty. What
  fig10 to fig20 say of kinetic energy, forces and the energy balance covers both.
- Limits such as 2 % are this project's. Some statements are its own aims and not the paper's: loading and unloading in
  fig04, loading in fig05, and that tests are quasi-static and forces even (fig10 to fig20). They count like the others,
  including those that differ.
- [What the paper did](what-the-paper-did.md) shows the choices. The notes of
  \`studies/results/MESH/figNN/verdict.json\` say how each statement is judged.

\`make -f Makefile.studies keep MESH=NAME\` writes this page.

END
  "$postproc" verdicts coarse=$results/coarse plain=$results/coarse-tet4 smooth=$results/coarser-smooth \
    stiff-bonds="$work/stiff-bonds" paper-mesh="$work/paper-mesh" medium=$results/medium finest="$work/finest" \
    smoke=$results/smoke
} >docs/verdicts.md.partial
mv docs/verdicts.md.partial docs/verdicts.md
