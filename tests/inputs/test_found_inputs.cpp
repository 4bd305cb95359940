// Inputs that fuzzers have found, read again: tests/inputs/found/NAME/ holds those of the fuzzer NAME of tests/fuzz.
// Each is taken or refused, in one line and in time.

#include <chrono>
#include <filesystem>

#include <catch2/catch.hpp>

#include "folder.hpp"

extern "C" {
int fuzz_scenario(const std::uint8_t* data, std::size_t size);
int fuzz_assignments(const std::uint8_t* data, std::size_t size);
int fuzz_bond(const std::uint8_t* data, std::size_t size);
int fuzz_powder(const std::uint8_t* data, std::size_t size);
int fuzz_spheres(const std::uint8_t* data, std::size_t size);
int fuzz_points(const std::uint8_t* data, std::size_t size);
int fuzz_stl(const std::uint8_t* data, std::size_t size);
}

using namespace mpfem::test;

TEST_CASE("Inputs that fuzzers have found are taken or refused, and in time") {
  constexpr double longest = 5; // s
  int inputs = 0;
  for (const auto& [name, read] :
       std::vector<std::pair<std::string, int (*)(const std::uint8_t*, std::size_t)>>{{"scenario", fuzz_scenario},
                                                                                      {"assignments", fuzz_assignments},
                                                                                      {"bond", fuzz_bond},
                                                                                      {"powder", fuzz_powder},
                                                                                      {"spheres", fuzz_spheres},
                                                                                      {"points", fuzz_points},
                                                                                      {"stl", fuzz_stl}}) {
    for (const char* folder : {MPFEM_FOUND_INPUTS, MPFEM_SEEDS}) {
      const std::filesystem::path path = std::filesystem::path(folder) / name;
      if (!std::filesystem::is_directory(path)) continue;
      for (const auto& entry : std::filesystem::directory_iterator(path)) {
        INFO(entry.path().string());
        const std::string text = read_text(entry.path().string());
        const auto start = std::chrono::steady_clock::now();
        read(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()); // aborts where the reader does wrong
        CHECK(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < longest);
        ++inputs;
      }
    }
  }
  CHECK(inputs > 0);
}
