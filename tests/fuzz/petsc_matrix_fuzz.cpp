// The reader of PETSc's binary of a matrix: what it reads, written again, is the same matrix.
#include <algorithm>
#include <cmath>

#include "contct/read/matrix_files.hpp"
#include "contct/read/petsc_matrix.hpp"
#include "contct/write/matrix_output.hpp"
#include "fuzz/fuzz.hpp"

namespace {

using namespace contct::fuzz;
using namespace contct::read;
using namespace contct::write;

void check(const sparse_matrix& m) {
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

bool equal(const sparse_matrix& a, const sparse_matrix& b) {
  return a.order == b.order && std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(),
                                          b.entries.end(), [](const matrix_entry& x, const matrix_entry& y) {
                                            return x.row == y.row && x.column == y.column &&
                                                   x.value == y.value;
                                          });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sparse_matrix read;
  if (!is_read([&] { read = parse_petsc_matrix(text_of(data, size), "k.petsc"); })) return 0;
  check(read);
  std::string bytes;
  output_file of_bytes(&bytes);
  (void)write_petsc_matrix(read, of_bytes);
  require(is_petsc_matrix(bytes) && is_read([&] {
            require(equal(parse_stiffness(bytes, "again.petsc"), read), "the same matrix in PETSc's binary");
          }),
          "a matrix that was written in PETSc's binary is read");
  std::string text;
  output_file of_text(&text);
  (void)write_matrix_market(read, of_text);
  require(is_read([&] { require(equal(parse_stiffness(text, "again.mtx"), read), "the same matrix", text); }),
          "a matrix that was written in Matrix Market is read", text);
  return 0;
}
