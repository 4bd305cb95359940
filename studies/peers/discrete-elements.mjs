// The spheres of this folder as discrete elements, with the contact model MDR of Zunker and Kamrin (LAMMPS). Writes
// discrete-elements.csv and discrete-elements-tableting.csv, which the studies of this folder draw. Not part of any
// build or test.
//
//   npm install lammps.js@1.5.1        # LAMMPS of 10 Sep 2025 for node
//   node discrete-elements.mjs         # five minutes
//
// Parameters are those of the examples in.triaxial.compaction.12 and in.tableting.200 of LAMMPS. There the cylinder of
// the die has a floor at z = 0, which bears half of what the lower punch should. Here the cylinder goes on below it.
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import createModule from "lammps.js/wasm-atomify";

const here = dirname(fileURLToPath(import.meta.url));

/// x, y, z, radius of each sphere, mm.
function spheres(file) {
  const lines = readFileSync(join(here, file), "utf8").split("\n");
  return lines.filter((line) => /^[-0-9]/.test(line)).map((line) => line.split(",").map(Number));
}

/// Commands that create spheres; `metre`: how many of the file's units of length make one of LAMMPS (m).
function created(list, metre, density) {
  return list
    .map(([x, y, z, radius], i) => {
      const id = `atom ${i + 1}`;
      return `create_atoms 1 single ${x / metre} ${y / metre} ${z / metre}
set ${id} diameter ${(2 * radius) / metre}
set ${id} density ${density}`;
    })
    .join("\n");
}

const volumeOf = (list) => list.reduce((sum, [, , , radius]) => sum + (4 / 3) * Math.PI * radius ** 3, 0);

/// Six planes close in on the spheres: 10 m/s times `speed`, 1.2 % of the wave speed of a rod. Lengths of the file are
/// taken as m. Rows: approach, mm; mean force of a wall, N, both as if the file's lengths were mm.
function triaxial(list, friction, speed) {
  const law = `mdr 1e9 0.3 50e6 0 0.5 0.2 damping mdr 1 tangential linear_history ${(2 / 7) * 1e9 * 0.5} 0 ${friction}`;
  const walls = [..."xyz"].flatMap((axis, i) =>
    [0, 3].map((place) => {
      const at = [0, 0, 0];
      const normal = [0, 0, 0];
      const move = ["NULL", "NULL", "NULL"];
      at[i] = place;
      normal[i] = place ? -1 : 1;
      move[i] = place ? "v_back" : "v_forth";
      const name = axis + place;
      return `region ${name} plane ${at.join(" ")} ${normal.join(" ")} side in move ${move.join(" ")} units box
fix ${name} all wall/gran/region granular ${law} region ${name} contacts
compute ${name} all reduce sum f_${name}[${i + 2}]`;
    }),
  );
  return `units si
atom_style sphere 1
atom_modify map array
comm_modify vel yes
newton off
neighbor 2 bin
neigh_modify delay 0
timestep 1e-6
boundary f f f
region cell block -9 12 -9 12 -9 12
create_box 1 cell
${created(list, 1, 1560)}
fix motion all nve/sphere
pair_style granular
pair_coeff * * ${law}
variable forth equal ${1e-5 * speed}*step
variable back equal ${-1e-5 * speed}*step
${walls.join("\n")}
variable force equal (c_x0-c_x3+c_y0-c_y3+c_z0-c_z3)/6*1e-6
variable approach equal 2*v_forth
thermo 10000
thermo_style custom step ke c_x0 c_x3
fix row all print ${499 / speed} "row \${approach},\${force}" screen yes
run ${49900 / speed}
`;
}

/// Two hundred spheres settle in a die about x = y = 0; the upper punch goes from 10 to 3 mm and back. `energy` in
/// J/m^2, `psi`: share of free surface below which a grain responds as a bulk. Rows: distance of the punches, mm; force
/// of the upper and of the lower punch, N.
function tablet(list, energy, rolling, psi) {
  const k = 2.25 * rolling * rolling * 5e6 * 0.55e-3;
  const law = (gamma, mu) =>
    `mdr 5e6 0.4 1.9e5 ${gamma} ${psi} 0.2 damping mdr 1 tangential linear_history ${(2 / 7) * 5e6 * 0.55e-3} 1 ${mu}` +
    (rolling > 0 ? ` rolling sds ${k} 0 ${rolling}` : "");
  const wall = `granular ${law(0, 0.1)}`;
  return `units si
atom_style sphere 1
atom_modify map array
comm_modify vel yes
newton off
neighbor 1e-3 bin
neigh_modify every 10 delay 60 check no
timestep 4e-6
boundary f f f
region cell block -0.005 0.005 -0.005 0.005 -0.011 0.031
create_box 1 cell
${created(list, 1000, 1560)}
pair_style granular
pair_coeff * * ${law(energy, 0.7)}
variable upper equal 0.0
region lower plane 0 0 0 0 0 1 side in units box
region upper plane 0 0 0.01 0 0 -1 side in move NULL NULL v_upper units box
region die cylinder z 0 0 0.004 -0.01 0.03 side in units box
fix lower all wall/gran/region ${wall} region lower contacts
fix upper all wall/gran/region ${wall} region upper contacts
fix die all wall/gran/region ${wall} region die contacts
compute lower all reduce sum f_lower[4]
compute upper all reduce sum f_upper[4]
fix motion all nve/sphere
fix weight all gravity 9.81 vector 0 0 -1
thermo 1000
thermo_style custom step ke v_upper c_upper c_lower
run 5000
reset_timestep 0
variable upper equal -0.007*sin(PI/2*step/7000)
variable distance equal 10+1000*v_upper
variable up equal -c_upper
variable low equal c_lower
fix row all print 80 "row \${distance},\${up},\${low}" screen yes
run 14000
`;
}

/// The rows of one run.
async function rowsOf(input) {
  const rows = [];
  const print = (line) => line.startsWith("row ") && rows.push(line.slice(4).split(",").map(Number));
  const wasm = await createModule({ print, printErr: console.error });
  const lammps = new wasm.LAMMPSWeb();
  lammps.startWithArgs([]);
  lammps.runScript(input);
  return rows;
}

const text = (cells) => cells.map((cell) => (typeof cell === "number" ? Number(cell.toPrecision(6)) : cell)).join(",");
const source = "(discrete-elements.mjs): contact model MDR of LAMMPS, 10 Sep 2025";

let lines = [
  `# The same spheres as discrete elements ${source}, with`,
  "# psi_b = 0.5. speed: of the walls, over 1.2 % of the wave speed of a rod.",
  "spheres,friction [1],speed [1],approach [mm],relative_density [1],mean_wall_force [N],mean_stress [MPa]",
];
for (const [name, friction, speed] of [
  ["twelve", 0, 1],
  ["twelve", 0.5, 1],
  ["fourteen", 0, 1],
  ["fourteen", 0.5, 1],
  ["twelve", 0, 0.2],
  ["twelve", 0.5, 0.2],
]) {
  const list = spheres(`${name}-spheres.csv`);
  for (const [approach, force] of await rowsOf(triaxial(list, friction, speed))) {
    const side = 3 - approach;
    const density = volumeOf(list) / side ** 3;
    if (density < 0.85) lines.push(text([name, friction, speed, approach, density, force, force / side ** 2]));
  }
}
writeFileSync(join(here, "discrete-elements.csv"), lines.join("\n") + "\n");

lines = [
  "# Two hundred spheres in a round die as discrete elements",
  `# ${source}.`,
  "# Pressing and unloading. Case bare: no surface energy, no rolling friction, as in tableting.toml; example: 2 J/m^2",
  "# and 0.6, as in the example of LAMMPS; late: as bare with psi_b = 0.1 instead of 0.5; adhesive: as late with 2 J/m^2;",
  "# rolling: as adhesive with rolling friction, the example with psi_b = 0.1.",
  "case,punch_distance [mm],relative_density [1],upper_punch_force [N],lower_punch_force [N]",
];
const powder = spheres("two-hundred-spheres.csv");
for (const [name, ...numbers] of [
  ["bare", 0, 0, 0.5],
  ["example", 2, 0.6, 0.5],
  ["late", 0, 0, 0.1],
  ["adhesive", 2, 0, 0.1],
  ["rolling", 2, 0.6, 0.1],
])
  for (const [distance, upper, lower] of await rowsOf(tablet(powder, ...numbers)))
    if (distance < 6) lines.push(text([name, distance, volumeOf(powder) / (16 * Math.PI * distance), upper, lower]));
writeFileSync(join(here, "discrete-elements-tableting.csv"), lines.join("\n") + "\n");
process.exit(0);
