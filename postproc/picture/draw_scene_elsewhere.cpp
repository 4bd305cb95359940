// What postproc has in place of draw_scene.cpp: it knows the options of `picture` for --help, and draws nothing itself.

#include <stdexcept>

#include "postproc/picture/draw_scene.hpp"

namespace mpfem {

void draw_scene(const std::string& /*path*/, const PictureScene& /*scene*/, const ShownBox& /*shown*/,
                const PictureSize& /*size*/) {
  throw std::logic_error("found a call of draw_scene in postproc, allowed: in postproc-picture");
}

} // namespace mpfem
