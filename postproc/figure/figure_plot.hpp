#pragma once
// A figure's plots, drawn by gnuplot: one emitter for all.

#include "postproc/figure/verdict.hpp"

namespace mpfem {

/// The script that draws a plot as "png" or "svg" into `image`. `spread`: the number of packings whose spread
/// (TABLE.spread.csv) is drawn where a series says so; 0 for none.
/// Throws InputError: columns and rows that do not exist.
std::string plot_script(const PlotSpec& plot, FigureData& data, const std::string& folder, const std::string& format,
                        const std::string& image, int packings);

} // namespace mpfem
