#include "common/output_file.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

namespace {

/// What is at a path; links are followed.
std::optional<struct stat> found_at(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return {};
  return found;
}

std::string kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a folder";
  if (S_ISCHR(mode)) return "a character device";
  if (S_ISBLK(mode)) return "a block device";
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISSOCK(mode)) return "a socket";
  return "a special file";
}

bool is_stream(mode_t mode) {
  return S_ISCHR(mode) || S_ISFIFO(mode);
}

bool is_standard_output(const struct stat& found) {
  struct stat output {};
  return fstat(STDOUT_FILENO, &output) == 0 && output.st_dev == found.st_dev && output.st_ino == found.st_ino;
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Waits until the content of a file or folder is on the disk. File systems without this operation report EINVAL.
bool reaches_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool good = fsync(file) == 0 || errno == EINVAL;
  return close(file) == 0 && good;
}

/// The name under which an output is written until it is complete.
std::string partial_of(const std::string& path) {
  return output_target(path) + ".partial";
}

/// Whether writing `output` would replace or remove `file`.
bool replaces(const std::string& output, const std::string& file) {
  return same_file(output, file) || (!output.empty() && same_file(partial_of(output), file));
}

} // namespace

void refuse_special_file(std::string_view option, const std::string& path, OutputKind kind) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(fmt::format("{} {}: found {}, allowed: a file{}", option, one_line(path), what,
                                 kind == OutputKind::text ? ", a pipe or a device" : ""));
  };
  if (path.ends_with('/')) refuse("a folder");
  const auto found = found_at(path);
  if (!found || S_ISREG(found->st_mode)) return;
  if (kind == OutputKind::binary || !is_stream(found->st_mode)) refuse(kind_of(found->st_mode));
}

bool is_hdf5(const std::string& path) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::array<char, signature.size()> begin{};
  std::ifstream file(path, std::ios::binary);
  return file.read(begin.data(), begin.size()) && std::string_view(begin.data(), begin.size()) == signature;
}

namespace {

/// Whether a regular file that is not empty is there.
bool has_content(const std::string& path) {
  const auto found = found_at(path);
  return found && S_ISREG(found->st_mode) && found->st_size > 0;
}

/// What an output of this kind would replace and must not; empty if it may be written there. Most inputs are TOML.
std::string other_kind_at(const std::string& path, OutputKind kind) {
  if (!has_content(path)) return {};
  if (path.ends_with(".toml")) return "a TOML file (a scenario, a description or a figure)";
  return kind == OutputKind::text && is_hdf5(path) ? "an HDF5 file (a run, a checkpoint or a packing) by text" : "";
}

} // namespace

void check_output_path(std::string_view option, const std::string& path, OutputKind kind) {
  if (path.empty()) throw InputError(fmt::format("{}: found an empty name, allowed: a file", option));
  refuse_special_file(option, path, kind);
  if (const std::string other = other_kind_at(path, kind); !other.empty())
    throw InputError(fmt::format("{} {}: would replace {}, allowed: another name", option, one_line(path), other));
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder_of(output_target(path)), ignored))
    throw InputError(
        fmt::format("{} {}: the folder does not exist, allowed: a file in an existing folder", option, one_line(path)));
}

namespace {

/// ".png" of "run.png" and "run.png.partial".
std::string ending_of(const std::string& path) {
  std::filesystem::path name = path;
  if (name.extension() == ".partial") name = name.stem();
  return name.extension().string();
}

} // namespace

void refuse_ending_of_other_format(std::string_view option, const std::string& path,
                                   const std::vector<std::string>& endings) {
  constexpr std::array known = {".csv", ".json", ".html", ".md",  ".toml", ".png", ".svg",
                                ".jpg", ".jpeg", ".pdf",  ".vtu", ".pvd",  ".h5",  ".stl"};
  std::string ending = ending_of(path);
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (std::find(known.begin(), known.end(), ending) != known.end()) refuse_other_endings(option, path, endings);
}

void refuse_other_endings(std::string_view option, const std::string& path, const std::vector<std::string>& endings) {
  const std::string ending = ending_of(path);
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  throw InputError(fmt::format("{} {}: found {}, allowed: {}", option, one_line(path),
                               ending.empty() ? "no ending" : fmt::format("the ending '{}'", one_line(ending)),
                               fmt::join(endings, " or ")));
}

bool same_file(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code ignored;
  if (std::filesystem::exists(a, ignored)) return std::filesystem::equivalent(a, b, ignored);
  return std::filesystem::weakly_canonical(output_target(a), ignored) ==
         std::filesystem::weakly_canonical(output_target(b), ignored);
}

void refuse_overwriting(std::string_view option, const std::string& output, const std::string& input) {
  if (replaces(output, input))
    throw InputError(fmt::format("{} {}: would overwrite the input {}, allowed: another file", option, one_line(output),
                                 one_line(input)));
}

void refuse_shared_names(const std::vector<NamedOutput>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (replaces(outputs[i].path, outputs[k].path) || replaces(outputs[k].path, outputs[i].path))
        throw InputError(fmt::format("{} {}: would overwrite the output of {}, allowed: another file",
                                     outputs[i].option, one_line(outputs[i].path), outputs[k].option));
}

std::string output_target(const std::string& path) {
  std::filesystem::path target = path;
  std::error_code error;
  constexpr int most_links = 40; // as many as Linux follows
  for (int i = 0; i < most_links && std::filesystem::is_symlink(target, error); ++i) {
    const auto next = std::filesystem::read_symlink(target, error);
    if (error) break;
    target = target.parent_path() / next; // an absolute `next` replaces all of it
  }
  return target.string();
}

void remove_stale_partial(const std::string& partial) {
  if (unlink(partial.c_str()) != 0 && errno != ENOENT)
    throw StorageError(fmt::format("{}: cannot be replaced: {}", one_line(partial), std::strerror(errno)));
}

void try_output(const std::string& path) {
  const auto found = found_at(path);
  if (found && (is_stream(found->st_mode) || is_standard_output(*found))) return;
  const std::string partial = partial_of(path);
  std::error_code ignored;
  if (std::filesystem::is_directory(std::filesystem::symlink_status(partial, ignored)))
    throw StorageError(fmt::format("{}: cannot be replaced: {}", one_line(partial), std::strerror(EISDIR)));
  // Not the partial file itself: it may hold a complete text that could not take its name (see replace_file).
  const std::string target = output_target(path), trial = target + ".attempt"; // as long as ".partial"
  const int file = open(trial.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  // Another program tries the same, or one was killed while it did.
  if (file < 0 && errno == EEXIST && access(folder_of(target).c_str(), W_OK | X_OK) == 0) return;
  if (file < 0) throw StorageError(fmt::format("{}: cannot be written: {}", one_line(path), std::strerror(errno)));
  close(file);
  unlink(trial.c_str());
}

void replace_file(const std::string& partial, const std::string& path) {
  const auto check = [&](bool good, const char* what) {
    if (!good)
      throw StorageError(fmt::format("{}: the complete file {} could not be {}: {}", one_line(path), one_line(partial),
                                     what, std::strerror(errno)));
  };
  check(reaches_disk(partial), "written to disk");
  check(std::rename(partial.c_str(), path.c_str()) == 0, "renamed");
  // The file is complete under its name: if the folder cannot be read, no more can be done.
  reaches_disk(folder_of(path));
}

TextFile::TextFile(const std::string& path) : path_(path), target_(path) {
  const auto found = found_at(path);
  if (found && is_standard_output(*found)) {
    std::fflush(stdout);
    file_ = dup(STDOUT_FILENO);
  } else if (found && is_stream(found->st_mode)) {
    file_ = open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  } else {
    target_ = output_target(path);
    partial_ = partial_of(path);
    remove_stale_partial(partial_);
    file_ = open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  }
  if (file_ < 0) fail();
}

TextFile::~TextFile() {
  if (file_ >= 0) close(file_);
  if (!complete_ && !partial_.empty()) unlink(partial_.c_str());
}

void TextFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void TextFile::complete() {
  if (close(std::exchange(file_, -1)) != 0) fail();
  complete_ = true; // from here on the partial file holds everything, and stays where it cannot become the target
  if (!partial_.empty()) replace_file(partial_, target_);
}

void TextFile::fail() const {
  const int error = errno;
  if (!partial_.empty()) unlink(partial_.c_str());
  throw StorageError(fmt::format("{}: cannot be written: {}", one_line(path_), std::strerror(error)));
}

void write_file(const std::string& path, std::string_view content) {
  TextFile file(path);
  file.write(content);
  file.complete();
}

} // namespace mpfem
