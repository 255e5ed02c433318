// Tests the page, the tables and the grids of `contct run`.
#include <nlohmann/json.hpp>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/good_problem.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

using words = std::vector<std::string>;

const words all_of_them = {"--html", "o.html", "--csv", "o.csv", "--vtu", "o.vtu"};

words run_of(const words& more) {
  words all = {"run", "pb.toml"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

nlohmann::json data_of(const std::string& page) {
  const std::string before = "id=\"data\">";
  const std::size_t from = page.find(before) + before.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

/// Returns the result without the data that only a page has.
nlohmann::json ends_of(nlohmann::json result) {
  for (const char* more : {"file", "date", "words", "structure", "calls", "calls_made", "log", "log_bytes"})
    CHECK(result.erase(more) == 1);
  for (auto& step : result["steps"]) {
    CHECK(step.erase("load") == 1);
    CHECK(step.erase("largest") == 1);
    for (auto& i : step["increments"]) {
      CHECK(i["load"].erase("words") == 1);
      for (const char* more : {"displacement", "pairs", "reactions", "elements", "extremes"}) i.erase(more);
    }
  }
  return result;
}

/// Returns the number of states that the page's slider can show.
std::size_t states_in(const nlohmann::json& result) {
  std::size_t n = 1;
  for (const auto& step : result["steps"]) {
    for (const auto& i : step["increments"]) n += i.contains("displacement") ? 1 : 0;
    ++n;
  }
  return n;
}

}  // namespace

TEST_CASE(
    "contct run --html --csv --vtu writes the report page, the tables and the grids, and no other files") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const finished f = contct_program(dir.path(), run_of(all_of_them));
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("equal to the bit"));
  CHECK(dir.files() == words{"o.000.vtu", "o.001.vtu", "o.002.vtu", "o.csv", "o.html", "o.pairs.csv", "o.pvd",
                             "o.states.csv", "o.vtu", "pb.toml"});
  CHECK(contct_program(dir.path(), {"run", "pb.toml", "--quiet", "--csv", "e.csv", "--envelope"}).exit == 0);
  CHECK_THAT(dir.read("e.envelope.csv"), Contains("x,w_min,w_min_step,w_max,w_max_step,moment_min"));
}

TEST_CASE(
    "the report page has the result that --json writes, the structure, the states within steps and the "
    "calls") {
  for (const char* file :
       {"pb01-cantilever-tip-stop", "pb07-three-gap-supports", "pp03d-corners-and-settled-stop-n4"}) {
    INFO(file);
    const scratch_folder dir;
    const finished f =
        contct_program(dir.path(), {"run", std::string(CONTCT_ROOT) + "/reference/problems/" + file + ".toml",
                                    "--json", "o.json", "--html", "o.html"});
    REQUIRE(f.exit == 0);
    const auto result = nlohmann::json::parse(dir.read("o.json"));
    const auto data = data_of(dir.read("o.html"));
    CHECK(ends_of(data) == result);
    CHECK(data["calls"].size() == result["lockstep"]["calls"]);
    CHECK(data["structure"]["pairs"].size() == result["steps"][0]["pairs"].size());
    std::size_t increments = 0;
    for (const auto& step : result["steps"]) increments += step["increments"].size();
    CHECK(states_in(data) == 1 + increments);  // the start, and a state for each increment
    for (const auto& step : data["steps"]) {
      for (std::size_t i = 0; i + 1 < step["increments"].size(); ++i) {
        CHECK(step["increments"][i]["displacement"].size() == step["displacement"].size());
        CHECK(step["increments"][i]["elements"].size() == step["elements"].size());
      }
    }
  }
}

TEST_CASE("contct run refuses an output with the name of any file that --html, --csv or --vtu writes") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  for (const words& two : {words{"--html", "out", "--csv", "out"},
                           {"--html", "pb.toml"},
                           {"--csv", "out.csv", "--json", "out.pairs.csv"},
                           {"--csv", "out.csv", "--json", "out.states.csv"},
                           {"--vtu", "out.vtu", "--html", "out.pvd"},
                           {"--vtu", "out.vtu", "--csv", "./out.000.vtu"},
                           {"--vtu", "out.vtu", "--log", "out.119.vtu"},
                           {"--html", "-", "--csv", "-"},
                           {"--vtu", "-"},
                           {"--vtu", "out"}}) {
    INFO(two[0] << " " << two[1]);
    const finished f = contct_program(dir.path(), run_of(two));
    CHECK(f.exit == 2);
    CHECK(f.out.empty());
    CHECK_THAT(f.err, Contains("found") || Contains("cannot both be -"));
    CHECK(dir.files() == words{"pb.toml"});
  }
}

TEST_CASE("if an output has the name -, standard output contains only this output") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  CHECK(contct_program(dir.path(), run_of({"--html", "-"})).out.rfind("<!DOCTYPE html>", 0) == 0);
  const std::string csv = contct_program(dir.path(), run_of({"--csv", "-"})).out;
  CHECK(csv.rfind("step,increment,", 0) == 0);
  CHECK(dir.files() == words{"pb.toml"});  // no table of pairs is written
}

TEST_CASE("the report page has the date of the run, or the date in SOURCE_DATE_EPOCH if this is set") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  process_options o;
  o.environment = {{"SOURCE_DATE_EPOCH", "86460"}};
  const words page = run_of({"--html", "o.html"});
  REQUIRE(contct_program(dir.path(), page, o).exit == 0);
  const std::string first = dir.read("o.html");
  CHECK(data_of(first)["date"] == "1970-01-02 00:01 UTC");
  REQUIRE(contct_program(dir.path(), page, o).exit == 0);
  CHECK(dir.read("o.html") == first);
  REQUIRE(contct_program(dir.path(), page).exit == 0);
  CHECK(data_of(dir.read("o.html"))["date"].get<std::string>().substr(0, 2) == "20");
  for (const char* const wrong : {"today", "-1", "", "253402300800"}) {
    o.environment = {{"SOURCE_DATE_EPOCH", wrong}};
    const finished f = contct_program(dir.path(), page, o);
    CHECK(f.exit == 2);
    CHECK_THAT(f.err, Contains("SOURCE_DATE_EPOCH") && Contains("allowed: seconds since 1970"));
  }
}
