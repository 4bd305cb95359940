#pragma once
// A figure's plots, drawn by gnuplot.

#include "postproc/figure/verdict.hpp"

namespace mpfem {

/// Results of the same figure with other settings.
struct OtherResults {
  std::string name; ///< for the key of the plot
  FigureData data;
};

/// The gnuplot script that draws a plot as "png" or "svg" into `image`. `packings`: the number of packings whose spread
/// (TABLE.spread.csv) is drawn for the series that request it; 0 for none. `beside`: results whose tables are drawn as
/// well, as far as they have them and their columns, dashed and with hollow points, or none; their
/// errors, fits and surfaces are not. Throws InputError: columns and rows that do not exist.
std::string plot_script(const PlotSpec& plot, FigureData& data, const std::string& folder, const std::string& format,
                        const std::string& image, int packings, OtherResults* beside = nullptr);

} // namespace mpfem
