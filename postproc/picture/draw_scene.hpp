#pragma once
// Draws a scene with VTK, as PNG.

#include <string>

#include "postproc/picture/view_frame.hpp"

namespace mpfem {

/// Writes the PNG; the picture shows all of `shown`. Throws SimulationError where nothing can be drawn, StorageError
/// where the file cannot be written.
void draw_scene(const std::string& path, const PictureScene& scene, const ShownBox& shown, const PictureSize& size);

} // namespace mpfem
