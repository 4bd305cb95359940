// How much memory a process may still take, from system files made up here.

#include <cmath>
#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "common/available_memory.hpp"
#include "tests/support/folder.hpp"

using mpfem::available_memory;

namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

} // namespace

TEST_CASE("without limits, the memory available is what the system has") {
  const mpfem::test::Folder folder;
  const fs::path processes = folder / "proc", groups = folder / "groups";
  CHECK(std::isinf(available_memory(processes, groups)));
  write(processes / "meminfo", "MemTotal:  900 kB\nMemFree:  100 kB\nMemAvailable:     500 kB\n");
  CHECK(available_memory(processes, groups) == 512000);
}

TEST_CASE("a control group's limit counts, whichever version, and that of the groups around it") {
  const mpfem::test::Folder folder;
  const fs::path processes = folder / "proc", groups = folder / "groups";
  write(processes / "meminfo", "MemAvailable: 500 kB\n");
  SECTION("version 2") {
    write(processes / "self/cgroup", "0::/batch/job\n");
    write(groups / "batch/job/memory.max", "max\n");
    write(groups / "batch/job/memory.current", "5000\n");
    CHECK(available_memory(processes, groups) == 512000);
    write(groups / "batch/memory.max", "300000\n");
    write(groups / "batch/memory.current", "100000\n");
    CHECK(available_memory(processes, groups) == 200000);
    write(groups / "batch/memory.stat", "anon 90000\ninactive_file 10000\n"); // read files give way
    CHECK(available_memory(processes, groups) == 210000);
    write(groups / "batch/job/memory.max", "4000\n");
    CHECK(available_memory(processes, groups) == 0);
  }
  SECTION("version 1") {
    write(processes / "self/cgroup", "4:memory:/job\n3:cpuset:/\n0::/\n");
    write(groups / "memory/job/memory.limit_in_bytes", "300000\n");
    write(groups / "memory/job/memory.usage_in_bytes", "100000\n");
    CHECK(available_memory(processes, groups) == 200000);
  }
  SECTION("a container that sees its own group as the root") {
    write(processes / "self/cgroup", "0::/seen/from/outside\n");
    write(groups / "memory.max", "300000\n");
    write(groups / "memory.current", "100000\n");
    CHECK(available_memory(processes, groups) == 200000);
  }
}

TEST_CASE("this system has memory to spare") {
  CHECK(available_memory() > 1e6);
}
