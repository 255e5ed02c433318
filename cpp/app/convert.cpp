// contct convert: a stiffness matrix in the other one of two formats.
#include "app/outputs.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/petsc_matrix.hpp"
#include "contct/text/input_text.hpp"
#include "contct/write/matrix_output.hpp"

namespace contct::app {

exit_status run_command(const convert_options& options) {
  refuse_shared_outputs({{"OUTPUT", options.output}}, {{"INPUT", options.input}});
  output_file file(options.output);
  const std::string name = options.input == "-" ? "standard input" : options.input;
  bool from_petsc = false;
  const sparse_matrix matrix = [&] {
    const std::jthread here = shown_activity("reading " + name, options.quiet);
    const std::string bytes = read_input(options.input, "stiffness matrix", largest_matrix_file);
    from_petsc = is_petsc_matrix(bytes);
    return parse_stiffness(bytes, name);
  }();
  const std::int64_t entries =
      from_petsc ? write_matrix_market(matrix, file) : write_petsc_matrix(matrix, file);
  if (!options.quiet && !file.is_standard_output())
    print_text(fmt::format("{}: {}, {} rows, {} entries {}\n", options.output,
                           from_petsc ? "Matrix Market" : "PETSc's binary", matrix.order, entries,
                           from_petsc ? "of the lower triangle" : "of both triangles"));
  flush_standard_output();
  file.finish();
  return exit_status::solved;
}

}  // namespace contct::app
