// The reader of PETSc's binary of a matrix: what it reads, written again, is the same matrix.
#include "contct/read/matrix_files.hpp"
#include "contct/read/petsc_matrix.hpp"
#include "contct/write/matrix_output.hpp"
#include "fuzz/sound_matrix.hpp"
#include "support/equal_matrices.hpp"

namespace {

using namespace contct::fuzz;
using namespace contct::read;
using namespace contct::write;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sparse_matrix read;
  if (!is_read([&] { read = parse_petsc_matrix(text_of(data, size), "k.petsc"); })) return 0;
  require_sound(read);
  std::string bytes;
  output_file of_bytes(&bytes);
  (void)write_petsc_matrix(read, of_bytes);
  require(is_petsc_matrix(bytes) && is_read([&] {
            require(contct::matrix::equal(parse_stiffness(bytes, "again.petsc"), read),
                    "the same matrix in PETSc's binary");
          }),
          "a matrix that was written in PETSc's binary is read");
  std::string text;
  output_file of_text(&text);
  (void)write_matrix_market(read, of_text);
  require(is_read([&] {
            require(contct::matrix::equal(parse_stiffness(text, "again.mtx"), read), "the same matrix", text);
          }),
          "a matrix that was written in Matrix Market is read", text);
  return 0;
}
