#pragma once
// A figure's statements, judged by its tables and fits.

#include "postproc/figure/figure_fits.hpp"

namespace mpfem {

/// The tables and fits of one figure, each read when first needed. Members throw InputError where a file is missing.
class FigureData {
public:
  FigureData(const Figure& figure, std::string folder) : figure_(figure), folder_(std::move(folder)) {}
  const Figure& figure() const { return figure_; }
  const TextTable& table(const std::string& name);
  const nlohmann::ordered_json& fit(const std::string& name);
  bool has_table(const std::string& name) const;

private:
  const Figure& figure_;
  std::string folder_;
  std::map<std::string, TextTable> tables_;
  std::optional<nlohmann::ordered_json> fits_;
};

/// The value of a statement's quantity.
struct Quantity {
  Value value;                                   ///< empty where it is not known
  std::optional<std::array<double, 2>> interval; ///< 95 % interval of a fit's coefficient
  std::string row;                               ///< first cell of the row from which it was taken; may be empty
};

/// The quantities of a statement by name. Throws InputError: names, columns and coefficients that do not exist, "only"
/// with several rows.
std::map<std::string, Quantity> quantities_of(const StatementSpec& statement, FigureData& data);

/// Throws InputError where a text of the statement names what is no quantity, or has a format that does not suit it.
void check_texts(const StatementSpec& statement);

/// True if a condition holds; empty where a quantity that it needs is not known, or where no two rows can be compared.
std::optional<bool> holds(const ConditionSpec& condition, const StatementSpec& statement,
                          const std::map<std::string, Quantity>& quantities, FigureData& data);

/// {statement, paper, ours, agrees, note}, and `why` where it differs and the figure gives a reason. `agrees` is null
/// where the statement is not judged: it requires nothing, a condition of judged_if does not hold, a quantity is not
/// known, it can only be refuted and is not, or the figure gives no verdict for this case.
nlohmann::ordered_json judge(const StatementSpec& statement, FigureData& data);

/// JSON list of all statements for a mesh, one object per line.
std::string verdict_text(FigureData& data, const std::string& mesh);

} // namespace mpfem
