#include "postproc/figure/shell_words.hpp"

#include <fmt/format.h>
#include <wordexp.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"

namespace mpfem {

std::optional<std::vector<std::string>> shell_words(const std::string& command) {
  if (command.find('$') != std::string::npos) return std::nullopt;
  wordexp_t found{};
  const int code = wordexp(command.c_str(), &found, WRDE_NOCMD);
  if (code == WRDE_SYNTAX)
    throw InputError(fmt::format("found '{}', allowed: quotation marks in pairs", one_line(command)));
  if (code != 0) return std::nullopt;
  std::vector<std::string> words(found.we_wordv, found.we_wordv + found.we_wordc);
  wordfree(&found);
  return words;
}

} // namespace mpfem
