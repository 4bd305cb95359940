#pragma once
// The history of a run as columns of numbers, whatever their type in the file.

#include <string>
#include <string_view>
#include <vector>

#include "results-schema/file.hpp"

namespace mpfem {

/// A named column of numbers, one value per row.
struct Column {
  std::string name; ///< as in /history ("tools/upper/force_2"), with _0, _1 … for the components of a row
  std::string unit;
  std::vector<double> values;
};

/// What is done with a history that has numbers that are not finite. Only a run that diverged writes such a row, as
/// its last one.
enum class NotFinite { refused, kept };

/// All columns of /history, in the schema's order; those of rigid tools last.
class HistoryTable {
public:
  /// Throws InputError where the file is no run file or has no rows, a column has more or fewer than the others, or,
  /// unless they are kept, a number is not finite.
  explicit HistoryTable(const schema::FileReader& file, NotFinite not_finite = NotFinite::refused);

  /// The first number that is not finite, "PATH: dataset /history/NAME, row 3: found nan" with rows from 0; empty where
  /// there is none.
  const std::string& not_finite() const { return not_finite_; }
  const std::vector<Column>& columns() const { return columns_; }
  std::size_t rows() const { return columns_.front().values.size(); }
  /// Throws InputError that suggests the nearest name where there is no such column.
  const Column& column(std::string_view name) const;
  bool has(std::string_view name) const; ///< files of earlier versions lack some columns
  const std::vector<double>& operator[](std::string_view name) const { return column(name).values; }
  /// Columns by name, as --columns gives them, where "wall_stress" stands for all of its components. Throws InputError.
  std::vector<const Column*> select(const std::vector<std::string>& names) const;

  /// Volume (mm^3) of the box, or of the container that tools form.
  double container_volume(std::size_t row) const;
  /// Its cross-section normal to z, mm^2.
  double section(std::size_t row) const;

private:
  std::string unknown_column(std::string_view name) const;
  void add_columns(const schema::FileReader& file, const schema::DatasetDescription& line, const std::string& tool);

  std::string path_, not_finite_;
  std::vector<Column> columns_;
};

/// [rows], internal energy (mJ) of the stage that each row belongs to: common/stage_energy.hpp.
std::vector<double> internal_energy(const HistoryTable& history);

} // namespace mpfem
