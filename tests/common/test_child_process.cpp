#include <chrono>
#include <csignal>
#include <stdexcept>

#include <unistd.h>

#include <catch2/catch.hpp>

#include "common/child_process.hpp"

using namespace mpfem;

TEST_CASE("What a child writes arrives, however much it is") {
  const std::string much(300'000, 'x');
  const ChildEnd end = run_in_child([&](const auto& write) { write("one\n"), write(much); }, 60);
  CHECK(end.output == "one\n" + much);
  CHECK(end.exit_code == 0);
  CHECK(end.signal == 0);
  CHECK_FALSE(end.out_of_time);
}

TEST_CASE("A child that crashes is reported with its signal and what it wrote before") {
  const ChildEnd end = run_in_child(
      [](const auto& write) {
        write("so far");
        std::raise(SIGSEGV);
      },
      60);
  CHECK(end.signal == SIGSEGV);
  CHECK(end.output == "so far");
}

TEST_CASE("A child that an uncaught exception ends has exit code 1") {
  const ChildEnd end = run_in_child([](const auto&) { throw std::runtime_error("no"); }, 60);
  CHECK(end.exit_code == 1);
  CHECK(end.signal == 0);
}

TEST_CASE("A child that does not end is killed when its time is over") {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const ChildEnd end = run_in_child(
      [](const auto& write) {
        write("waiting");
        for (;;) pause();
      },
      0.2);
  CHECK(end.out_of_time);
  CHECK(end.signal == SIGKILL);
  CHECK(end.output == "waiting");
  CHECK(Clock::now() - start < std::chrono::seconds(30));
}
