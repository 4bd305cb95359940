// Descriptions of packings: TOML text -> read_packing_description, and the sizes of up to a thousand spheres.

#include "pack-gen/packing_description.hpp"
#include "refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mpfem;
  constexpr int most_spheres = 1000; // for speed
  fuzz::read_or_refuse([&] {
    const auto description =
        read_packing_description(TomlDocument::from_text(fuzz::text_of(data, size), "powder.toml"));
    if (description.count > most_spheres) return;
    for (const double radius : draw_sizes(description).radius)
      if (!(radius > 0 && radius < 1e12)) std::abort();
  });
  return 0;
}
