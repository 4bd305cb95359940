#pragma once
// Malformed TOML documents, made from a good one.

#include <string>
#include <vector>

namespace mpfem::test {

/// A document and what its refusal must name.
struct MalformedText {
  std::string what; ///< for the report of the test
  std::string text;
  std::vector<std::string> names;
};

/// Every value of the document replaced by each of several that no key takes (not finite, far too large, another type),
/// and every key misspelled. A refusal names the key and its line.
std::vector<MalformedText> spoilt_documents(const std::string& good);

/// Texts that are no document for anybody: no TOML at all, nested too deep, far too long keys, bytes that are no text.
std::vector<MalformedText> hopeless_documents();

} // namespace mpfem::test
