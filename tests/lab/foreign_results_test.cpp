// Tests the judgement of another program's numbers by a small table.
#include "contct/lab/foreign_results.hpp"

#include "catch.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using Catch::Matchers::WithinRel;

namespace {

expected_number number(std::string quantity, std::string exact, int node = 0, int pair = 0) {
  expected_number e;
  e.step = 1;
  e.quantity = std::move(quantity);
  e.exact = std::move(exact);
  e.node = node;
  e.pair = pair;
  return e;
}

/// Returns a table of two problems. The first has two deflections, one of them twice, two contact forces, the
/// state of a pair, and a number of contacts.
std::vector<verification_case> small_table() {
  expected_number state = number("state", "separated", 0, 2);
  state.value = separated;
  return {{"p.toml",
           {number("w", "-1/4", 1), number("w", "-1/4", 1), number("w", "0", 2), number("force", "8", 0, 1),
            number("force", "0", 0, 2), state, number("contacts", "1")}},
          {"other.toml", {number("w", "1", 1)}}};
}

foreign_results judged(const std::string& entries, const std::string& tolerance = "1e-3") {
  const scratch_folder here;
  const std::string file = here.write(
      "f.json",
      "{ \"format\": \"contct-answers-1\", \"program\": \"P\", \"version\": \"1\", \"tolerance\": " +
          tolerance + ",\n \"problems\": {\n" + entries + "} }");
  return judge_results(file, small_table());
}

/// Returns the message, without the file's folder, that refuses a file with these entries, or "accepted".
std::string refused(const std::string& entries, const std::string& tolerance = "1e-3") {
  std::string said = "accepted";
  try {
    (void)judged(entries, tolerance);
  } catch (const input_error& e) {
    said = e.what();
  }
  return said.substr(said.rfind('/', said.find(": ")) + 1);
}

std::string entry(const std::string& keys, const std::string& value) {
  return R"({ "step": 1, )" + keys + ", \"value\": " + value + " }";
}

std::string of_p(const std::string& entries) {
  return "\"p\": [" + entries + "]";
}

const std::string w1 = R"("quantity": "w", "node": 1)";
const std::string w2 = R"("quantity": "w", "node": 2)";
const std::string force2 = R"("quantity": "force", "pair": 2)";

}  // namespace

TEST_CASE("the error of another program's number is relative to the largest exact number of the same kind") {
  const foreign_results r =
      judged(of_p(entry(w1, "-0.25025") + "," + entry(w2, "0.0005") + "," + entry(force2, "-0.004")));
  const auto& numbers = r.cases.at(0).numbers;
  CHECK_THAT(numbers.at(0).error, WithinRel(0.00025 / 0.25, 1e-9));
  CHECK_THAT(numbers.at(1).error, WithinRel(0.0005 / 0.25, 1e-9));
  CHECK_THAT(numbers.at(2).error, WithinRel(0.004 / 8, 1e-9));
  CHECK_FALSE(numbers.at(1).passed);
  CHECK(numbers.at(2).passed);
  CHECK(r.judged == 3);
  CHECK(r.cases.at(0).largest_error == numbers.at(1).error);
}

TEST_CASE("counts and states from another program must be equal to the exact ones, whatever the tolerance") {
  const std::string state = R"("quantity": "state", "pair": 2)";
  const std::string contacts = R"("quantity": "contacts")";
  const auto failed = [&](const std::string& a, const std::string& b) {
    return judged(of_p(entry(state, a) + "," + entry(contacts, b)), "0.1").failed;
  };
  CHECK(failed("\"separated\"", "1") == 0);
  CHECK(failed("\"contact\"", "1") == 1);
  CHECK(failed("\"separated\"", "1.05") == 1);
}

TEST_CASE("the judgement of another program lists each number and each problem for which it gave no result") {
  const foreign_results r = judged(of_p(entry(w2, "0")));
  CHECK(r.not_given == std::vector<std::string>{"other"});
  CHECK(r.cases.at(0).not_given.size() == 5);
}

TEST_CASE(
    "a result of another program is refused if it is unknown or given twice, and the message gives the "
    "place") {
  CHECK_THAT(refused("\"q\": [" + entry(w1, "0") + "]"),
             StartsWith("f.json:3:6: problems.q: found an unknown key") && Contains("allowed: p, other"));
  CHECK_THAT(refused("\"othr\": [" + entry(w1, "0") + "]"), Contains("did you mean \"other\"?"));
  CHECK_THAT(
      refused(of_p(entry(R"("quantity": "w", "node": 3)", "0"))),
      StartsWith("f.json:3:7: problems.p[1]: found w, node 3 in step 1; allowed: w, node 1; w, node 2;"));
  CHECK_THAT(refused(of_p(entry(w1, "0") + ",\n" + entry(w1, "0"))),
             StartsWith("f.json:4:1: problems.p[2]: found w, node 1 in step 1, a second time;"));
  CHECK_THAT(refused(of_p(entry(w1, "\"0\""))), StartsWith("f.json:3:57: problems.p[1].value: found \"0\""));
  CHECK_THAT(refused(of_p(entry(w1 + ", \"nod\": 1", "0"))),
             Contains("problems.p[1].nod: found an unknown key (did you mean \"node\"?)"));
  CHECK_THAT(refused(of_p(entry(w1, "0")), "0.2"),
             Contains("tolerance: found 0.2; allowed: a number from 0 to 0.1"));
}
