#pragma once
// A study's [powder] as the description of a packing.

#include "postproc/figure/figure.hpp"

namespace mpfem {

/// The description for pack-gen, to lie in `folder`: names of files are as seen from there. Comments before it hold the
/// size of the elements and a hash of each of these files, so that the text differs where their content does. Empty if
/// the study has no powder. Throws InputError for a file that cannot be read.
std::string powder_text(const Figure& figure, const std::string& folder);

} // namespace mpfem
