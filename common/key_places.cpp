#include "common/key_places.hpp"

namespace mpfem {

std::string KeyPlaces::prefix(const std::string& key) const {
  const auto found = keys_.find(key);
  const std::string& place = found == keys_.end() ? table_ : found->second;
  return place.empty() ? "" : place + ": ";
}

} // namespace mpfem
