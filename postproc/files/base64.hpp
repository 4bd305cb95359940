#pragma once
// Bytes as text, for HTML pages that embed their pictures and data.

#include <string>
#include <string_view>

namespace mpfem {

/// Base64 of RFC 4648, with padding, without line breaks.
std::string base64(std::string_view bytes);

} // namespace mpfem
