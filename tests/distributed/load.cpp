// load IN OUT: PETSc itself reads a matrix from its binary file, and writes it to another one.
#include <petscmat.h>

int main(int argc, char** argv) {
  Mat a = nullptr;
  PetscViewer file = nullptr;
  PetscCall(PetscInitialize(&argc, &argv, nullptr, nullptr));
  PetscCall(PetscViewerBinaryOpen(PETSC_COMM_WORLD, argv[1], FILE_MODE_READ, &file));
  PetscCall(MatCreate(PETSC_COMM_WORLD, &a));
  PetscCall(MatSetType(a, MATAIJ));
  PetscCall(MatLoad(a, file));
  PetscCall(PetscViewerDestroy(&file));
  PetscCall(PetscViewerBinaryOpen(PETSC_COMM_WORLD, argv[2], FILE_MODE_WRITE, &file));
  PetscCall(MatView(a, file));
  PetscCall(PetscViewerDestroy(&file));
  PetscCall(MatDestroy(&a));
  PetscCall(PetscFinalize());
  return 0;
}
