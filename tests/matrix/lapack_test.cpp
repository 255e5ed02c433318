#include "contct/matrix/lapack.hpp"

#include "catch.hpp"

using namespace contct::app;

TEST_CASE("LAPACK is identified by its version and the library that holds dpbtrf") {
  const std::string identity = lapack_identity();
  CHECK(identity.rfind("LAPACK 3.", 0) == 0);
  const std::size_t comma = identity.find(", ");
  REQUIRE(comma != std::string::npos);
  CHECK(identity.find('/') == std::string::npos);  // its folder is left out
  CHECK(identity.size() > comma + 2);
}
