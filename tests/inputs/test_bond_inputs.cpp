// Malformed bond laws and programmes, given to mpfem bond.

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "folder.hpp"
#include "limited_program.hpp"
#include "malformed_toml.hpp"

using namespace mpfem::test;

namespace {

const char* const good_law = R"(stiffness = 3.68e6
[bond]
tensile_strength = 25.0
shear_strength = 18.0
fracture_energy = 0.5
softening = 'energy'
rebond = 'never'
normal_only = false
)";

const char* const good_programme = "opening,shear1,shear2,increments\n2e-5,0,0,10\n";

class Bonds {
public:
  void refused(const std::string& law, const std::string& programme, const std::vector<std::string>& names) {
    write_text(folder_ / "law.toml", law);
    write_text(folder_ / "programme.csv", programme);
    write_text(folder_ / "result.csv", "what was there before");
    CHECK(fault_of_refusal(MPFEM_EXECUTABLE,
                           {"bond", folder_ / "law.toml", folder_ / "programme.csv", "-o", folder_ / "result.csv"},
                           names) == "");
    CHECK(read_text(folder_ / "result.csv") == "what was there before");
  }

private:
  Folder folder_;
};

} // namespace

TEST_CASE("A bond law with one spoilt value is refused with file, key and line") {
  Bonds bonds;
  for (MalformedText& document : spoilt_documents(good_law)) {
    INFO(document.what);
    document.names.push_back("law.toml");
    bonds.refused(document.text, good_programme, document.names);
  }
  bonds.refused("stiffness = 1e6\n[bond]\ntensile_strength = 1e6\nshear_strength = 1\nfracture_energy = 1e-9\n",
                good_programme, {"law.toml:5", "fracture_energy"});
}

TEST_CASE("A programme that is not a table of separations is refused with file and line") {
  Bonds bonds;
  const std::string heading = "opening,shear1,shear2,increments\n";
  const std::string endless(100'000, 'x');
  for (const auto& [programme, line] : std::vector<std::pair<std::string, std::string>>{
           {"", ":1"},
           {"# nothing\n", ":1"},
           {"opening\n", ":1"},
           {"opening,shear1,shear2,increments,more\n", ":1"},
           {"shear1,opening,shear2\n", ":1"},
           {endless, ":1"},
           {endless + "," + endless + "," + endless, ":1"},
           {std::string(100'000, ','), ":1"},
           {std::string(1000, '\0'), ":1"},
           {heading, "found no row below the heading"},
           {heading + "1e-5,0,0\n", ":2"},
           {heading + "1e-5,0,0,1,1\n", ":2"},
           {heading + ",0,0,1\n", ":2"},
           {heading + "nan,0,0,1\n", ":2"},
           {heading + "0,inf,0,1\n", ":2"},
           {heading + "0,0,-inf,1\n", ":2"},
           {heading + "1e7,0,0,1\n", ":2"},
           {heading + "1e400,0,0,1\n", ":2"},
           {heading + "0x1,0,0,1\n", ":2"},
           {heading + "1;0,0,0,1\n", ":2"},
           {heading + "0,0,0,0\n", ":2"},
           {heading + "0,0,0,-1\n", ":2"},
           {heading + "0,0,0,1.5\n", ":2"},
           {heading + "0,0,0,1e3\n", ":2"},
           {heading + "0,0,0,10000001\n", ":2"},
           {heading + "0,0,0,99999999999999999999\n", ":2"},
           {heading + "0,0,0,9999999\n0,0,0,9999999\n", ":3"},
           {heading + endless + ",0,0,1\n", ":2"},
           {heading + "\xff,0,0,1\n", ":2"},
           {heading + "\x1b[2J,0,0,1\n", ":2"},
           {heading + std::string(1000, '\n') + "x,0,0,1\n", ":1002"},
       }) {
    INFO(programme.substr(0, 60));
    bonds.refused(good_law, programme, {"programme.csv", line});
  }
}
