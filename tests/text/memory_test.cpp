// Tests the description of amounts of memory.
#include "contct/text/memory.hpp"

#include "catch.hpp"

using namespace contct;

TEST_CASE("an amount of memory is written in MiB or GiB with few digits") {
  CHECK(bytes_words(1 << 19) == "0.5 MiB");
  CHECK(bytes_words(std::int64_t{20} << 20) == "20 MiB");
  CHECK(bytes_words(std::int64_t{3} << 29) == "1.5 GiB");
  CHECK(memory_limit() > 0);
}
