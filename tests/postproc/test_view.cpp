// The page of postproc view, without a browser: what it holds.

#include <zlib.h>

#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bonded_run.hpp"
#include "postproc/drawing/cut_solid.hpp"
#include "postproc/files/base64.hpp"
#include "postproc/view/view_data.hpp"
#include "postproc/view/view_page.hpp"
#include "small_run.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/tolerances.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

/// What stands between two marks of the page.
std::string between(const std::string& page, const std::string& before, const std::string& after) {
  const std::size_t at = page.find(before);
  REQUIRE(at != std::string::npos);
  const std::size_t begin = at + before.size();
  return page.substr(begin, page.find(after, begin) - begin);
}

std::string decoded(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned int group = 0, bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = group << 6U | static_cast<unsigned int>(letters.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(group >> bits & 255U);
  }
  return bytes;
}

} // namespace

TEST_CASE("base64 is that of RFC 4648, section 10") {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) CHECK(base64(bytes) == text);
}

TEST_CASE("a view keeps places to a half of a 65535th of their range and fields to a half of a 255th") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const Snapshot snapshot = read_snapshot({folder / "run.h5", schema::FileKind::run}, 0);
  const ViewData data = view_data({snapshot});
  REQUIRE(data.states.size() == 1);
  CHECK(data.facet.size() == 3 * (6 * 8 + 2 * 8)); // the cube's six faces, and both sides between its two grains
  CHECK(data.tet.size() == 4 * 48);
  for (std::size_t i = 0; i < snapshot.node.size(); ++i) {
    const double width = data.high[i % 3] - data.low[i % 3];
    const double x = data.low[i % 3] + width * data.states[0].position[i] / 65535.0;
    CHECK(std::abs(x - static_cast<double>(snapshot.node[i])) < 0.51 * width / 65535);
  }
  CHECK(data.fields[0].name == "von_mises");
  CHECK(*std::max_element(data.states[0].value[0].begin(), data.states[0].value[0].end()) == 255);
}

TEST_CASE("the page holds all of its data, loads nothing from a network, and shows titles as they are") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const std::string title = "a <b> & \"c\"";
  const Outcome outcome = run_command(
      fmt::format("'{}' view {} -o {} --title '{}'", MPFEM_POSTPROC, folder / "run.h5", folder / "v.html", title));
  INFO(outcome.messages);
  REQUIRE(outcome.exit_code == 0);
  const std::string page = read_text(folder / "v.html");
  CHECK(page.find("<h1>a &lt;b&gt; &amp; &quot;c&quot;</h1>") != std::string::npos);
  CHECK(page.find("http") == std::string::npos);
  CHECK(page.find("src=") == std::string::npos);
  const auto head = nlohmann::json::parse(between(page, "const head = ", ";\n"));
  const std::string packed = decoded(between(page, "const packed = '", "'"));
  const std::size_t nodes = head.at("nodes"), expected = 12 * head.at("facets").get<std::size_t>() +
                                                         16 * head.at("tets").get<std::size_t>() + 2 * nodes +
                                                         nodes * (6 + 3) + 14 * 1; // one contact
  std::string bytes(expected + 1, '\0');
  uLongf size = bytes.size();
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                     packed.size()) == Z_OK);
  CHECK(size == expected);
}

TEST_CASE("a view without -o, or of a file that is no run, is refused in one line") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  for (const std::string& arguments : {folder / "run.h5", folder / "none.h5" + " -o " + (folder / "v.html"),
                                       folder / "run.h5" + " --most 0 -o " + (folder / "v.html")}) {
    const Outcome outcome = run_command(fmt::format("'{}' view {}", MPFEM_POSTPROC, arguments));
    CHECK(outcome.exit_code == 2);
    CHECK(std::count(outcome.messages.begin(), outcome.messages.end(), '\n') == 1);
  }
}

TEST_CASE("a view has bonds and contacts as rods from centre to centre, and damage where there are bonds") {
  const Folder folder;
  write_run(folder / "run.h5", bonded_run());
  const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
  const std::vector<Snapshot> snapshots = {read_snapshot(file, 0)};
  const ViewData data = view_data(snapshots, rods_of(file, snapshots));
  // Two contacts, 10 N and 1 N, and a bond between the first two grains whose mean damage is a half.
  const ViewState& state = data.states[0];
  REQUIRE(state.rod_kind == std::vector<std::uint8_t>{3, 3, 0});
  CHECK(state.rod_width[0] > 2 * state.rod_width[1]);
  CHECK(within(data.widest_rod, std::sqrt(0.1 * 3.5 / M_PI), rounding));
  CHECK(state.rod_width[2] == 255);
  // The bond: from (0, 0, 0) to (2, 0, 0).
  for (std::size_t k = 0; k < 6; ++k) {
    const double width = data.high[k % 3] - data.low[k % 3];
    CHECK(std::abs(data.low[k % 3] + width * state.rod_end[12 + k] / 65535 - (k == 3 ? 2 : 0)) < 1e-3);
  }
  REQUIRE(data.fields.back().name == "damage");
  CHECK(data.fields.back().sparse);
  const auto& damage = state.value.back();
  const auto& values = snapshots[0].node_field("damage").values;
  for (std::size_t n = 0; n < values.size(); ++n) // 0: never bonded; else from 1 to 255
    CHECK(damage[n] == (values[n] < 0 ? 0 : std::lround(1 + 254 * static_cast<double>(values[n]))));
}

TEST_CASE("a bond is damaged above a mean damage of one half, and broken without intact area") {
  const Folder folder;
  const struct {
    double damage, area;
    RodKind kind;
  } cases[] = {{0, 4, RodKind::intact}, {0.51, 4, RodKind::damaged}, {1, 0, RodKind::broken}};
  for (const auto& c : cases) {
    RunContents contents = bonded_run();
    contents.numbers["/snapshots/*/pair_damage"][0] = c.damage;
    contents.numbers["/snapshots/*/pair_bonded_area"][0] = c.area;
    write_run(folder / "run.h5", contents);
    const schema::FileReader file(folder / "run.h5", schema::FileKind::run);
    const auto rods = bond_rods(file, read_snapshot(file, 0), {});
    REQUIRE(rods.size() == 1);
    CHECK(rods[0].kind == c.kind);
  }
}

TEST_CASE("a view's colours have the range that a picture of the same grains has without a cut") {
  const Folder folder;
  write_run(folder / "run.h5", small_run());
  const Snapshot snapshot = read_snapshot({folder / "run.h5", schema::FileKind::run}, 0);
  const ViewData data = view_data({snapshot});
  const ShownField field = shown_field(snapshot, "von_mises");
  const auto range = range_of(cut_solid(snapshot, field, {}), field);
  CHECK(data.fields[0].range.first == range.first);
  CHECK(data.fields[0].range.second == Approx(range.second).epsilon(1e-12));
}
