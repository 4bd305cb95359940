// Two hemispheres tip to tip: exact faces, even triangles at the contact, tets that are worth their time step.

#include <algorithm>
#include <cmath>
#include <limits>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "pack-gen/hemispheres.hpp"
#include "pack-gen/mesh_report.hpp"
#include "pack-gen/sphere_file.hpp"
#include "results-schema/file.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double radius = 0.1, gap = 1e-6, contact_size = 0.002, contact_radius = 0.02;

HemisphereRequest request() {
  return {.radius = radius,
          .size = 0.02,
          .contact_size = contact_size,
          .contact_radius = contact_radius,
          .bulk_size = 0.006,
          .gap = gap};
}

/// One grain with its own numbering.
TetMesh grain_of(const PackingMesh& mesh, std::size_t grain) {
  TetMesh result;
  for (auto n = static_cast<std::size_t>(mesh.grain_node_offset[grain]);
       n < static_cast<std::size_t>(mesh.grain_node_offset[grain + 1]); ++n)
    result.node.push_back({mesh.node[3 * n], mesh.node[3 * n + 1], mesh.node[3 * n + 2]});
  for (auto e = static_cast<std::size_t>(mesh.grain_tet_offset[grain]);
       e < static_cast<std::size_t>(mesh.grain_tet_offset[grain + 1]); ++e) {
    Tet tet{};
    for (std::size_t k = 0; k < 4; ++k) tet[k] = mesh.tet[4 * e + k] - mesh.grain_node_offset[grain];
    result.tet.push_back(tet);
  }
  return result;
}

double distance(const mpfem::Point& p, const mpfem::Point& q) {
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// Edge lengths of the facets whose middle is within `reach` of the axis, on the side of the tip.
std::vector<double> edges_near_tip(const TetMesh& grain, const mpfem::Point& centre, double reach) {
  std::vector<double> edges;
  for (const Facet& f : boundary_facets(grain.tet)) {
    const mpfem::Point &a = grain.node[static_cast<std::size_t>(f[0])], &b = grain.node[static_cast<std::size_t>(f[1])],
                       &c = grain.node[static_cast<std::size_t>(f[2])];
    const mpfem::Point middle{(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3};
    if (std::hypot(middle[0] - centre[0], middle[1] - centre[1]) > reach) continue;
    if (std::abs(middle[2] - centre[2]) < 0.5 * radius) continue; // the flat face
    edges.insert(edges.end(), {distance(a, b), distance(b, c), distance(c, a)});
  }
  return edges;
}

} // namespace

TEST_CASE("hemispheres: boundary nodes lie on the sphere or exactly on the flat face; closed surfaces, positive tets") {
  const Hemispheres pair = mesh_hemispheres(request());
  const double height = pair.packing.box[2];
  CHECK(height == 2 * radius + gap);
  CHECK(pair.packing.center[0][2] == 0);
  CHECK(pair.packing.center[1][2] == height);
  for (std::size_t g = 0; g < 2; ++g) {
    const TetMesh grain = grain_of(pair.mesh, g);
    const mpfem::Point& centre = pair.packing.center[g];
    const double flat = g == 0 ? 0 : height;
    CHECK(ball_defect(grain).empty());
    std::size_t on_flat = 0, on_sphere = 0, elsewhere = 0;
    double lowest = flat, highest = flat;
    for (const Facet& f : boundary_facets(grain.tet))
      for (const std::int32_t n : f) {
        const mpfem::Point& p = grain.node[static_cast<std::size_t>(n)];
        const bool round = std::abs(distance(p, centre) - radius) < 1e-14; // rounding of sums of a few 0.1 mm
        on_flat += p[2] == flat;
        on_sphere += round;
        elsewhere += !round && p[2] != flat;
      }
    for (const mpfem::Point& p : grain.node) {
      lowest = std::min(lowest, p[2]);
      highest = std::max(highest, p[2]);
    }
    CHECK(elsewhere == 0);
    CHECK(on_flat > 100);
    CHECK(on_sphere > 1000);
    CHECK(lowest >= (g == 0 ? 0 : radius));
    CHECK(highest <= (g == 0 ? radius : height));
    // Inscribed facets lose about (edge/R)^2/8 of the area's depth, 0.5 % at 0.02 mm; none where scaled to the volume.
    const double missing = 1 - mesh_volume(grain) / (2.0 / 3.0 * M_PI * radius * radius * radius);
    CHECK(missing > 0.001);
    CHECK(missing < 0.02);
  }
}

TEST_CASE("hemispheres: triangles at the contact have the requested size and good shapes at the tip") {
  const Hemispheres pair = mesh_hemispheres(request());
  for (std::size_t g = 0; g < 2; ++g) {
    const TetMesh grain = grain_of(pair.mesh, g);
    for (const double reach : {3 * contact_size, contact_radius - 1.5 * contact_size}) { // sizes grow from its rim
      const std::vector<double> edges = edges_near_tip(grain, pair.packing.center[g], reach);
      REQUIRE(edges.size() > 60);
      double mean = 0, square = 0;
      for (const double e : edges) mean += e / static_cast<double>(edges.size());
      for (const double e : edges) square += (e - mean) * (e - mean) / static_cast<double>(edges.size());
      INFO("grain " << g << ", within " << reach << ": mean " << mean << ", smallest "
                    << *std::min_element(edges.begin(), edges.end()) << ", largest "
                    << *std::max_element(edges.begin(), edges.end()));
      CHECK(mean == Approx(contact_size).epsilon(0.05));
      CHECK(std::sqrt(square) < 0.1 * mean);
      CHECK(*std::min_element(edges.begin(), edges.end()) > 0.6 * contact_size);
      CHECK(*std::max_element(edges.begin(), edges.end()) < 1.5 * contact_size);
    }
  }
}

TEST_CASE("hemispheres: the time step is that of a good tet of the contact size") {
  // Measured: 0.27 to 0.30 at contact sizes of 0.0005 to 0.002 mm; 0.18 where nothing improves gmsh's tets.
  const Hemispheres pair = mesh_hemispheres(request());
  const StepMaterial material;
  const MeshReport report = report_mesh(pair.packing, pair.mesh, 0.02, material, 1);
  CHECK(report.smallest_step * material.wave_speed() / contact_size > 0.25);
  const Refinement detail = refinement(request(), pair);
  CHECK(detail.smallest_edge > 0.4 * contact_size);
  CHECK(detail.tets_near > report.tets / 10);
  CHECK(detail.tets_near < report.tets);
}

TEST_CASE("hemispheres: the meshes are apart by the gap and a little more, and node does not face node") {
  const Hemispheres pair = mesh_hemispheres(request());
  CHECK(pair.tip_gap >= gap * (1 - 1e-9));
  // A facet lies below its corners' sphere, on both sides.
  CHECK(pair.tip_gap < gap + contact_size * contact_size / radius);
  const TetMesh lower = grain_of(pair.mesh, 0), upper = grain_of(pair.mesh, 1);
  REQUIRE(lower.node.size() == upper.node.size());
  REQUIRE(lower.tet.size() == upper.tet.size());
  // Each node within the contact: the nearest node of the other grain, seen along z. Over random places
  // the mean of that distance is about 0.4 edges; for mirrored meshes it is 0.
  double sum = 0;
  std::size_t count = 0;
  const mpfem::Point& centre = pair.packing.center[0];
  for (const mpfem::Point& p : lower.node) {
    const double from_axis = std::hypot(p[0] - centre[0], p[1] - centre[1]);
    if (std::abs(distance(p, centre) - radius) > 1e-12 || from_axis > contact_radius || p[2] < 0.5 * radius) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const mpfem::Point& q : upper.node)
      if (std::abs(distance(q, pair.packing.center[1]) - radius) < 1e-12 && q[2] < 1.5 * radius)
        nearest = std::min(nearest, std::hypot(p[0] - q[0], p[1] - q[1]));
    sum += nearest;
    ++count;
  }
  REQUIRE(count > 100);
  CHECK(sum / static_cast<double>(count) > 0.25 * contact_size);
}

TEST_CASE("hemispheres: the same request gives the same mesh, whatever was meshed before") {
  const Hemispheres first = mesh_hemispheres(request());
  HemisphereRequest other = request();
  other.contact_size = 0.003;
  const Hemispheres between = mesh_hemispheres(other);
  const Hemispheres second = mesh_hemispheres(request());
  CHECK((first.mesh.node == second.mesh.node)); // in brackets: a failure need not print them
  CHECK((first.mesh.tet == second.mesh.tet));
  CHECK(between.mesh.tet.size() < first.mesh.tet.size());
}

TEST_CASE("pack-gen hemispheres writes a file that holds to the schema, with the halves' density and gap") {
  const Folder folder;
  const std::string options =
      "hemispheres --radius 0.1 --size 0.02 --contact-size 0.004 --contact-radius 0.02 --gap 2e-6 --box-width 0.3";
  const Outcome outcome = run_command(fmt::format("'{}' {} -o {}", MPFEM_PACK_GEN, options, folder / "pair.h5"));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.output, Catch::Contains("critical step") && Catch::Contains("smallest edge"));
  CHECK(schema::validate(folder / "pair.h5").empty());
  const schema::FileReader reader(folder / "pair.h5", schema::FileKind::packing);
  CHECK(reader.read_scalar(schema::packing::packing_smallest_gap) == Approx(2e-6).epsilon(1e-6));
  CHECK(reader.read_scalar(schema::packing::packing_relative_density) ==
        Approx(4.0 / 3.0 * M_PI * 1e-3 / (0.3 * 0.3 * 0.200002)).epsilon(1e-12));
  const SphereFile file = read_spheres(folder / "pair.h5");
  CHECK(file.packing.box[0] == 0.3);
  CHECK(file.packing.center[0] == mpfem::Point{0.15, 0.15, 0});
  CHECK(file.packing.radius == std::vector<double>{0.1, 0.1});

  const Outcome quiet = run_command(fmt::format("'{}' {} --quiet -o {}", MPFEM_PACK_GEN, options, folder / "again.h5"));
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.output.empty());
  CHECK(quiet.messages.empty());
  CHECK(run_command(fmt::format("'{}' hemispheres --help", MPFEM_PACK_GEN)).output.find("Example") !=
        std::string::npos);
}

TEST_CASE("pack-gen hemispheres refuses sizes that make no sense with one line and exit code 2, and writes nothing") {
  const Folder folder;
  for (const auto& [options, expected] : std::vector<std::pair<std::string, std::string>>{
           {"--radius 0.1 --size 0.06 --contact-size 0.001 --contact-radius 0.02", "--size"},
           {"--radius 0.1 --size 0.01 --contact-size 0.02 --contact-radius 0.05", "--contact-size"},
           {"--radius 0.1 --size 0.01 --contact-size 0.005 --contact-radius 0.002", "--contact-radius"},
           {"--radius 0.1 --size 0.01 --contact-size 0.001 --contact-radius 0.2", "--contact-radius"},
           {"--radius 0.1 --size 0.01 --contact-size 0.001 --contact-radius 0.02 --gap 0.3", "--gap"},
           {"--radius 0.1 --size 0.01 --contact-size 0.001 --contact-radius 0.02 --growth 5", "--growth"},
           {"--radius 0.1 --size 0.01 --contact-size 0.001 --contact-radius 0.02 --rotate 360", "--rotate"},
           {"--radius 0.1 --size 0.01 --contact-size 0.001 --contact-radius 0.02 --box-width 0.1", "--box-width"},
           {"--radius 0.1 --size 0.01 --contact-size 0.00001 --contact-radius 0.02", "tetrahedra"}}) {
    const Outcome outcome =
        run_command(fmt::format("'{}' hemispheres {} --quiet -o {}", MPFEM_PACK_GEN, options, folder / "pair.h5"));
    INFO(options << ": " << outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("pack-gen"));
    CHECK_THAT(outcome.messages, Catch::Contains(expected));
    CHECK_FALSE(std::filesystem::exists(folder / "pair.h5"));
  }
  for (const char* options : {"--radius -1 --size 0.01 --contact-size 0.001 --contact-radius 0.02",
                              "--radius 0.1 --size 0.01 --contact-size 0 --contact-radius 0.02", "--radius 0.1"})
    CHECK(run_command(fmt::format("'{}' hemispheres {} -o {}", MPFEM_PACK_GEN, options, folder / "p.h5")).exit_code ==
          2);
}
