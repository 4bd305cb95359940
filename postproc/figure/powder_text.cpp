#include "postproc/figure/powder_text.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "common/hash.hpp"
#include "common/text_input.hpp"

namespace mpfem {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 32U; // more than surfaces have that can be packed

} // namespace

std::string powder_text(const Figure& figure, const std::string& folder) {
  if (figure.powder.empty()) return "";
  std::string hashes, text = figure.powder;
  for (const std::string& file : figure.powder_files) {
    const std::string from_there = std::filesystem::relative(file, folder).string();
    hashes += fmt::format("# {} {}\n", from_there, hash_text(hash_string(read_text_file(file, most_bytes))));
    for (std::size_t at = text.find(file); at != std::string::npos; at = text.find(file, at + from_there.size()))
      text.replace(at, file.size(), from_there);
  }
  return fmt::format("# element_size = {}\n{}{}", figure.element_size, hashes, text);
}

} // namespace mpfem
