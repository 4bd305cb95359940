// Malformed figures, given to postproc depends and postproc verdict.

#include <catch2/catch.hpp>

#include "folder.hpp"
#include "limited_program.hpp"

using namespace mpfem::test;

TEST_CASE("A figure that cannot be made is refused in one line with file and line, before anything is written") {
  const Folder folder;
  const std::string table = "title = \"x\"\n[[cases]]\nx = 1\n[[tables]]\nname = \"t\"\ncolumns = [\"x = {x}\"]\n";
  const std::string statement = table + "[[statements]]\ntext = \"s\"\npaper = \"p\"\nours = \"o\"\n";
  for (const auto& [text, place] : std::vector<std::pair<std::string, std::string>>{
           {"", "'title'"},
           {"title = 3\n", ":1"},
           {"title = \"x\"\ntitle = \"y\"\n", ":2"},
           {"title = \"x\"\nquestoin = \"y\"\n", ":2"},
           {"title = \"x\"\ninclude = [\"nothing.toml\"]\n", "nothing.toml"},
           {"title = \"x\"\n[[runs]]\nname = \"r\"\nprogramme = \"nothing\"\n", ":4"},
           {"title = \"x\"\n[[runs]]\nname = \"r s\"\nprogramme = \"nothing\"\n", ":3"},
           {"title = \"x\"\n[[packings]]\nname = \"p\"\nsize = 1\n", ":4"},
           {"title = \"x\"\n[[tables]]\nname = \"t\"\ncolumns = []\n", ":4"},
           {"title = \"x\"\n[[tables]]\nname = \"t\"\ncolumns = [\"x\"]\n", ":4"},
           {"title = \"x\"\n[[tables]]\nname = \"t\"\ncolumns = [\"x = run/metric.key\"]\n", "'run'"},
           {table + "[[fits]]\nname = \"f\"\ntable = \"t\"\nx = \"x\"\ny = \"x\"\nmodel = \"parabola\"\n", ":12"},
           {table + "[[fits]]\nname = \"f\"\ntable = \"u\"\nx = \"x\"\ny = \"x\"\nmodel = \"linear\"\n", "'u'"},
           {table + "[[plots]]\nname = \"p\"\nx = {}\n", "'plots.0.y'"},
           {table + "[[plots]]\nname = \"p\"\nx = { low = \"a\" }\ny = {}\n", ":9"},
           {table + "[[scripts]]\nname = \"s\"\nrun = \"r\"\ncommand = \"true\"\n", "'r'"},
           {table + "[[scripts]]\nname = \"s-{y}\"\ncommand = \"true\"\n", "'{y}'"},
           {statement + "quantities.y = { table = \"t\", column = \"y\" }\n", "'y'"},
           {statement + "quantities.x = { table = \"t\", column = \"x\" }\nrequire = [{ quantity = \"x\" }]\n",
            "predicate"},
           {std::string(100'000, '['), ":1"},
           {"title = \"\xff\"\n", ":1"},
       }) {
    INFO(text.substr(0, 200));
    write_text(folder / "figure.toml", text);
    write_text(folder / "rules.mk", "what was there before");
    CHECK(fault_of_refusal(MPFEM_POSTPROC,
                           {"depends", folder / "figure.toml", "--packing", "p.h5", "-o", folder / "rules.mk"},
                           {place}) == "");
    CHECK(read_text(folder / "rules.mk") == "what was there before");
  }
}
