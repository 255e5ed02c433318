// Tests `contct verify --results`, which judges another program's numbers.
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// Returns PB1's first two steps by closed form: w at the tip and the stop's force, with `force` as the force
/// in step 2.
std::string answers(const std::string& force) {
  return R"({ "format": "contct-answers-1", "program": "By hand", "version": "1", "tolerance": 1e-6,
  "problems": { "pb01-cantilever-tip-stop": [
    { "step": 1, "quantity": "w", "node": 3, "value": -0.00266666667 },
    { "step": 1, "quantity": "force", "pair": 1, "value": 0 },
    { "step": 2, "quantity": "w", "node": 3, "value": -0.00483720930 },
    { "step": 2, "quantity": "event", "pair": 1, "change": "make", "value": 0.1 },
    { "step": 2, "quantity": "force", "pair": 1, "value": )" +
         force + " } ] } }";
}

finished judged(const scratch_folder& dir, const std::string& force, const std::string& least) {
  dir.write("theirs.json", answers(force));
  return contct_program(dir.path(),
                        {"verify", "--results", "theirs.json", "--least", least, "--json", "out.json"});
}

}  // namespace

TEST_CASE(
    "contct verify --results counts another program's numbers, and accepts those within the given "
    "tolerance") {
  const scratch_folder dir;
  const finished f = judged(dir, "41.8604651", "5");
  INFO(f.out << f.err);
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("By hand 1: 5 numbers in 1 problems") && Contains("0 failed"));
  CHECK_THAT(f.out, Contains("not given: pb02-beam-over-cantilever, "));
  const auto out = nlohmann::json::parse(dir.read("out.json"));
  CHECK(out["judged"] == 5);
  CHECK(out["problems"][0]["numbers"][2]["exact"] == "-26/5375");
  CHECK(out["problems"][0]["not_given"].size() == 25);
}

TEST_CASE(
    "contct verify --results names a number outside the tolerance and its exact value, with exit status 1") {
  const scratch_folder dir;
  const finished f = judged(dir, "41.8614651", "5");
  CHECK(f.exit == 1);
  CHECK_THAT(f.out, Contains("step 2, force, pair 1: found 41.8614651; exact value 1800/43; error"));
}

TEST_CASE(
    "contct verify --results has exit status 2 for fewer numbers than --least, but writes the requested "
    "files") {
  const scratch_folder dir;
  const finished f = judged(dir, "41.8604651", "6");
  CHECK(f.exit == 2);
  CHECK_THAT(f.err, Contains("theirs.json: found 5 numbers; allowed: 6 or more"));
  CHECK(nlohmann::json::parse(dir.read("out.json"))["failed"] == 0);
}

TEST_CASE("contct verify --results refuses to overwrite the file of results that it reads") {
  const scratch_folder dir;
  dir.write("theirs.json", answers("0"));
  const finished f =
      contct_program(dir.path(), {"verify", "--results", "theirs.json", "--json", "theirs.json"});
  CHECK(f.exit == 2);
  CHECK(dir.read("theirs.json") == answers("0"));
}
