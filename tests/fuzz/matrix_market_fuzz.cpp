// The reader of stiffness matrices in Matrix Market files: what it reads, written again, is the same matrix.
#include <fmt/format.h>

#include "contct/read/matrix_files.hpp"
#include "fuzz/sound_matrix.hpp"

namespace {

using namespace contct::fuzz;
using namespace contct::read;

/// Every row has its diagonal in such a file, 0 or not.
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = text_of(data, size);
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
