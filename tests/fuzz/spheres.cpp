// Tables of spheres: CSV text -> import_spheres, with its check for overlaps.

#include "common/csv_reader.hpp"
#include "pack-gen/sphere_import.hpp"
#include "refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mpfem;
  fuzz::read_or_refuse([&] {
    const ImportedSpheres spheres =
        import_spheres(CsvReader::from_text(std::string(fuzz::text_of(data, size)), "spheres.csv"), std::nullopt);
    refuse_overlap(spheres, "spheres.csv");
    for (const double length : spheres.packing.box)
      if (!(length > 0 && length < 1e12)) std::abort();
  });
  return 0;
}
