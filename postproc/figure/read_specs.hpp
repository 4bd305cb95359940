#pragma once
// The tables of a figure's file, each as what it declares. All throw InputError with the place of a mistake. Keys that
// they do not read are refused by for_each, or by themselves where they take the table alone.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "postproc/figure/figure_texts.hpp"

namespace mpfem {

RunTemplate read_packing(TableReader& table);

/// The programme is a file of `folder`, or the name of one in the folder `programmes`.
RunTemplate read_run(TableReader& table, const std::filesystem::path& folder, const std::string& programmes);

CaseBlock read_case(Texts& t);

/// Lists of columns from [columns], by name.
using ColumnLists = std::map<std::string, std::vector<std::string>>;

/// `lists` stand for their columns where a table names them.
TableSpec read_table(Texts& t, const ColumnLists& lists);

/// A table from a CSV file: next to the figure's file if it exists there, otherwise among the figure's results, where a
/// script makes it.
TableSpec read_table_of_file(Texts& t, const std::filesystem::path& folder);

FitSpec read_fit(Texts& t);
PlotSpec read_plot(Texts& t);
PictureSpec read_picture(Texts& t);
ScriptSpec read_script(Texts& t); ///< without a run where none is named
StatementSpec read_statement(Texts& t);

} // namespace mpfem
