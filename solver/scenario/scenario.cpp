#include "solver/scenario/scenario.hpp"

#include <algorithm>

namespace mpfem {

double usual_own_pressure(ElementType element) {
  // This small share keeps the tets of a patch from collapsing into each other (studies/nodal-pressure).
  return element == ElementType::tet4_patch ? 0.03 : 0.0;
}

const char* element_name(ElementType element) {
  switch (element) {
  case ElementType::tet4:
    return "tet4";
  case ElementType::tet4_anp:
    return "tet4-anp";
  case ElementType::tet4_patch:
    return "tet4-patch";
  }
  return "";
}

const char* precision_name(Precision precision) {
  return precision == Precision::mixed ? "mixed" : "double";
}

bool Scenario::has_friction() const {
  return contact.has_friction() || wall_friction > 0 ||
         std::any_of(tools.begin(), tools.end(), [](const ToolParameters& tool) { return tool.friction > 0; });
}

} // namespace mpfem
