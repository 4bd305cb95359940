// Packing files whose content makes no sense, given to the three programs: another kind of file, missing datasets,
// other types and shapes, numbers out of range.

#include <cmath>
#include <functional>
#include <limits>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "common/errors.hpp"
#include "folder.hpp"
#include "limited_program.hpp"
#include "pack-gen/sphere_file.hpp"
#include "tests/results-schema/tamper.hpp"
#include "tests/support/packing_file.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

const char* const scenario_text = R"(packing = 'packing.h5'
[material]
density = 1.55e-9
youngs_modulus = 5000.0
poissons_ratio = 0.3
hardening.law = 'elastic'
[[stages]]
type = 'hold'
duration = 1e-6
)";

/// What pack-gen's readers say of a file, without the fifth of a second that the program takes to load.
std::string pack_gen_message(const std::string& path) {
  try {
    read_spheres(path);
    read_mesh(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(taken)";
}

class Packings {
public:
  Packings() { write_text(folder_ / "scenario.toml", scenario_text); }
  std::string path() const { return folder_ / "packing.h5"; }

  void write(const MeshedPacking& packing, const std::vector<double>& radius) const {
    write_packing(path(), packing, radius);
  }
  void refused_by_solver(const std::string& name) const {
    CHECK(fault_of_refusal(MPFEM_EXECUTABLE, {"check", folder_ / "scenario.toml", "--threads", "1"},
                           {"packing.h5", name}) == "");
  }
  void refused_by_pack_gen(const std::string& name) const {
    CHECK(fault_of_message(pack_gen_message(path()), {"packing.h5", name}) == "");
  }
  void refused_by_postproc(const std::string& name) const {
    CHECK(fault_of_refusal(MPFEM_POSTPROC, {"section", "--packing", path(), "-o", folder_ / "p.png"},
                           {"packing.h5", name}) == "");
  }

private:
  Folder folder_;
};

struct WrongContent {
  std::string what;
  std::function<void(MeshedPacking&, std::vector<double>&)> spoil;
  bool pack_gen_refuses, postproc_refuses; ///< the solver refuses all
};

} // namespace

TEST_CASE("A packing whose numbers make no sense is refused by all programs that use them") {
  const MeshedPacking good = eight_grains(3);
  const std::vector<double> radii(8, 0.1);
  const auto node_count = static_cast<std::int32_t>(good.node.size() / 3);
  const Packings packings;
  packings.write(good, radii);
  REQUIRE(pack_gen_message(packings.path()) == "(taken)");
  for (const WrongContent& wrong : std::vector<WrongContent>{
           {"a node that is no number", [](auto&p, auto&) { p.node[7] = not_a_number; }, true, true},
           {"an infinite node", [](auto&p, auto&) { p.node[7] = infinite; }, true, true},
           {"a node far away", [](auto&p, auto&) { p.node[7] = 1e300; }, false, false},
           {"a negative corner", [](auto&p, auto&) { p.tet[0] = -1; }, true, true},
           {"a corner without node", [=](auto&p, auto&) { p.tet[0] = node_count; }, true, true},
           {"the largest corner", [](auto&p, auto&) { p.tet[0] = 2147483647; }, true, true},
           {"the smallest corner", [](auto&p, auto&) { p.tet[0] = -2147483647 - 1; }, true, true},
           {"a corner of another grain", [=](auto&p, auto&) { p.tet[0] = node_count - 1; }, true, false},
           {"a corner twice", [](auto&p, auto&) { p.tet[1] = p.tet[0]; }, false, false},
           {"an inverted tetrahedron", [](auto&p, auto&) { std::swap(p.tet[0], p.tet[1]); }, false, false},
           {"node offsets that fall", [](auto&p, auto&) { p.grain_node_offset[1] = -5; }, true, false},
           {"node offsets beyond the end", [=](auto&p, auto&) { p.grain_node_offset[1] = node_count + 5; }, true,
            false},
           {"node offsets that begin late", [](auto&p, auto&) { p.grain_node_offset[0] = 1; }, true, false},
           {"a grain without nodes", [](auto&p, auto&) { p.grain_node_offset[1] = p.grain_node_offset[2]; }, true,
            false},
           {"tet offsets that fall", [](auto&p, auto&) { p.grain_tet_offset[1] = -5; }, true, true},
           {"tet offsets beyond the end", [](auto&p, auto&) { p.grain_tet_offset[1] = 2147483647; }, true, true},
           {"tet offsets that end early", [](auto&p, auto&) { --p.grain_tet_offset.back(); }, true, true},
           {"a grain without tetrahedra", [](auto&p, auto&) { p.grain_tet_offset[1] = p.grain_tet_offset[2]; }, true,
            false},
           {"a box that is no number", [](auto&p, auto&) { p.box_lengths[1] = not_a_number; }, true, true},
           {"an infinite box", [](auto&p, auto&) { p.box_lengths[1] = infinite; }, true, true},
           {"a flat box", [](auto&p, auto&) { p.box_lengths[1] = 0; }, true, true},
           {"a negative box", [](auto&p, auto&) { p.box_lengths[1] = -1; }, true, true},
           {"a box that is too small", [](auto&p, auto&) { p.box_lengths[1] = 0.1; }, false, false},
           {"a radius that is no number", [](auto&, auto&r) { r[3] = not_a_number; }, true, false},
           {"a negative radius", [](auto&, auto&r) { r[3] = -0.1; }, true, false},
           {"no radius", [](auto&, auto&r) { r[3] = 0; }, true, false},
           {"an infinite radius", [](auto&, auto&r) { r[3] = infinite; }, true, false},
       }) {
    INFO(wrong.what);
    MeshedPacking packing = good;
    std::vector<double> radius = radii;
    wrong.spoil(packing, radius);
    packings.write(packing, radius);
    packings.refused_by_solver("");
    if (wrong.pack_gen_refuses) packings.refused_by_pack_gen("");
    if (wrong.postproc_refuses) packings.refused_by_postproc("");
  }
}

TEST_CASE("A packing that lacks a dataset, or has it with another type or shape, is refused") {
  const MeshedPacking good = eight_grains(2);
  const Packings packings;
  const std::vector<std::pair<std::string, std::vector<hsize_t>>> datasets = {
      {"/box/lengths", {3}},           {"/mesh/node", {40, 3}},
      {"/mesh/tet", {40, 4}},          {"/mesh/grain_node_offset", {9}},
      {"/mesh/grain_tet_offset", {9}}, {"/spheres/center", {8, 3}},
      {"/spheres/radius", {8}}};
  for (const auto& [dataset, extents] : datasets) {
    std::vector<std::pair<std::string, std::function<void()>>> changes = {
        {"missing", [&] { remove_dataset(packings.path(), dataset); }},
        {"a scalar", [&] { replace_dataset(packings.path(), dataset, H5T_NATIVE_DOUBLE, {}); }},
        {"of texts",
         [&] { replace_dataset(packings.path(), dataset, schema::file_type(schema::ElementType::string), extents); }},
        {"of short numbers", [&] { replace_dataset(packings.path(), dataset, H5T_NATIVE_SHORT, extents); }},
        {"of floats", [&] { replace_dataset(packings.path(), dataset, H5T_NATIVE_FLOAT, extents); }},
        {"of other columns",
         [&] {
           replace_dataset(packings.path(), dataset, H5T_NATIVE_DOUBLE, {8, 5});
         }},
        {"of three dimensions",
         [&] {
           replace_dataset(packings.path(), dataset, H5T_NATIVE_DOUBLE, {2, 2, 2});
         }},
        {"empty", [&] { replace_dataset(packings.path(), dataset, H5T_NATIVE_DOUBLE, {0}); }},
        {"far too large for the memory",
         [&] { // and without a byte in the file
           replace_dataset(packings.path(), dataset, H5T_NATIVE_DOUBLE, {hsize_t{1} << 40U});
         }},
    };
    for (const auto& [what, change] : changes) {
      INFO(dataset << " " << what);
      packings.write(good, std::vector<double>(8, 0.1));
      change();
      packings.refused_by_solver("");
      packings.refused_by_pack_gen("");
      if (!dataset.starts_with("/spheres")) packings.refused_by_postproc("");
    }
  }
}

TEST_CASE("Files that are no packing are refused as one") {
  const Packings packings;
  for (const std::string& text : {std::string(), std::string("x,y,z,radius\n"), std::string("\x89HDF\r\n\x1a\n"),
                                  std::string(100'000, '\0'), std::string(scenario_text)}) {
    INFO(text.substr(0, 20));
    write_text(packings.path(), text);
    packings.refused_by_solver("");
    packings.refused_by_pack_gen("");
    packings.refused_by_postproc("");
  }
}
