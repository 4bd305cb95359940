#include "common/one_line.hpp"

#include <fmt/format.h>

namespace mpfem {

namespace {

bool continues(unsigned char byte) {
  return (byte & 0xC0U) == 0x80U;
}

/// Bytes of the UTF-8 character that begins the text; 0 if there is none.
std::size_t character_size(std::string_view text) {
  const auto first = static_cast<unsigned char>(text[0]);
  const std::size_t size = first < 0x80   ? 1
                           : first < 0xC2 ? 0
                           : first < 0xE0 ? 2
                           : first < 0xF0 ? 3
                           : first < 0xF5 ? 4
                                          : 0;
  if (size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i)
    if (!continues(static_cast<unsigned char>(text[i]))) return 0;
  return size;
}

/// U+0080 … U+009F control terminals, as characters below U+0020 do.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  return first < 0x20 || first == 0x7f || (first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0);
}

} // namespace

std::string one_line(std::string_view text) {
  std::string line;
  line.reserve(text.size());
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const std::string_view character = text.substr(0, size == 0 ? 1 : size);
    text.remove_prefix(character.size());
    if (character == "\n") {
      line += "\\n";
    } else if (character == "\t") {
      line += "\\t";
    } else if (size == 0 || is_control(character)) {
      for (const char byte : character) line += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    } else {
      line += character;
    }
  }
  return line;
}

std::string_view first_characters(std::string_view text, std::size_t most) {
  std::size_t size = 0, characters = 0;
  for (; size < text.size(); ++size) {
    if (continues(static_cast<unsigned char>(text[size]))) continue;
    if (characters == most) break;
    ++characters;
  }
  return text.substr(0, size);
}

std::string shortened(std::string_view text, std::size_t longest) {
  // Enough of both ends: an escape has four characters for a byte, a character has at most four bytes.
  const std::size_t enough = 4 * longest + 4;
  std::string line = text.size() <= 2 * enough
                         ? one_line(text)
                         : one_line(text.substr(0, enough)) + one_line(text.substr(text.size() - enough));
  std::size_t count = 0;
  for (const char byte : line) count += !continues(static_cast<unsigned char>(byte));
  if (count <= longest) return line;
  const std::size_t before = (longest - 1) / 2, after = longest - 1 - before;
  std::size_t begin = 0, end = line.size();
  for (std::size_t seen = 0; seen < before + 1; ++begin)
    if (!continues(static_cast<unsigned char>(line[begin])) && ++seen > before) break;
  for (std::size_t seen = 0; seen < after;)
    if (!continues(static_cast<unsigned char>(line[--end]))) ++seen;
  return line.substr(0, begin) + "…" + line.substr(end);
}

std::string shown_path(std::string_view path) {
  constexpr std::size_t longest = 120;
  return shortened(path, longest);
}

} // namespace mpfem
