// What joins an MPI job refuses; tests/distributed/mpi.py has what it does.
#include "contct/distributed/module.hpp"

#include <cstdlib>

#include "catch.hpp"
#include "support/scratch_folder.hpp"

using namespace contct::distributed;
using Catch::Matchers::Contains;

namespace {

const std::string modules = CONTCT_MODULES;

}  // namespace

TEST_CASE("the module is looked for beside the program and where it is installed") {
  const std::vector<std::string> expected = {"/opt/contct/bin/contct_petsc.so",
                                             "/opt/contct/lib/contct/contct_petsc.so"};
  CHECK(module_places("/opt/contct/bin", "../lib/contct") == expected);
}

TEST_CASE("without a module the message says where it was looked for and how to get it") {
  CHECK_THROWS_WITH(
      join_ranks({"/nowhere/a.so", "/nowhere/b.so"}, "1.0"),
      Contains("found no module /nowhere/a.so or /nowhere/b.so") && Contains("libpetsc-real-dev"));
  CHECK(joined_ranks() == nullptr);
}

TEST_CASE("what cannot be loaded, is another library or of another version is refused") {
  const contct::app::scratch_folder dir;
  CHECK_THROWS_WITH(join_ranks({dir.write("text.so", "no library\n")}, "1.0"),
                    Contains("text.so cannot be loaded") && Contains("libpetsc-real-dev"));
  CHECK_THROWS_WITH(join_ranks({modules + "/no_module.so"}, "1.0"),
                    Contains("found no contct_petsc_version; it is another library"));
  CHECK_THROWS_WITH(join_ranks({modules + "/another_version.so"}, "1.0"),
                    Contains("found a module of version 0.0.1; allowed: that of the program, 1.0"));
  CHECK(joined_ranks() == nullptr);
}

TEST_CASE("the first of the places where there is a module counts") {
  CHECK_THROWS_WITH(
      join_ranks({"/nowhere/a.so", modules + "/another_version.so", modules + "/no_module.so"}, "1.0"),
      Contains("another_version.so"));
}

TEST_CASE("the rank that mpirun gave a process is known before MPI is joined, and 0 without mpirun") {
  CHECK(rank_by_environment() == 0);
  CHECK(setenv("PMI_RANK", "3", 1) == 0);
  CHECK(rank_by_environment() == 3);
  CHECK(setenv("OMPI_COMM_WORLD_RANK", "2", 1) == 0);
  CHECK(rank_by_environment() == 2);
  for (const char* name : {"PMI_RANK", "OMPI_COMM_WORLD_RANK"}) CHECK(unsetenv(name) == 0);
}
