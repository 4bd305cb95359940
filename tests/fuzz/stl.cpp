// STL files: bytes -> closed surface.

#include "surfaces/stl.hpp"
#include "refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mpfem;
  fuzz::read_or_refuse([&] {
    const StlBody body = stl_body(fuzz::text_of(data, size), "tool.stl", 1);
    if (!pair_edges(body.mesh).closed() || !(body.findings.volume > 0)) std::abort();
  });
  return 0;
}
