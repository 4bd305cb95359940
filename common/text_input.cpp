#include "common/text_input.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

std::string fault_of_input_file(const std::string& path) {
  const auto fault = [&](const std::string& what) { return fmt::format("{}: {}", shown_path(path), what); };
  if (path.find('\0') != std::string::npos) return fault("is not a path: found a zero byte in it, allowed: none");
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::status_known(status)) return fault(fmt::format("cannot be read: {}", error.message()));
  if (!std::filesystem::exists(status)) return fault("no such file");
  if (std::filesystem::is_directory(status)) return fault("is a folder, allowed: a file");
  if (!std::filesystem::is_regular_file(status)) return fault("is a pipe, socket or device, allowed: a file");
  return "";
}

void refuse_irregular_file(const std::string& path) {
  if (const std::string fault = fault_of_input_file(path); !fault.empty()) throw InputError(fault);
}

std::string read_text_file(const std::string& path, std::size_t most_bytes) {
  refuse_irregular_file(path);
  const auto fail = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", shown_path(path), what)); };
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(fmt::format("cannot be read: {}", std::strerror(errno)));
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) fail(fmt::format("cannot be read: {}", error.message()));
  // Files of /proc report a size of zero, so the limit is checked while reading, too.
  std::string text;
  if (size <= most_bytes) text.reserve(static_cast<std::size_t>(size));
  constexpr std::size_t piece = 1 << 16;
  while (file && text.size() <= most_bytes) {
    const std::size_t before = text.size();
    text.resize(before + piece);
    file.read(text.data() + before, piece);
    text.resize(before + static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) fail("cannot be read to its end");
  if (text.size() > most_bytes || size > most_bytes)
    fail(fmt::format("is too large, allowed: up to {} MiB", most_bytes >> 20U));
  return text;
}

} // namespace mpfem
