// Tables of points to fit: CSV text -> columns.

#include "common/csv_reader.hpp"
#include "postproc/files/csv_file.hpp"
#include "refusal.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mpfem;
  fuzz::read_or_refuse([&] {
    const auto columns =
        read_csv(CsvReader::from_text(std::string(fuzz::text_of(data, size)), "points.csv"), {{"x"}, {"y", "--y"}});
    if (columns.size() != 2 || columns[0].values.size() != columns[1].values.size()) std::abort();
  });
  return 0;
}
