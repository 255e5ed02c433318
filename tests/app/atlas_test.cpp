// contct atlas, as a person at the terminal meets it.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

using words = std::vector<std::string>;

/// Refused: exit 2, nothing printed, no file made.
std::string refusal(const words& arguments, const scratch_folder& dir) {
  const auto before = dir.files();
  const finished f = contct_program(dir.path(), arguments);
  INFO(f.out << f.err);
  CHECK(f.exit == 2);
  CHECK(f.out.empty());
  CHECK(dir.files() == before);
  return f.err;
}

}  // namespace

TEST_CASE("the same seed draws the same atlas, and table, CSV and JSON agree") {
  const scratch_folder dir;
  const words asked = {"atlas", "--problems", "3", "--seed", "7", "--csv", "a.csv", "--json", "a.json"};
  const finished first = contct_program(dir.path(), asked);
  INFO(first.out << first.err);
  CHECK(first.exit == 0);
  CHECK(first.err.empty());  // no terminal, no progress
  CHECK(dir.files() == words{"a.csv", "a.json"});
  const std::string csv = dir.read("a.csv");
  const std::string json = dir.read("a.json");
  const finished again = contct_program(dir.path(), asked);
  CHECK(again.out == first.out);
  CHECK(dir.read("a.csv") == csv);
  CHECK(dir.read("a.json") == json);

  const auto cells = nlohmann::json::parse(json)["cells"];
  CHECK(cells.size() == 106);
  CHECK(std::count(csv.begin(), csv.end(), '\n') == 107);
  int tried = 0;
  int wrong = 0;
  for (const auto& cell : cells) {
    tried += cell["problems"].get<int>();
    wrong += cell["wrong"].get<int>();
    if (cell["kernel"] == "corrected") CHECK(cell["uncertified"] == 0);
  }
  CHECK(tried == 3 * 106);
  CHECK(wrong > 20);
  CHECK_THAT(first.out,
             Contains("3 random problems a cell, seed 7") && Contains("1e-12  corrected      3   0.0"));
  CHECK(contct_program(dir.path(), {"atlas", "--problems", "3", "--seed", "8"}).out != first.out);
}

TEST_CASE("the atlas is the same to the byte with one job and with three") {
  const scratch_folder dir;
  std::vector<std::string> expected;
  for (const char* jobs : {"1", "3"}) {
    const finished f = contct_program(
        dir.path(), {"atlas", "--problems", "18", "--csv", "a.csv", "--json", "a.json", "--jobs", jobs});
    CHECK(f.exit == 0);
    const std::vector<std::string> found = {f.out, dir.read("a.csv"), dir.read("a.json")};
    if (expected.empty()) expected = found;
    CHECK(found == expected);
  }
}

TEST_CASE("an output of the atlas may be standard output, alone") {
  const scratch_folder dir;
  const finished f = contct_program(dir.path(), {"atlas", "--problems", "1", "--json", "-"});
  CHECK(f.exit == 0);
  CHECK(nlohmann::json::parse(f.out)["problems"] == 1);
  CHECK_THAT(refusal({"atlas", "--problems", "1", "--json", "-", "--csv", "-"}, dir),
             Contains("--csv and --json cannot both be -"));
}

TEST_CASE("bad usage of the atlas exits 2 before anything is tried") {
  const scratch_folder dir;
  dir.write("a.json", "mine");
  CHECK_THAT(refusal({"atlas", "--problems", "0"}, dir), Contains("--problems"));
  CHECK_THAT(refusal({"atlas", "--problems", "many"}, dir), Contains("--problems"));
  CHECK_THAT(refusal({"atlas", "--seed", "-1"}, dir), Contains("--seed"));
  CHECK_THAT(refusal({"atlas", "--shard", "1/2"}, dir), Contains("--shard"));
  CHECK_THAT(refusal({"atlas", "file.toml"}, dir), Contains("file.toml"));
  CHECK_THAT(refusal({"atlas", "--csv", "a", "--json", "./a"}, dir), Contains("found the file of --csv"));
  CHECK_THAT(refusal({"atlas", "--csv", "nowhere/a"}, dir), Contains("nowhere/a"));
  CHECK(dir.read("a.json") == "mine");
}

TEST_CASE("when standard output fails, the atlas leaves no files") {
  const scratch_folder dir;
  const finished f = contct_program(dir.path(), {"atlas", "--problems", "1", "--csv", "a.csv"},
                                    {"", {}, false, "/dev/full"});
  CHECK(f.exit == 2);
  CHECK_THAT(f.err, Contains("standard output: "));
  CHECK(dir.files().empty());
}

TEST_CASE("the copies of the listing that the atlas uses are no kernels to run") {
  const scratch_folder dir;
  CHECK_THAT(contct_program(dir.path(), {"kernels"}).out, !Contains("EPSMUL"));
  for (const char* name : {"fortran with EPSMUL 1e-09", "epsmul", "fortran-1e-9"}) {
    const finished f = contct_program(dir.path(), {"run", "none.toml", "--kernels", name});
    CHECK(f.exit == 2);
    CHECK_THAT(f.err, Contains("no kernel is named"));
  }
}
