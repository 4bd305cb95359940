#include "common/version.hpp"

namespace mpfem {

std::string_view version() {
  return MPFEM_VERSION;
}

} // namespace mpfem
