#include <algorithm>
#include <chrono>
#include <cstdio>
#include <limits>
#include <thread>

#include <fcntl.h>
#include <pty.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "common/progress.hpp"
#include "stream_capture.hpp"

using namespace mpfem;

TEST_CASE("Durations are written as a person reads them") {
  CHECK(duration_text(0) == "0.0 s");
  CHECK(duration_text(4.52) == "4.5 s");
  CHECK(duration_text(59.94) == "59.9 s");
  CHECK(duration_text(59.96) == "1:00"); // never "60.0 s"
  CHECK(duration_text(62) == "1:02");
  CHECK(duration_text(3599.4) == "59:59");
  CHECK(duration_text(3599.6) == "1:00:00"); // never "60:00"
  CHECK(duration_text(3723) == "1:02:03");
  CHECK(duration_text(360'000) == "100:00:00");
}

TEST_CASE("A duration that is negative or not finite is written as a word") {
  CHECK(duration_text(-1) == "unknown");
  CHECK(duration_text(std::numeric_limits<double>::quiet_NaN()) == "unknown");
  CHECK(duration_text(std::numeric_limits<double>::infinity()) == "very long");
}

TEST_CASE("a progress line holds label, per cent, elapsed time, the remaining time where it is known, and detail") {
  CHECK(progress_line("run", 0.42, "RD 0.71", 62, 85) == "run  42.0 %  elapsed 1:02  remaining 1:25  RD 0.71");
  CHECK(progress_line("run", 0, "", 0, std::nullopt) == "run   0.0 %  elapsed 0.0 s");
  CHECK(progress_line("run", 1, "", 3, 0) == "run 100.0 %  elapsed 3.0 s  remaining 0.0 s");
}

TEST_CASE("A job of unknown length shows elapsed time and detail, and no per cent") {
  CHECK(progress_line("run", std::nullopt, "0.2 (wanted: 0.1)", 62, std::nullopt) ==
        "run  elapsed 1:02  0.2 (wanted: 0.1)");
}

namespace {

/// The two ends of a terminal that nobody sees.
struct Terminal {
  Terminal() {
    REQUIRE(openpty(&screen, &line, nullptr, nullptr, nullptr) == 0);
    stream = fdopen(line, "w");
    REQUIRE(fcntl(screen, F_SETFL, O_NONBLOCK) == 0);
  }
  ~Terminal() {
    std::fclose(stream);
    close(screen);
  }
  /// What has been written since the last call.
  std::string text() const {
    char buffer[4096];
    const ssize_t length = read(screen, buffer, sizeof buffer);
    return length > 0 ? std::string(buffer, static_cast<std::size_t>(length)) : std::string();
  }
  int screen = -1, line = -1;
  std::FILE* stream = nullptr;
};

} // namespace

TEST_CASE("On a terminal a job of unknown length writes nothing in its first second, then a line") {
  const Terminal terminal;
  Progress progress("pack", false, terminal.stream);
  progress.update("early");
  CHECK(terminal.text().empty());
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  progress.update("late");
  CHECK_THAT(terminal.text(), Catch::StartsWith("\rpack  elapsed 1.") && Catch::Contains(" s  late"));
  progress.finish("all");
  CHECK_THAT(terminal.text(), Catch::Contains("pack  done in 1."));
}

TEST_CASE("A quiet job writes nothing") {
  const test::TemporaryStream stream;
  Progress progress("run", true, stream.get());
  progress.update(0.5, "half");
  progress.update("unknown");
  progress.finish("all");
  CHECK(stream.text().empty());
}

TEST_CASE("Without a terminal a line is written for every tenth of the job, and one at the end") {
  const test::TemporaryStream stream;
  Progress progress("run", false, stream.get());
  for (int i = 0; i <= 1000; ++i) progress.update(i / 1000.0, "");
  progress.finish("36 grains");
  progress.update(1, "late");
  progress.finish("again");

  const std::string text = stream.text();
  // 0.1 + 0.1 + … in steps of 0.001 may round a line to the next step, so nine or ten of them.
  const auto lines = std::count(text.begin(), text.end(), '\n');
  CHECK((lines == 10 || lines == 11));
  CHECK_THAT(text, Catch::EndsWith("run  done in 0.0 s  36 grains\n"));
  CHECK_THAT(text, !Catch::Contains("late") && !Catch::Contains("again") && !Catch::Contains("\r"));
}

TEST_CASE("What a detail holds stays on one line, and a fraction outside 0 … 1 is clamped") {
  const test::TemporaryStream stream;
  Progress progress("run", false, stream.get());
  progress.update(std::numeric_limits<double>::quiet_NaN(), "");
  progress.update(7, "a\nb");
  const std::string text = stream.text();
  CHECK_THAT(text, Catch::StartsWith("run 100.0 %  elapsed ") && Catch::Contains("  remaining 0.0 s  ") &&
                       Catch::EndsWith("  a\\nb\n"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 1);
}

TEST_CASE("The time left of a resumed job is judged from what was done since it was resumed") {
  const test::TemporaryStream stream;
  Progress progress("run", false, stream.get());
  progress.update(0.6, "");
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  progress.update(0.8, "");
  // A fifth of the job took t, so the last fifth takes t too; judged from zero it would be t / 4.
  const std::string text = stream.text();
  const std::size_t at = text.find("elapsed ");
  REQUIRE(at != std::string::npos);
  double elapsed = 0, remaining = 0;
  REQUIRE(std::sscanf(text.c_str() + at, "elapsed %lf s remaining %lf s", &elapsed, &remaining) == 2);
  CHECK(elapsed >= 0.5);
  CHECK(remaining == Approx(elapsed).margin(0.1001)); // both are rounded to 0.1 s
}
