#include <fstream>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "common/errors.hpp"
#include "common/output_file.hpp"
#include "tests/common/one_line_error.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/null_device.hpp"

using namespace mpfem;
using mpfem::test::Folder;
using mpfem::test::input_error;
using mpfem::test::one_line_error;
using mpfem::test::read_text;
namespace fs = std::filesystem;

namespace {

std::string refusal(const std::string& path, OutputKind kind) {
  return input_error([&] { check_output_path("--output", path, kind); });
}

bool is_character_device(const std::string& path) {
  return fs::is_character_file(path);
}

} // namespace

TEST_CASE("A new name, a file and a link to one are good outputs of either kind") {
  const Folder folder;
  test::write_text(folder / "old", "old");
  fs::create_symlink("old", folder / "link");
  fs::create_symlink("not yet", folder / "dangling");
  for (const OutputKind kind : {OutputKind::text, OutputKind::binary})
    for (const std::string name : {"new", "old", "link", "dangling"})
      CHECK_NOTHROW(check_output_path("--output", folder / name, kind));
}

TEST_CASE("A folder, a socket, no name and a missing folder are refused as outputs of either kind") {
  const Folder folder;
  fs::create_directory(folder / "folder");
  const int socket_file = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string at = folder / "socket";
  REQUIRE(at.size() < sizeof address.sun_path);
  at.copy(address.sun_path, at.size());
  REQUIRE(bind(socket_file, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  close(socket_file);
  const std::string text = ", a pipe or a device";
  for (const auto& [kind, more] : {std::pair{OutputKind::text, text}, {OutputKind::binary, std::string()}}) {
    const auto expected = [&, more = more](const std::string& path, const std::string& what) {
      return "--output " + path + ": found " + what + ", allowed: a file" + more;
    };
    CHECK(refusal(folder / "folder", kind) == expected(folder / "folder", "a folder"));
    CHECK(refusal(folder / "new/", kind) == expected(folder / "new/", "a folder"));
    CHECK(refusal(".", kind) == expected(".", "a folder"));
    CHECK(refusal(at, kind) == expected(at, "a socket"));
    CHECK(refusal("", kind) == "--output: found an empty name, allowed: a file");
    CHECK(refusal(folder / "none/x", kind) ==
          "--output " + (folder / "none/x") + ": the folder does not exist, allowed: a file in an existing folder");
  }
}

TEST_CASE("An output that is an input is refused, by another path or a link too, before it exists or after") {
  const Folder folder;
  test::write_text(folder / "in", "read");
  fs::create_symlink("in", folder / "link");
  fs::create_directory(folder / "sub");
  const auto refusal_of = [&](const std::string& output, const std::string& input) {
    return input_error([&] { refuse_overwriting("--data", output, input); });
  };
  CHECK(refusal_of(folder / "in", folder / "in") ==
        "--data " + (folder / "in") + ": would overwrite the input " + (folder / "in") + ", allowed: another file");
  for (const std::string same : {"link", "sub/../in"}) {
    CHECK_FALSE(refusal_of(folder / same, folder / "in").empty());
    CHECK_FALSE(refusal_of(folder / "in", folder / same).empty());
  }
  CHECK_FALSE(refusal_of(folder / "sub/../new", folder / "new").empty());
  test::write_text(folder / "copy", "read");
  for (const auto& [output, input] : {std::pair<std::string, std::string>{folder / "copy", folder / "in"},
                                      {folder / "new", folder / "in"},
                                      {folder / "in", folder / "new"},
                                      {"", ""},
                                      {"/dev/null", "/dev/null"}})
    CHECK_NOTHROW(refuse_overwriting("--data", output, input));
  // Until it is complete, an output has this name.
  CHECK_FALSE(refusal_of(folder / "in", folder / "in.partial").empty());
  CHECK_NOTHROW(refuse_overwriting("--data", folder / "in.partial", folder / "in"));
}

TEST_CASE("Two outputs under one name, or one under the other's partial name, are refused before they exist") {
  const Folder folder;
  fs::create_symlink("b", folder / "link");
  const auto check = [&](const std::string& first, const std::string& second) {
    refuse_shared_names({{"--output", first}, {"--view", ""}, {"--data", second}});
  };
  const auto refusal_of = [&](const std::string& first, const std::string& second) {
    return input_error([&] { check(first, second); });
  };
  CHECK(refusal_of(folder / "a", folder / "a") ==
        "--data " + (folder / "a") + ": would overwrite the output of --output, allowed: another file");
  for (const std::string same : {"b", "./b", "b.partial"}) {
    CHECK_FALSE(refusal_of(folder / same, folder / "link").empty());
    CHECK_FALSE(refusal_of(folder / "link", folder / same).empty());
  }
  CHECK_NOTHROW(check(folder / "a", folder / "b"));
  CHECK_NOTHROW(check("", ""));
  CHECK_NOTHROW(check("/dev/null", "/dev/null"));
}

TEST_CASE("Nothing replaces a TOML file, unless it is empty") {
  const Folder folder;
  test::write_text(folder / "scenario.toml", "packing = 'packing.h5'");
  test::write_text(folder / "empty.toml", "");
  for (const OutputKind kind : {OutputKind::text, OutputKind::binary}) {
    CHECK_THROWS_WITH(check_output_path("--output", folder / "scenario.toml", kind),
                      Catch::Contains("scenario.toml: would replace a TOML file"));
    CHECK_NOTHROW(check_output_path("--output", folder / "empty.toml", kind));
    CHECK_NOTHROW(check_output_path("--output", folder / "new.toml", kind));
  }
}

TEST_CASE("A text does not replace an HDF5 file, and replaces any other but TOML") {
  const Folder folder;
  test::write_text(folder / "run.h5", std::string("\x89HDF\r\n\x1a\n", 8) + "what follows");
  test::write_text(folder / "text.h5", "HDF is only its name");
  CHECK_THROWS_WITH(check_output_path("--output", folder / "run.h5", OutputKind::text),
                    Catch::Contains("run.h5: would replace an HDF5 file"));
  CHECK_NOTHROW(check_output_path("--output", folder / "run.h5", OutputKind::binary));
  CHECK_NOTHROW(check_output_path("--output", folder / "text.h5", OutputKind::text));
}

TEST_CASE("An output with another ending than the allowed ones is refused with both") {
  const auto refusal_of = [](const std::string& path) {
    return input_error([&] { refuse_other_endings("--output", path, {".png", ".svg"}); });
  };
  CHECK_NOTHROW(refuse_other_endings("--output", "a.b/x.svg", {".png", ".svg"}));
  CHECK_NOTHROW(refuse_other_endings("--output", "a.b/x.png.partial", {".png", ".svg"}));
  CHECK(refusal_of("x.jpg.partial") == "--output x.jpg.partial: found the ending '.jpg', allowed: .png or .svg");
  CHECK(refusal_of("x.jpg") == "--output x.jpg: found the ending '.jpg', allowed: .png or .svg");
  CHECK(refusal_of("a.png/x") == "--output a.png/x: found no ending, allowed: .png or .svg");
}

TEST_CASE("An output that ends as another format does is refused, one with an ending of its own or none is not") {
  for (const std::string good : {"t.csv", "t.csv.partial", "t", "t.txt", "t.d", "a.png/t", "/dev/stdout", ".csv"})
    CHECK_NOTHROW(refuse_ending_of_other_format("--output", good, {".csv", ".json"}));
  CHECK_THROWS_WITH(refuse_ending_of_other_format("--data", "run.png", {".csv", ".json"}),
                    "--data run.png: found the ending '.png', allowed: .csv or .json");
  for (const std::string bad : {"t.PNG", "t.h5", "t.svg.partial", "t.html", "t.CSV", "t.toml"})
    CHECK_THROWS_AS(refuse_ending_of_other_format("--output", bad, {".csv"}), InputError);
}

TEST_CASE("An output is tried without a trace, and one that cannot be written is a StorageError") {
  const Folder folder;
  test::write_text(folder / "old", "old");
  try_output(folder / "old");
  try_output(folder / "new");
  CHECK(read_text(folder / "old") == "old");
  CHECK(std::distance(fs::directory_iterator(folder / "."), {}) == 1);
  CHECK_NOTHROW(try_output("/dev/null"));
  CHECK_THROWS_AS(try_output(folder / "none/out"), StorageError);
  fs::create_directory(folder / "old.partial");
  CHECK_THROWS_AS(try_output(folder / "old"), StorageError);
}

TEST_CASE("Trying an output keeps what lies under the name of its partial file") {
  const Folder folder;
  test::write_text(folder / "out.partial", "complete");
  try_output(folder / "out");
  CHECK(read_text(folder / "out.partial") == "complete");
}

TEST_CASE("A FIFO or a character device is an output of text only") {
  const Folder folder;
  const std::string fifo = folder / "fifo";
  REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
  CHECK_NOTHROW(check_output_path("--output", fifo, OutputKind::text));
  CHECK(refusal(fifo, OutputKind::binary) == "--output " + fifo + ": found a FIFO, allowed: a file");
  CHECK_NOTHROW(check_output_path("--output", "/dev/null", OutputKind::text));
  CHECK(refusal("/dev/null", OutputKind::binary) == "--output /dev/null: found a character device, allowed: a file");
}

TEST_CASE("Text reaches the reader of a FIFO, which stays a FIFO") {
  const Folder folder;
  const std::string fifo = folder / "fifo";
  REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
  std::string received;
  std::thread reader([&] { received = read_text(fifo); });
  write_file(fifo, "a,b\n1,2\n");
  reader.join();
  CHECK(received == "a,b\n1,2\n");
  CHECK(fs::is_fifo(fifo));
  CHECK_FALSE(fs::exists(fifo + ".partial"));
}

TEST_CASE("Writing text to a device leaves the device a device") {
  const Folder folder;
  const std::string device = folder / "null";
  if (!test::make_null_device(device)) {
    WARN("devices can be made by the superuser only");
    return;
  }
  // Where devices may be made but not opened (a container), the writing fails; the device stays all the same.
  try {
    write_file(device, "nothing");
  } catch (const StorageError&) {
  }
  CHECK(is_character_device(device));
  CHECK_FALSE(fs::exists(device + ".partial"));
}

TEST_CASE("A full device ends in a StorageError") {
  CHECK_THROWS_AS(write_file("/dev/full", "too much"), StorageError);
  CHECK(is_character_device("/dev/full"));
}

TEST_CASE("A link is kept, what it leads to is replaced, and a link to nothing makes a file") {
  const Folder folder;
  fs::create_directory(folder / "store");
  test::write_text(folder / "store/old", "old");
  fs::create_symlink("store/old", folder / "link");
  fs::create_symlink("link", folder / "second");
  fs::create_symlink(folder / "store/new", folder / "dangling");
  CHECK(output_target(folder / "second") == folder / "store/old");
  CHECK(output_target(folder / "dangling") == folder / "store/new");
  CHECK(output_target(folder / "none") == folder / "none");
  write_file(folder / "second", "written");
  write_file(folder / "dangling", "too");
  CHECK(fs::is_symlink(folder / "second"));
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(read_text(folder / "store/old") == "written");
  CHECK(fs::is_symlink(folder / "dangling"));
  CHECK(read_text(folder / "store/new") == "too");
}

TEST_CASE("Anything with the name of the partial file is replaced, except a folder") {
  const Folder folder;
  const std::string path = folder / "out", partial = path + ".partial";
  SECTION("a file") {
    test::write_text(partial, "left by a crash, and longer than what comes");
  }
  SECTION("a FIFO") {
    REQUIRE(mkfifo(partial.c_str(), 0600) == 0);
  }
  SECTION("a link") {
    test::write_text(folder / "other", "other");
    fs::create_symlink("other", partial);
  }
  write_file(path, "text");
  CHECK(read_text(path) == "text");
  CHECK(fs::is_regular_file(fs::symlink_status(path)));
  CHECK_FALSE(fs::exists(fs::symlink_status(partial)));
  if (fs::exists(folder / "other")) CHECK(read_text(folder / "other") == "other");
  fs::create_directory(partial);
  CHECK_THROWS_AS(write_file(path, "later"), StorageError);
  CHECK(read_text(path) == "text");
}

TEST_CASE("A text file that is not completed leaves nothing and keeps the older one") {
  const Folder folder;
  const std::string path = folder / "out";
  test::write_text(path, "older");
  {
    TextFile file(path);
    file.write("new");
    CHECK(fs::exists(path + ".partial"));
  }
  CHECK_FALSE(fs::exists(path + ".partial"));
  CHECK(read_text(path) == "older");
  CHECK_THROWS_AS(TextFile(folder / "none/out"), StorageError);
}

TEST_CASE("A complete text that cannot take its name stays in the partial file that the error names") {
  const Folder folder;
  const std::string path = folder / "out";
  {
    TextFile file(path);
    file.write("whole");
    fs::create_directory(path);
    CHECK_THAT(one_line_error<StorageError>([&] { file.complete(); }), Catch::Contains("out.partial"));
  }
  CHECK(read_text(path + ".partial") == "whole");
}
