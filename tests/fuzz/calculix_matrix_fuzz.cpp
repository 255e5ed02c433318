// Fuzzes the readers of CalculiX's matrix and its labels. An input is JOB.dof, a line =====, and JOB.sti.
#include <cmath>
#include <set>

#include "contct/read/matrix_files.hpp"
#include "fuzz/fuzz.hpp"

namespace {

using namespace contct::fuzz;
using namespace contct;

void check(const assembled& a) {
  require(std::set(a.labels.begin(), a.labels.end()).size() == a.labels.size(), "a label is of one dof");
  for (const matrix_entry& e : a.stiffness.entries) {
    require(e.column >= 0 && e.column <= e.row && e.row < a.dofs(), "an entry is in the lower triangle");
    require(std::isfinite(e.value) && (e.row != e.column || e.value > 0.0), "an entry is a number");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts = parts_of(text_of(data, size), 2);
  assembled a;
  if (!is_read([&] { a.labels = parse_labels(parts[0], "job.dof"); }) || parts.size() < 2) return 0;
  const int rows = static_cast<int>(a.labels.size());
  std::vector<std::string> warnings;
  if (is_read([&] { a.stiffness = parse_calculix_stiffness(parts[1], "job.sti", rows, &warnings); }))
    check(a);
  require(warnings.size() <= 1, "one warning for a file");
  return 0;
}
