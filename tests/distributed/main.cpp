// Catch2's main for tests that rank 0 of an MPI job runs, with the other ranks serving it.
#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_session.hpp>
#else
#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#endif

#include "contct/distributed/module.hpp"

int main(int argc, char** argv) {
  contct::distributed::ranks& all = contct::distributed::join_ranks({CONTCT_PETSC_MODULE}, CONTCT_VERSION);
  if (all.own() != 0) {
    all.serve();
    return 0;
  }
  const int failed = Catch::Session().run(argc, argv);
  contct::distributed::set_joined_ranks(nullptr);
  all.leave();
  return failed;
}
