// Fuzzes the readers of Matrix Market matrices and load vectors. A matrix that is written must be read as the
// same matrix.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/read/matrix_files.hpp"
#include "fuzz/fuzz.hpp"

namespace {

using namespace contct::fuzz;
using namespace contct;

void require_sound(const sparse_matrix& m) {
  const matrix_entry* before = nullptr;
  for (const matrix_entry& e : m.entries) {
    require(e.column >= 0 && e.column <= e.row && e.row < m.order, "an entry is in the lower triangle");
    require(std::isfinite(e.value) && e.value != 0.0, "an entry is a number other than 0");
    require(e.row != e.column || e.value > 0.0, "the diagonal is positive");
    require(before == nullptr || std::pair(before->column, before->row) < std::pair(e.column, e.row),
            "entries are in the order of columns and rows");
    before = &e;
  }
}

/// Returns the file of a matrix. Every row has a diagonal entry, even if the entry is 0.
std::string written(const sparse_matrix& m) {
  std::string lines;
  std::vector<char> has_diagonal(m.order, 0);
  for (const matrix_entry& e : m.entries) {
    lines += fmt::format("{} {} {}\n", e.row + 1, e.column + 1, e.value);
    if (e.row == e.column) has_diagonal[e.row] = 1;
  }
  std::size_t count = m.entries.size();
  for (int row = 0; row < m.order; ++row) {
    if (has_diagonal[row] != 0) continue;
    lines += fmt::format("{0} {0} 0\n", row + 1);
    ++count;
  }
  return fmt::format("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n{2}", m.order, count,
                     lines);
}

void check_vector(std::string_view text, int rows) {
  std::vector<double> values;
  std::vector<std::string> warnings;
  if (!is_read([&] { values = parse_vector(text, "f.mtx", rows, &warnings); })) return;
  require(std::ssize(values) == rows, "a vector has a number for each row");
  require(std::ranges::all_of(values, [](double x) { return std::isfinite(x); }), "a load is a number");
  require(warnings.size() <= 1, "one warning for a file");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
  for (const int rows : {1, 3, 33}) check_vector(text, rows);
  sparse_matrix read;
  std::vector<std::string> warnings;
  if (!is_read([&] { read = parse_symmetric(text, "k.mtx", &warnings); })) return 0;
  require_sound(read);
  require(warnings.size() <= 1, "one warning for a file");
  const std::string again = written(read);
  require(is_read([&] {
            warnings.clear();
            require(written(parse_symmetric(again, "again.mtx", &warnings)) == again, "the same matrix",
                    again);
            require(warnings.empty(), "the shortest decimals draw no warning", again);
          }),
          "a matrix that was written is read", again);
  return 0;
}
