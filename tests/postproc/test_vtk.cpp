// VTK files, read back as the format's definition says.

#include <cstring>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "postproc/drawing/vtk.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// Values of a named array of a .vtu file with raw appended data.
template <class T>
std::vector<T> array_of(const std::string& vtu, const std::string& name) {
  const std::size_t element = vtu.find("Name=\"" + name + "\"");
  REQUIRE(element != std::string::npos);
  const std::size_t at = vtu.find("offset=\"", element) + 8;
  const std::size_t offset = std::stoul(vtu.substr(at));
  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t data = vtu.find(mark) + mark.size() + offset;
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, vtu.data() + data, sizeof bytes);
  REQUIRE(data + sizeof bytes + bytes < vtu.size());
  std::vector<T> values(bytes / sizeof(T));
  std::memcpy(values.data(), vtu.data() + data + sizeof bytes, bytes);
  return values;
}

} // namespace

TEST_CASE("a .vtu file gives back the mesh's volume, its fields and its grains") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  REQUIRE(run_command(fmt::format("'{}' vtk {} -o {} --quiet", MPFEM_POSTPROC, folder / "run.h5", folder / "vtk"))
              .exit_code == 0);
  const std::string vtu = read_text(folder / "vtk/0000.vtu");
  const auto x = array_of<float>(vtu, "position [mm]");
  const auto tet = array_of<std::int32_t>(vtu, "connectivity");
  const auto ends = array_of<std::int64_t>(vtu, "offsets");
  const auto types = array_of<std::uint8_t>(vtu, "types");
  REQUIRE(tet.size() == 4 * 48);
  REQUIRE(ends.size() == 48);
  CHECK(ends.back() == 192);
  CHECK(std::count(types.begin(), types.end(), 10) == 48);
  // The elements before the binary part: every one that opens closes, in order; offsets rise without gaps.
  const std::string head = vtu.substr(0, vtu.find("<AppendedData"));
  std::vector<std::string> open;
  for (std::size_t at = head.find('<'); at != std::string::npos; at = head.find('<', at + 1)) {
    if (head[at + 1] == '?' || head[at + 1] == '!') continue;
    const std::size_t end = head.find('>', at);
    if (head[at + 1] == '/') {
      REQUIRE_FALSE(open.empty());
      CHECK(head.substr(at + 2, end - at - 2) == open.back());
      open.pop_back();
    } else if (head[end - 1] != '/') {
      open.push_back(head.substr(at + 1, head.find_first_of(" >", at) - at - 1));
    }
  }
  CHECK(open == std::vector<std::string>{"VTKFile"});
  CHECK(vtu.ends_with("\n  </AppendedData>\n</VTKFile>\n"));
  const std::size_t data = vtu.find("\n_") + 2;
  std::size_t expected_offset = 0;
  for (std::size_t at = head.find("offset=\""); at != std::string::npos; at = head.find("offset=\"", at + 1)) {
    CHECK(std::stoul(head.substr(at + 8)) == expected_offset);
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, vtu.data() + data + expected_offset, sizeof bytes);
    expected_offset += sizeof bytes + bytes;
  }
  CHECK(vtu.substr(data + expected_offset) == "\n  </AppendedData>\n</VTKFile>\n");
  double volume = 0;
  for (std::size_t t = 0; t < 48; ++t) {
    double e[3][3];
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k)
        e[c][k] = static_cast<double>(x[3 * static_cast<std::size_t>(tet[4 * t + c + 1]) + k] -
                                      x[3 * static_cast<std::size_t>(tet[4 * t]) + k]);
    volume += (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
               e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
              6;
  }
  CHECK(within(volume, 8, rounding));
  const auto stress = array_of<float>(vtu, "von_mises [MPa]");
  REQUIRE(stress.size() == 48);
  CHECK(stress[7] == 7.0F);
  const auto grain = array_of<std::int32_t>(vtu, "grain");
  CHECK(grain[23] == 0);
  CHECK(grain[24] == 1);
  CHECK(array_of<float>(vtu, "velocity [mm/s]").size() == x.size());
  const std::string pvd = read_text(folder / "vtk/run.pvd");
  CHECK_THAT(pvd, Catch::Contains("file=\"0000.vtu\"") && Catch::Contains("timestep=\"2e-06\""));
}
