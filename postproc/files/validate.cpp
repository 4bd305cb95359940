#include "postproc/files/validate.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/one_line.hpp"
#include "results-schema/file.hpp"
#include "results-schema/seal.hpp"

namespace mpfem {

Verdict verdict_on(const std::string& path) {
  const std::string name = one_line(path);
  Verdict verdict;
  try {
    const schema::Validation found = schema::validate(path);
    for (const std::string& finding : found.findings) verdict.text += fmt::format("{}: {}\n", name, finding);
    verdict.valid = found.findings.empty();
    if (verdict.valid)
      verdict.text = fmt::format("{}: valid ({}, schema {})\n", name, found.kind, schema::schema_version);
    if (!found.checked)
      verdict.text += fmt::format("{}: note: has no checksums (written by an earlier version or another program): "
                                  "damage to its values cannot be detected\n",
                                  name);
    else if (verdict.valid && schema::check_seal(path) == schema::Seal::absent)
      verdict.text +=
          fmt::format("{}: note: has no seal: its end was cut off, or another program copied it; its datasets "
                      "are complete and match their checksums\n",
                      name);
  } catch (const InputError& error) { // its message begins with the file's name
    verdict.text += fmt::format("{}\n", error.what());
  }
  return verdict;
}

} // namespace mpfem
