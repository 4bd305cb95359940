// Stages of tools whose punches do not lead to the density or height at which they end.

#include <string>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/small_runs.hpp"
#include "tests/support/small_tablet.hpp"

using namespace mpfem;
using namespace mpfem::test;

namespace {

const std::string compaction = R"(away = ["plate"]
relative_density = 0.45
drive.upper.speed = 20000
drive.lower.speed = 20000
)";

/// The small tablet's compaction with other keys, and nothing after it but `next`.
std::string pressed_by(const std::string& keys, const std::string& next = "") {
  const std::string head = tablet_text.substr(0, tablet_text.find("[[stages]]\nname = \"hold\""));
  return replaced(head, compaction, "away = [\"plate\"]\n" + keys) + next;
}

Outcome outcome_of(const std::string& command, const Folder& folder) {
  const std::string output = command == "run" ? fmt::format(" -o {} --quiet", folder / "run.h5") : "";
  return mpfem_command(fmt::format("{} {}{}", command, folder / "scenario.toml", output));
}

} // namespace

TEST_CASE("punches that do not lead to the stage's density or height are refused before the first step") {
  const std::string together = "drive.upper.speed = 20000\ndrive.lower.speed = 20000\n",
                    apart = "drive.upper.speed = -20000\n", beside = "drive.die.velocity = [0, 0, 1000]\n";
  struct Refused {
    std::string keys, message;
  };
  for (const Refused& refused : {Refused{"relative_density = 0.1\n" + together, "together, allowed: more"},
                                 Refused{"height = 5\n" + together, "together, allowed: less"},
                                 Refused{"relative_density = 0.45\n" + apart, "apart, allowed: less"},
                                 Refused{"height = 0.1\n" + apart, "apart, allowed: more"},
                                 Refused{"relative_density = 0.45\n" + beside, "keep their distance"}}) {
    const Folder folder;
    prepare(folder, 3, pressed_by(refused.keys));
    for (const char* command : {"check", "run"}) {
      const Outcome outcome = outcome_of(command, folder);
      CAPTURE(refused.keys, command, outcome.messages);
      CHECK(outcome.exit_code == 2);
      CHECK_THAT(outcome.messages, Catch::Contains("scenario.toml:") && Catch::Contains(refused.message));
    }
  }
}

TEST_CASE("a density that the punches do not lead to is no error where something else ends the stage") {
  const Folder folder;
  prepare(folder, 3, pressed_by("relative_density = 0.45\ntravel = 0.001\ndrive.die.velocity = [0, 0, 1000]\n"));
  CHECK(outcome_of("run", folder).exit_code == 0);
}

TEST_CASE("a later stage of tools that begins beyond its density fails, and ends at once within 1 % of it") {
  const auto after_compaction = [](const std::string& density) {
    const Folder folder;
    prepare(folder, 3,
            pressed_by(compaction.substr(compaction.find("relative")),
                       "[[stages]]\nname = \"again\"\ntype = \"tools\"\naway = [\"plate\"]\nrelative_density = " +
                           density + "\ndrive.upper.speed = 20000\n"));
    return outcome_of("run", folder);
  };
  const Outcome beyond = after_compaction("0.3");
  INFO(beyond.messages);
  CHECK(beyond.exit_code == 3);
  CHECK_THAT(beyond.messages, Catch::Contains("'again'") && Catch::Contains("together, allowed: more"));
  CHECK(after_compaction("0.449").exit_code == 0);
}
