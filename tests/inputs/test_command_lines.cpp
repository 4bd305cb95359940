// Every option of the three programs that is a number refuses what is none: the options are those that --help lists.

#include <regex>
#include <set>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "folder.hpp"
#include "limited_program.hpp"

using namespace mpfem::test;

namespace {

struct Command {
  std::string name;
  std::vector<std::string> required; ///< words without which it does nothing; as an input, a file that is there
};

struct Program {
  std::string path;
  std::vector<Command> commands;
};

const std::vector<Program> programs = {
    {MPFEM_PACK_GEN,
     {{"spheres", {__FILE__, "-o", "none.h5"}},
      {"settle", {__FILE__, "-o", "none.h5"}},
      {"mesh", {__FILE__, "-o", "none.h5"}},
      {"import", {__FILE__, "-o", "none.h5"}},
      {"export", {__FILE__, "-o", "none.h5"}},
      {"quality", {__FILE__}},
      {"hemispheres", {"-o", "none.h5"}}}},
    {MPFEM_EXECUTABLE,
     {{"run", {__FILE__, "-o", "none.h5"}},
      {"check", {__FILE__}},
      {"bench", {}},
      {"bond", {__FILE__, __FILE__, "-o", "n.csv"}}}},
    {MPFEM_POSTPROC,
     {{"summary", {__FILE__}},
      {"curve", {__FILE__}},
      {"contact", {__FILE__}},
      {"vtk", {__FILE__, "-o", "none"}},
      {"section", {__FILE__, "-o", "none.png"}},
      {"elastic-recovery", {__FILE__}},
      {"modulus", {__FILE__}},
      {"strength", {__FILE__}},
      {"yield", {__FILE__}},
      {"hysteresis", {__FILE__}},
      {"damage", {__FILE__}},
      {"energy", {__FILE__}},
      {"tablet", {__FILE__}},
      {"heckel", {__FILE__}},
      {"diametral", {__FILE__}},
      {"fit", {__FILE__, "--x", "a", "--y", "b", "--model", "linear"}},
      {"validate", {__FILE__}}}},
};

/// Options of a command whose value is a number, by its help.
std::vector<std::string> number_options(const std::string& program, const std::string& command) {
  const std::string help = run_command(fmt::format("'{}' {} --help", program, command)).output;
  const std::regex option("\\n  (?:-\\w,)?(--[a-z-]+) (?:FLOAT|INT|UINT)");
  std::vector<std::string> names;
  for (std::sregex_iterator it(help.begin(), help.end(), option), end; it != end; ++it) names.push_back((*it)[1]);
  return names;
}

} // namespace

TEST_CASE("Every option that is a number refuses what is no finite number within its range") {
  int options = 0;
  for (const Program& program : programs) {
    // Few values where a program takes long to load.
    const bool slow = program.path == MPFEM_PACK_GEN;
    for (const Command& command : program.commands)
      for (const std::string& option : number_options(program.path, command.name)) {
        ++options;
        std::vector<std::string> values = {"nan", "1e300"};
        if (!slow) values.insert(values.end(), {"-inf", "1e400", "12x", "", std::string(100'000, '9')});
        for (const std::string& value : values) {
          std::vector<std::string> arguments = {command.name};
          arguments.insert(arguments.end(), command.required.begin(), command.required.end());
          arguments.push_back(option + "=" + value);
          INFO(program.path << " " << command.name << " " << option << "=" << value.substr(0, 40));
          CHECK(fault_of_refusal(program.path, arguments, {option, "--help"}) == "");
        }
      }
  }
  CHECK(options >= 40); // so many there are: a help that is laid out otherwise must not pass
}

TEST_CASE("Words that no program knows are refused in one line that names the help") {
  const std::string endless(100'000, 'x');
  for (const Program& program : programs) {
    std::vector<std::vector<std::string>> lines = {{}, {"nothing"}, {"--nothing"}, {endless}, {"--" + endless}, {"\n"}};
    for (const Command& command : program.commands) {
      if (program.path == MPFEM_PACK_GEN && command.name != "mesh") continue;
      lines.push_back({command.name, "--nothing"});
      lines.push_back({command.name, "a", "b", "c", "--quiet=maybe" + endless});
      if (!command.required.empty()) lines.push_back({command.name});
    }
    for (const auto& line : lines) {
      INFO(program.path << " " << fmt::format("{}", line.empty() ? "" : line.back().substr(0, 40)));
      CHECK(fault_of_refusal(program.path, line, {"--help"}) == "");
    }
  }
}

TEST_CASE("Each program names an unknown subcommand and those that it has") {
  for (const Program& program : programs) {
    const std::string first = program.commands.front().name;
    INFO(program.path);
    CHECK(fault_of_refusal(program.path, {"qqqqqqq"}, {"found 'qqqqqqq'", "allowed: " + first + ", "}) == "");
    CHECK(fault_of_refusal(program.path, {first + "x"}, {fmt::format("did you mean '{}'?", first)}) == "");
  }
}

TEST_CASE("A word that no program knows is refused with --help and --version, too") {
  for (const Program& program : programs) {
    const std::string first = program.commands.front().name, near = fmt::format("did you mean '{}'?", first);
    INFO(program.path);
    for (const std::string flag : {"--help", "-h", "--version"})
      CHECK(fault_of_refusal(program.path, {first + "x", flag}, {near}) == "");
    CHECK(fault_of_refusal(program.path, {"--help", first + "x"}, {near}) == "");
    CHECK(fault_of_refusal(program.path, {first, "--help", "--nothing"}, {"found '--nothing'"}) == "");
  }
}

TEST_CASE("An input that does not exist is named before an option that is missing") {
  for (const auto& [program, arguments] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{{MPFEM_PACK_GEN, {"spheres", "none"}},
                                                                     {MPFEM_PACK_GEN, {"mesh", "none"}},
                                                                     {MPFEM_EXECUTABLE, {"run", "none"}},
                                                                     {MPFEM_EXECUTABLE, {"bond", "none", __FILE__}},
                                                                     {MPFEM_POSTPROC, {"fit", "none"}},
                                                                     {MPFEM_POSTPROC, {"vtk", "none"}},
                                                                     {MPFEM_POSTPROC, {"triaxial", "none"}},
                                                                     {MPFEM_POSTPROC, {"table", "none"}},
                                                                     {MPFEM_POSTPROC, {"report", "none"}}}) {
    INFO(program << " " << arguments.front());
    CHECK(fault_of_refusal(program, arguments, {": none: no such file"}) == "");
    std::vector<std::string> present = arguments;
    present[1] = __FILE__;
    CHECK(fault_of_refusal(program, present, {"is required"}) == "");
  }
}

TEST_CASE("The version is printed with the name of the program") {
  for (const auto& [path, name] : {std::pair{MPFEM_PACK_GEN, "pack-gen"}, std::pair{MPFEM_EXECUTABLE, "mpfem"},
                                   std::pair{MPFEM_POSTPROC, "postproc"}})
    CHECK_THAT(run_command(fmt::format("'{}' --version", path)).output,
               Catch::Matches(fmt::format("{} [0-9]+\\.[0-9]+\\.[0-9]+( \\(commit .+\\))?\n", name)));
}

TEST_CASE("Help and version end with exit code 0") {
  for (const Program& program : programs) {
    CHECK(run_limited(program.path, {"--help"}).exit_code == 0);
    CHECK(run_limited(program.path, {"--version"}).exit_code == 0);
    CHECK(run_limited(program.path, {program.commands.front().name, "--help"}).exit_code == 0);
  }
}
