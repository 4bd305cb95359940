#pragma once
// A scene drawn through VTK, as PNG.

#include <string>

#include "postproc/picture/view_frame.hpp"

namespace mpfem {

/// Writes the PNG; the picture shows all of `shown`. Throws SimulationError where nothing can be drawn, StorageError.
void draw_scene(const std::string& path, const PictureScene& scene, const ShownBox& shown, const PictureSize& size);

} // namespace mpfem
