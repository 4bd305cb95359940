#pragma once
// A figure's plots, drawn by gnuplot.

#include "postproc/figure/verdict.hpp"

namespace mpfem {

/// The gnuplot script that draws a plot as "png" or "svg" into `image`. `packings`: the number of packings whose spread
/// (TABLE.spread.csv) is drawn for the series that request it; 0 for none.
/// Throws InputError: columns and rows that do not exist.
std::string plot_script(const PlotSpec& plot, FigureData& data, const std::string& folder, const std::string& format,
                        const std::string& image, int packings);

} // namespace mpfem
