// A small problem on a matrix, and its files.
#pragma once

#include "support/scratch_folder.hpp"

namespace contct {

/// A chain of three unit springs, the first of which is attached to the ground.
inline const char* const small_matrix =
    "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 1\n";

inline const char* const good_matrix_problem =
    "[matrix]\n"                                    // 1
    "stiffness = \"K.mtx\"\n"                       // 2
    "dofs = \"K.dof\"\n"                            // 3
    "[[support]]\n"                                 // 4
    "dof = \"a\"\n"                                 // 5
    "spring = 2.0\n"                                // 6
    "[[contact]]\n"                                 // 7
    "dof = \"c\"\n"                                 // 8
    "surface = \"below\"\n"                         // 9
    "face = -0.5\n"                                 // 10
    "stiffness = 10.0\n"                            // 11
    "[[step]]\n"                                    // 12
    "point = [ { dof = \"c\", value = -3.0 } ]\n";  // 13

// Other correct files of a matrix.
inline const char* const small_vector = "%%MatrixMarket matrix array real general\n3 1\n1\n0\n-2.5\n";
inline const char* const small_sparse_vector =
    "%%MatrixMarket matrix coordinate real general\n3 1 2\n3 1 -2.5\n1 1 1\n";
inline const char* const small_job = "1 1  4.0000000000000e+00\n1 2  0.0000000000000e+00\n2 2  1.5e+00\n";
inline const char* const small_places = "# the frame\n\na 0 0 # foot\nb\t1.5 -2e-3\n";
inline const char* const small_mesh = "*NODE\n1,1,0,0\n2,2,0,0\n3,3,0,0\n4,4,0,0\n";

/// Writes the files of `good_matrix_problem`, and files of which a changed problem may name one.
inline void write_matrix_files(const scratch_folder& to) {
  (void)to.write("K.mtx", small_matrix);
  (void)to.write("K.dof", "a\nb\nc\n");
  (void)to.write("f.mtx", "%%MatrixMarket matrix array real general\n3 1\n0\n1\n-2\n");
  (void)to.write("indefinite.mtx",
                 "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 2\n2 2 1\n");
  (void)to.write("K.xyz", "a 0 0\n");
  (void)to.write("two.dof", "a\nb\n");
  (void)to.write("two.mtx", "%%MatrixMarket matrix array real general\n2 1\n1\n1\n");
  (void)to.write("numbers.dof", "185.1\n185.2\n212.3\n");
  // Jobs of CalculiX, with different meshes:
  const std::string mesh =
      "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,9,9,9\n*ELEMENT,TYPE=C3D4\n1,1,2,3,4\n";
  for (const auto& [job, inp] : {std::pair<std::string, std::string>("bare", ""),
                                 {"solid", mesh},
                                 {"foreign", "*NODE\n8,0,0,0\n"},
                                 {"wrong", "*NODE\n2,0,0,x\n"}}) {
    (void)to.write(job + ".sti", "1 1 2\n1 2 -1\n2 2 2\n");
    (void)to.write(job + ".dof", "2.3\n3.3\n");
    if (!inp.empty()) (void)to.write(job + ".inp", inp);
  }
}

}  // namespace contct
