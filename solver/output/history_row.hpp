#pragma once
// One line of the history. Its members are the columns of /history in results-schema/schema.toml, from which they are
// generated.

#include "results-schema/descriptors.hpp"

namespace mpfem {

using HistoryRow = schema::run::HistoryRow;

} // namespace mpfem
