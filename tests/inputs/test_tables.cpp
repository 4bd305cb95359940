// Malformed tables, given to postproc fit.

#include <catch2/catch.hpp>

#include "folder.hpp"
#include "limited_program.hpp"

using namespace mpfem::test;

TEST_CASE("Points that are no table are refused with file and line or column") {
  const Folder folder;
  const std::string endless(100'000, 'x');
  for (const auto& [text, name] : std::vector<std::pair<std::string, std::string>>{
           {"", "empty"},
           {"# nothing\n", "empty"},
           {"a,b\n", "points"},
           {"a,b\n1,2\n", "points"},
           {"a\n1\n", "'b'"},
           {"b,c\n1,2\n", "'a'"},
           {"a,b\n1\n", ":2"},
           {"a,b\n1,2,3\n", ":2"},
           {"a,b\n1,nan\n", ":2"},
           {"a,b\n1,inf\n", ":2"},
           {"a,b\n1,1e400\n", ":2"},
           {"a,b\n1,\n", "1 of 1"},
           {"a,b\n,two\n", ":2"},
           {"a,b\n1,0x10\n", ":2"},
           {"a,b\n1,2 3\n", ":2"},
           {"a,b\n1;2\n", ":2"},
           {"a,b\n1,2\n\n# three\n1,two\n", ":5"},
           {"a,b\n1," + endless + "\n", ":2"},
           {endless + "\n1\n", "'a'"},
           {endless + "," + endless + "\n1,y\n", "'a'"},
           {std::string(100'000, ','), ":1"},
           {std::string(1000, '\0'), "'a'"},
           {"\xff\xfe", "'a'"},
           {"a,b\n\x1b[2J,1\n", ":2"},
           {"a,b\n1e300,1e300\n-1e300,-1e300\n2e300,1e300\n3e300,1e300\n", "points.csv"},
       }) {
    INFO(text.substr(0, 60));
    write_text(folder / "points.csv", text);
    write_text(folder / "fits.json", "what was there before");
    CHECK(fault_of_refusal(
              MPFEM_POSTPROC,
              {"fit", folder / "points.csv", "--x", "a", "--y", "b", "--model", "linear", "-o", folder / "fits.json"},
              {"points.csv", name}) == "");
    CHECK(read_text(folder / "fits.json") == "what was there before");
  }
}
