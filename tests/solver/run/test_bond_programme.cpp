// mpfem bond: one bonded contact point driven through a programme, through files as a user does.

#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "solver/run/bond_programme.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

constexpr double stiffness = 3.68e6, tensile = 25, shear_strength = 18, fracture_energy = 0.001; // MPa/mm, MPa, N/mm

const std::string law_text = fmt::format("stiffness = {}\n[bond]\ntensile_strength = {}.0\nshear_strength = {}.0\n"
                                         "fracture_energy = {}\n",
                                         stiffness, tensile, shear_strength, fracture_energy);

/// Columns of a result by their names; states apart.
struct Result {
  std::map<std::string, std::vector<double>> column;
  std::vector<std::string> state;
  const std::vector<double>& operator[](const std::string& name) const { return column.at(name); }
  std::size_t rows() const { return state.size(); }
};

Result read_result(const std::string& path) {
  std::istringstream text(read_text(path));
  std::string line, cell;
  std::getline(text, line);
  std::vector<std::string> names;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  REQUIRE(names.back() == "state");
  Result result;
  while (std::getline(text, line)) {
    std::istringstream cells(line);
    for (const std::string& name : names) {
      if (!std::getline(cells, cell, ',')) throw std::runtime_error("short row: " + line);
      if (name == "state")
        result.state.push_back(cell);
      else
        result.column[name].push_back(std::stod(cell));
    }
  }
  return result;
}

/// Runs `mpfem bond` on the law above and a programme.
Outcome bond(const Folder& folder, const std::string& programme, const std::string& arguments = "",
             const std::string& law = law_text) {
  write_text(folder / "law.toml", law);
  write_text(folder / "programme.csv", programme);
  return run_command(fmt::format("'{}' bond '{}' '{}' -o '{}' {}", MPFEM_EXECUTABLE, folder / "law.toml",
                                 folder / "programme.csv", folder / "result.csv", arguments));
}

Result walk(const std::string& programme, const std::string& arguments = "") {
  const Folder folder;
  const Outcome outcome = bond(folder, programme, arguments);
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "result.csv.partial"));
  return read_result(folder / "result.csv");
}

} // namespace

TEST_CASE("breaking the point takes the fracture energy at 20, 200 and 2000 increments, in three modes, by both laws") {
  for (const std::string softening : {"exponential", "energy"})
    for (const double opening : {1.0, 0.0, std::sqrt(0.5)}) {
      const double sliding = std::sqrt(1 - opening * opening);
      const double strength = 1 / std::hypot(opening / tensile, sliding / shear_strength);
      const double first = strength / stiffness, b = fracture_energy - 0.5 * strength * first;
      // To where e^-16.5 of the energy is left to spend: past the e^-16 at which the bond counts as broken.
      const double last =
          softening == "energy" ? std::sqrt(first * first + 33 * b / stiffness) : first + 16.5 * b / strength;
      double coarser = 1;
      for (const int increments : {20, 200, 2000}) {
        INFO(softening << ", opening share " << opening << ", " << increments << " increments");
        const Result result =
            walk(fmt::format("opening,shear1,shear2,increments\n{0:.17g},{1:.17g},0,{2}\n{3:.17g},{4:.17g},0,\n",
                             opening * first, sliding * first, increments / 10, opening * last, sliding * last),
                 fmt::format("--increments {} --set bond.softening={}", increments - increments / 10, softening));
        REQUIRE(result.rows() == static_cast<std::size_t>(increments) + 1);
        CHECK(result.state.back() == "broken");
        CHECK(result["damage"].back() == 1);
        CHECK(result["work_N_per_mm"].back() == Approx(fracture_energy).epsilon(1e-6));
        CHECK(result["dissipated_N_per_mm"].back() == Approx(fracture_energy).epsilon(1e-6));
        // The polygon under the rows meets it to the second order of the increment: 7e-2, 7e-4, 7e-6 for steps of 0.92,
        // 0.092, 0.0092 of the exponential's decay length.
        const double off = std::abs(result["trapezoidal_work_N_per_mm"].back() / fracture_energy - 1);
        CHECK(off < 0.1 * std::pow(20.0 / increments, 2));
        CHECK(off < coarser);
        coarser = off;
        if (softening == "exponential") {
          double peak = 0;
          for (std::size_t i = 0; i < result.rows(); ++i)
            peak = std::max(peak, std::hypot(result["normal_traction_MPa"][i], result["shear1_traction_MPa"][i]));
          CHECK(peak == Approx(strength).epsilon(1e-12)); // the second way point but one is the strength
        }
      }
    }
}

TEST_CASE("along the whole path the energy account is the area under the tractions, also unloaded and compressed") {
  for (const std::string softening : {"exponential", "energy"}) {
    const Result result =
        walk("opening,shear1,shear2\n-5e-6,0,0\n2e-5,0,0\n0,0,0\n-4e-6,1e-5,0\n3e-5,3e-5,-1e-5\n0,0,0\n",
             "--increments 20000 --set bond.softening=" + softening);
    double largest = 0;
    for (std::size_t i = 0; i < result.rows(); ++i)
      largest = std::max(largest, std::abs(result["work_N_per_mm"][i] - result["trapezoidal_work_N_per_mm"][i]));
    // One increment crosses the kink at the strength: at most its width times the traction it may miss,
    // (2.5e-5/20000 mm)^2 K / 2 = 3e-12 N/mm, is lost there; the rest is of second order.
    CHECK(largest < 1e-8 * fracture_energy);
    CHECK(result["dissipated_N_per_mm"].back() > 0.1 * fracture_energy);
    CHECK(result["stored_N_per_mm"].back() == 0);
  }
}

TEST_CASE("compression is carried by the undamaged penalty, negative, and leaves damage unchanged") {
  const Result result = walk("opening,shear1,shear2\n-5e-6,0,0\n2e-5,0,0\n-5e-6,0,0\n2e-5,0,0\n", "--increments 100");
  const double damage = result["damage"][200];
  CHECK(damage > 0.5);
  int closed_and_damaged = 0;
  for (std::size_t i = 0; i < result.rows(); ++i) {
    if (i >= 200) CHECK(result["damage"][i] == damage);
    const double opening = result["opening_mm"][i];
    if (opening >= 0) continue;
    CHECK(result["normal_traction_MPa"][i] == Approx(stiffness * opening).epsilon(1e-14));
    CHECK(result["stored_N_per_mm"][i] == Approx(0.5 * stiffness * opening * opening).epsilon(1e-14));
    CHECK(result.state[i] == (i < 200 ? "intact" : "damaged"));
    if (i > 200) ++closed_and_damaged;
  }
  CHECK(closed_and_damaged > 30);
}

TEST_CASE("unloading goes towards the origin, and reloading returns to where it left the curve") {
  for (const std::string softening : {"exponential", "energy"})
    for (const auto& [there, column, traction] :
         {std::array<std::string, 3>{"2e-5,0,0", "opening_mm", "normal_traction_MPa"},
          std::array<std::string, 3>{"0,2e-5,0", "shear1_mm", "shear1_traction_MPa"},
          std::array<std::string, 3>{"0,0,-2e-5", "shear2_mm", "shear2_traction_MPa"}}) {
      const Result result = walk(fmt::format("opening,shear1,shear2\n{0}\n0,0,0\n{0}\n", there),
                                 "--increments 50 --set bond.softening=" + softening);
      const double slope = result[traction][50] / result[column][50];
      CHECK(slope < 0.6 * stiffness);
      CHECK(slope > 0);
      for (std::size_t i = 50; i <= 150; ++i)
        CHECK(result[traction][i] == Approx(slope * result[column][i]).epsilon(1e-12).margin(1e-12));
      CHECK(result[traction][150] == result[traction][50]);
    }
}

TEST_CASE("a broken point that has opened bonds again on contact only if the law says so") {
  const std::string programme = "opening,shear1,shear2\n1e-3,1e-6,0\n-1e-6,1e-6,0\n-1e-6,3e-6,0\n1e-3,3e-6,0\n";
  const Result never = walk(programme);
  CHECK(never.state.back() == "broken");
  CHECK(never["shear1_traction_MPa"][600] == 0);
  CHECK(never["dissipated_N_per_mm"].back() == Approx(fracture_energy).epsilon(1e-12));

  const Result anew = walk(programme, "--set bond.rebond=on_contact");
  CHECK(anew.state[200] == "broken");
  CHECK(anew.state[400] == "intact");
  CHECK(anew["damage"][400] == 0);
  CHECK(anew["dissipated_N_per_mm"][400] == Approx(fracture_energy).epsilon(1e-12));
  // The new bond counts its shear from where it was made.
  CHECK(anew["shear1_traction_MPa"][600] == Approx(stiffness * 2e-6).epsilon(1e-9));
  CHECK(anew["dissipated_N_per_mm"].back() == Approx(2 * fracture_energy).epsilon(1e-12));
}

TEST_CASE("a normal-only bond carries no shear") {
  const Result result = walk("opening,shear1,shear2\n0,1e-4,0\n5e-6,1e-4,0\n", "--set bond.normal_only=true");
  CHECK(result["shear1_traction_MPa"].back() == 0);
  CHECK(result["damage"].back() == 0);
  CHECK(within(result["normal_traction_MPa"].back(), stiffness * 5e-6, accumulated_rounding));
}

TEST_CASE("what cannot be driven is refused in one line with its place, exit code 2, and nothing is written") {
  const std::string good = "opening,shear1,shear2\n1e-5,0,0\n";
  struct Case {
    std::string programme, arguments, law, found;
  };
  for (const Case& c : {
           Case{"", "", law_text, "programme.csv:1: found no heading"},
           Case{"opening,shear1,shear2\n", "", law_text, "programme.csv: found no row below the heading"},
           Case{"opening,slide,shear2\n1,0,0\n", "", law_text,
                "programme.csv:1: column shear1: found the heading 'slide'"},
           Case{"opening,shear1\n1,0\n", "", law_text, "programme.csv:1: found a heading of 2 columns"},
           Case{"opening,shear1,shear2\n# where\n1e-5,0,x\n", "", law_text,
                "programme.csv:3: column shear2: found 'x'"},
           Case{"opening,shear1,shear2\n1e-5,nan,0\n", "", law_text, "programme.csv:2: column shear1: found 'nan'"},
           Case{"opening,shear1,shear2\n1e9,0,0\n", "", law_text, "programme.csv:2: column opening: found '1e9'"},
           Case{"opening,shear1,shear2\n1e-5,0\n", "", law_text, "programme.csv:2: found 2 columns, allowed: 3"},
           Case{"opening,shear1,shear2,increments\n1e-5,0,0,0\n", "", law_text,
                "programme.csv:2: column increments: found '0'"},
           Case{"opening,shear1,shear2,increments\n1e-5,0,0,2.5\n", "", law_text, "column increments: found '2.5'"},
           Case{"opening,shear1,shear2,increments\n1,0,0,9000000\n0,0,0,9000000\n", "", law_text,
                "programme.csv:3: column increments"},
           Case{good, "", "stiffness = 1e6\n", "bond"},
           Case{good, "--set stiffness=0", law_text, "key 'stiffness'"},
           Case{good, "--set bond.softening=linear", law_text, "key 'bond.softening'"},
           Case{good, "--set bond.strength=1", law_text, "unknown key 'bond.strength'"},
           Case{good, "--set bond.fracture_energy=8.5e-5", law_text, "key 'bond.fracture_energy': found 8.5e-05"},
       }) {
    const Folder folder;
    write_text(folder / "result.csv", "earlier\n");
    const Outcome outcome = bond(folder, c.programme, c.arguments, c.law);
    INFO(outcome.messages);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.one_error_line("mpfem"));
    CHECK_THAT(outcome.messages, Catch::Contains(c.found));
    CHECK(read_text(folder / "result.csv") == "earlier\n");
    CHECK_FALSE(std::filesystem::exists(folder / "result.csv.partial"));
  }
}

TEST_CASE("the programme and the law are not overwritten, and a result goes to a file or a stream") {
  const Folder folder;
  const std::string programme = "opening,shear1,shear2\n1e-5,0,0\n";
  REQUIRE(bond(folder, programme, "--quiet").exit_code == 0);
  const auto to = [&](const std::string& output) {
    return run_command(fmt::format("'{}' bond '{}' '{}' -o '{}'", MPFEM_EXECUTABLE, folder / "law.toml",
                                   folder / "programme.csv", output));
  };
  for (const std::string name : {"law.toml", "programme.csv"}) {
    const std::string before = read_text(folder / name);
    const Outcome refused = to(folder / name);
    CHECK(refused.exit_code == 2);
    CHECK_THAT(refused.messages,
               Catch::Contains("would overwrite the input") || Catch::Contains("would replace a TOML file"));
    CHECK(read_text(folder / name) == before);
  }
  CHECK(to(folder / "no-such-folder/result.csv").exit_code == 2);
  CHECK(to(".").exit_code == 2);
  CHECK(to("/dev/full").exit_code == 4);
  const Outcome shown = to("/dev/stdout");
  CHECK(shown.exit_code == 0);
  CHECK_THAT(shown.output, Catch::StartsWith("way_point,opening_mm"));
}
