// Subcommands: their outputs are checked before any work.

#include <filesystem>
#include <vector>

#include <catch2/catch.hpp>

#include "common/command_line.hpp"
#include "common/errors.hpp"
#include "common/subcommand.hpp"
#include "one_line_error.hpp"
#include "tests/support/folder.hpp"

using namespace mpfem;
using test::Folder;
using test::input_error;
using test::read_text;
using test::write_text;

namespace {

/// Writes its output, and a report where one is wanted.
class CopyCommand : public Subcommand {
public:
  explicit CopyCommand(CLI::App& app) : Subcommand(app, "copy", "Copy a text") {
    add_input("input", input_, "Text to read")->required();
    add_output("-o,--output", output_, "Text to write", OutputKind::text)->required();
    add_output("--report", report_, "Report to write", OutputKind::text,
               [](const std::string& option, const std::string& path) {
                 if (!path.ends_with(".md")) throw InputError(option + " " + path + ": found no .md, allowed: .md");
               });
  }

private:
  void execute() const override {
    write_file(output_, read_text(input_));
    if (!report_.empty()) write_file(report_, "done");
  }
  std::string input_, output_, report_;
};

void run(std::vector<std::string> words) {
  CLI::App app("example");
  app.require_subcommand(1);
  CopyCommand command(app);
  words.insert(words.begin(), {"example", "copy"});
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  parse_command_line(app, "example", static_cast<int>(pointers.size()), pointers.data());
  command.run_if_given();
}

} // namespace

TEST_CASE("A subcommand writes the outputs that are wanted, and no others") {
  const Folder folder;
  write_text(folder / "in", "text");
  run({folder / "in", "-o", folder / "out"});
  CHECK(read_text(folder / "out") == "text");
  run({folder / "in", "-o", folder / "out", "--report", folder / "report.md"});
  CHECK(read_text(folder / "report.md") == "done");
  CHECK(std::distance(std::filesystem::directory_iterator(folder / ""), {}) == 3);
}

TEST_CASE("A subcommand refuses outputs before it writes any of them") {
  const Folder folder;
  write_text(folder / "in", "text");
  const auto refusal = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{folder / "in"};
    words.insert(words.end(), options.begin(), options.end());
    const std::string message = input_error([&] { run(words); });
    CHECK(read_text(folder / "in") == "text");
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
    return message;
  };
  CHECK_THAT(refusal({"-o", folder / "in"}), Catch::Contains("--output"));
  CHECK_THAT(refusal({"-o", folder / "out", "--report", folder / "out"}),
             Catch::Contains("--output") && Catch::Contains("--report"));
  CHECK_THAT(refusal({"-o", folder / "out", "--report", folder / "report.txt"}), Catch::Contains("allowed: .md"));
  CHECK_THAT(refusal({"-o", folder / "missing/out"}), Catch::Contains("--output"));
  CHECK_THAT(refusal({"-o", ""}), Catch::Contains("--output"));
}
