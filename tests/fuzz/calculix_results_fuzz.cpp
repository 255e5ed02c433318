// The reader of what CalculiX prints of nodes, JOB.dat.
#include <algorithm>
#include <cmath>

#include "fuzz/fuzz.hpp"
#include "peer/calculix_results.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace contct::fuzz;
  using namespace contct::app;
  std::vector<calculix_table> tables;
  if (!is_read([&] { tables = parse_calculix_dat(text_of(data, size), "job.dat"); })) return 0;
  for (const calculix_table& t : tables) {
    require(!t.at.empty() && std::isfinite(t.time), "a table has nodes and a time", t.set);
    for (const auto& [node, values] : t.at)
      for (const double x : values) require(std::isfinite(x), "a result is a number", t.set);
    const int first = std::min(t.at.begin()->first, 1'000'000'000);
    std::vector<std::array<double, 3>> values;
    if (is_read([&] { values = values_at_end(tables, t.quantity, t.set, first, 2, "job.dat"); }))
      require(values.size() == 2, "a value for each node", t.set);
  }
  return 0;
}
