// Whole files as text, and what is refused of them.
#include "contct/text/input_text.hpp"

#include <filesystem>

#include "catch.hpp"
#include "support/scratch_folder.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

TEST_CASE("a file is read to its last byte, whatever its bytes are") {
  const scratch_folder here;
  CHECK(read_input(here.write("empty", "")).empty());
  std::string all;
  for (int i = 0; i < 200'000; ++i) all += static_cast<char>(i % 256);  // more than one block
  CHECK(read_input(here.write("all", all)) == all);
}

TEST_CASE("a file that is not there, a folder, and a file that is too large are refused by name") {
  const scratch_folder here;
  CHECK_THROWS_WITH(read_input(here.at("none")), Contains("none: cannot be read: No such file"));
  CHECK_THROWS_WITH(read_input(here.path().string(), "mesh"),
                    Contains(": found a directory; allowed: a mesh"));
  const std::string large = here.write("large", "");
  std::filesystem::resize_file(large, (1 << 20) - 1);
  CHECK(read_input(large, "mesh", 1).size() == (1 << 20) - 1);
  std::filesystem::resize_file(large, 1 << 20);
  CHECK_THROWS_WITH(read_input(large, "mesh", 1),
                    Contains("large: found 1 MiB or more; allowed: a mesh below that size"));
}

TEST_CASE("a refusal names the file and the line, or the file alone") {
  CHECK_THROWS_WITH(refuse_line("K.mtx", 12, "x", "y"), "K.mtx:12: found x; allowed: y");
  CHECK_THROWS_WITH(refuse_line("K.mtx", 0, "x", "y"), "K.mtx: found x; allowed: y");
  CHECK_THROWS_AS(refuse_line("K.mtx", 1, "", ""), input_error);
}
