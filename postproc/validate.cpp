#include "postproc/validate.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "results-schema/file.hpp"

namespace mpfem {

Verdict verdict_on(const std::string& path) {
  const std::string name = one_line(path);
  Verdict verdict;
  try {
    for (const std::string& finding : schema::validate(path)) verdict.text += fmt::format("{}: {}\n", name, finding);
    if (!verdict.text.empty()) return verdict;
    const schema::FileReader file(path);
    verdict.valid = true;
    verdict.text = fmt::format("{}: valid ({}, schema {})\n", name,
                               schema::kinds[static_cast<std::size_t>(file.kind())].name, schema::schema_version);
  } catch (const InputError& error) { // its message begins with the file's name
    verdict.text += fmt::format("{}\n", error.what());
  }
  return verdict;
}

} // namespace mpfem
