// The spheres of this folder as discrete elements, with the contact model MDR of Zunker and Kamrin (LAMMPS): forces as
// CSV. Not part of any build or test: discrete-elements.csv and discrete-elements-tableting.csv hold the results.
//
//   npm install lammps.js@1.5.1                # LAMMPS of 10 Sep 2025 for node; 20 s a run
//   node discrete-elements.mjs twelve 0.5      # or fourteen; friction between spheres and at walls
//   node discrete-elements.mjs tablet 0.7 0.1 0 0
//                                              # friction of grains, of tools; surface energy, J/m^2; rolling friction
//
// Parameters are those of the examples in.triaxial.compaction.12 and in.tableting.200 of LAMMPS. There the cylinder of
// the die has a floor at z = 0, which bears half of what the lower punch should. Here the cylinder goes on below it.
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import createModule from "lammps.js/wasm-atomify";

const here = dirname(fileURLToPath(import.meta.url));
const [scene, ...numbers] = process.argv.slice(2);

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

/// Six planes close in on the spheres; lengths of the file are taken as m, forces returned in N for mm.
function triaxial(file, friction) {
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
${created(spheres(file), 1, 1560)}
fix motion all nve/sphere
pair_style granular
pair_coeff * * ${law}
variable forth equal 1e-5*step
variable back equal -1e-5*step
${walls.join("\n")}
variable force equal (c_x0-c_x3+c_y0-c_y3+c_z0-c_z3)/6*1e-6
variable approach equal 2*v_forth
thermo 10000
thermo_style custom step ke c_x0 c_x3
fix row all print 100 "row \${approach},\${force}" screen yes
run 49900
`;
}

/// Two hundred spheres settle in a die about x = y = 0; the upper punch goes from 10 to 3 mm and back.
function tablet(friction, wallFriction, surfaceEnergy, rolling) {
  const k = 2.25 * rolling * rolling * 5e6 * 0.55e-3;
  const law = (energy, mu) =>
    `mdr 5e6 0.4 1.9e5 ${energy} 0.5 0.2 damping mdr 1 tangential linear_history ${(2 / 7) * 5e6 * 0.55e-3} 1 ${mu}` +
    (rolling > 0 ? ` rolling sds ${k} 0 ${rolling}` : "");
  const wall = `granular ${law(0, wallFriction)}`;
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
${created(spheres("two-hundred-spheres.csv"), 1000, 1560)}
pair_style granular
pair_coeff * * ${law(surfaceEnergy, friction)}
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
fix row all print 20 "row \${distance},\${up},\${low}" screen yes
run 14000
`;
}

const scenes = {
  twelve: [triaxial, "approach,mean_wall_force", "twelve-spheres.csv", "mm, N"],
  fourteen: [triaxial, "approach,mean_wall_force", "fourteen-spheres.csv", "mm, N"],
  tablet: [tablet, "punch_distance,upper_punch_force,lower_punch_force", undefined, "mm, N, N"],
};
const [input, columns, file, units] = scenes[scene];
const wasm = await createModule({
  print: (line) => (line.startsWith("row ") ? console.log(line.slice(4)) : console.error(line)),
  printErr: (line) => console.error(line),
});
console.log(`# discrete elements, MDR contact model, ${scene} ${numbers.join(" ")}; ${units}\n${columns}`);
const lammps = new wasm.LAMMPSWeb();
lammps.startWithArgs([]);
lammps.runScript(input(...(file ? [file] : []), ...numbers.map(Number)));
process.exit(0);
