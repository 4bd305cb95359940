#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <new>
#include <system_error>

#include <unistd.h>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "common/physical_host.hpp"
#include "common/version.hpp"
#include "stream_capture.hpp"

using namespace mpfem;

namespace {

struct Ending {
  int code;
  std::string message;
};

Ending run(int (*body)(int, char**)) {
  Ending ending{};
  ending.message = test::standard_error_of([&] { ending.code = run_program("program", body, 0, nullptr); });
  return ending;
}

template <class Exception>
int fail(int, char**) {
  throw Exception("line 1\nline 2\x1b[2J");
}

const std::string escaped_line = "program: error: line 1\\nline 2\\x1b[2J\n";

} // namespace

TEST_CASE("A program that ends well has the exit code of its body and says nothing") {
  CHECK(run([](int, char**) { return 0; }).code == 0);
  CHECK(run([](int, char**) { return 7; }).code == 7);
  CHECK(run([](int, char**) { return 0; }).message.empty());
}

TEST_CASE("The body gets the program's arguments") {
  std::string word = "word";
  char* arguments[] = {word.data()};
  const auto body = [](int argc, char** argv) { return argc == 1 && std::string(argv[0]) == "word" ? 0 : 1; };
  CHECK(run_program("program", body, 1, arguments) == 0);
}

TEST_CASE("Every exception has its exit code and makes one line") {
  const auto [body, code] = GENERATE(table<int (*)(int, char**), int>({
      {fail<InputError>, 2},
      {fail<SimulationError>, 3},
      {fail<StorageError>, 4},
      {fail<Interrupted>, 5},
      {fail<std::runtime_error>, 3},
      {fail<std::logic_error>, 3},
  }));
  const Ending ending = run(body);
  CHECK(ending.code == code);
  CHECK(ending.message == escaped_line);
}

TEST_CASE("Lack of memory and what is no std::exception make one line too") {
  const Ending memory = run([](int, char**) -> int { throw std::bad_alloc(); });
  CHECK(memory.code == 3);
  CHECK(memory.message == "program: error: out of memory\n");
  const Ending unknown = run([](int, char**) -> int { throw 5; });
  CHECK(unknown.code == 3);
  CHECK(unknown.message == "program: error: unknown error\n");
}

TEST_CASE("A program whose reader closes the pipe says so in one line and ends with the code of failed storage") {
  const auto [body] = GENERATE(table<int (*)(int, char**)>({
      {[](int, char**) -> int { throw std::system_error(EPIPE, std::generic_category(), "cannot write to file"); }},
      {[](int, char**) -> int {
        std::puts("more than is read"); // it is written at the end
        return 0;
      }},
  }));
  std::fflush(stdout);
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  const int kept = dup(STDOUT_FILENO);
  dup2(ends[1], STDOUT_FILENO);
  for (const int end : ends) close(end);
  const Ending ending = run(body);
  dup2(kept, STDOUT_FILENO);
  close(kept);
  CHECK(ending.code == 4);
  CHECK(ending.message == "program: error: the output was cut short: the program that reads it has closed the pipe\n");
}

TEST_CASE("The version is three numbers, and the host one line without control characters") {
  CHECK_THAT(std::string(version()), Catch::Matches("[0-9]+\\.[0-9]+\\.[0-9]+"));
  CHECK_THAT(version_and_commit(),
             Catch::Matches(std::string(version()) + "( \\(commit [0-9a-f]{10}( and changes)?\\))?"));
  const std::string host = physical_host();
  CHECK(!host.empty());
  CHECK(std::none_of(host.begin(), host.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }));
  CHECK_THAT(host, Catch::Contains("logical processors"));
}
