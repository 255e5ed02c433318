// The reader of load vectors in Matrix Market files.
#include <algorithm>
#include <cmath>

#include "contct/read/matrix_files.hpp"
#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contct::fuzz;
  using namespace contct::read;
  const std::string_view text = text_of(data, size);
  for (const int rows : {1, 3, 33}) {
    std::vector<double> values;
    std::vector<std::string> warnings;
    if (!is_read([&] { values = parse_vector(text, "f.mtx", rows, &warnings); })) continue;
    require(std::ssize(values) == rows, "a vector has a number for each row");
    require(std::ranges::all_of(values, [](double x) { return std::isfinite(x); }), "a load is a number");
    require(warnings.size() <= 1, "one warning for a file");
  }
  return 0;
}
