// Tests the measurements and judgements of contct verify. app/commands_test.cpp verifies every problem.
#include "contct/results/verify.hpp"

#include <cmath>
#include <filesystem>
#include <set>

#include "catch.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/results/run.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;

namespace {

const std::filesystem::path reference = CONTCT_REFERENCE;

problem reference_problem(const char* name) {
  return read_problem((reference / "problems" / name).string());
}

/// The measurement of a reference problem's path by the FORTRAN kernel.
struct measured {
  explicit measured(const char* name) : p(reference_problem(name)) {}
  static const run_recorder& followed(contct::run& path) {
    path.go({});
    return path.result.record;
  }

  problem p;
  linear_structure s = structure_of(p);
  contct::run path{p, s, {.kernels = {"fortran"}, .engine = "refactor"}};
  measurement m{p, followed(path)};
};

/// Returns a number of step 1 with these fields.
expected_number number(const char* quantity, int node = 0, const char* exact = "", double value = 0.0) {
  expected_number e;
  e.step = 1;
  e.quantity = quantity;
  e.node = node;
  e.exact = exact;
  e.value = value;
  e.tolerance = 1e-5;
  return e;
}

/// Returns the expected value in a table with these lines in its only check.
double value_in(const std::string& lines) {
  const scratch_folder here;
  const std::string file = here.write(
      "table.toml", "[[case]]\nfile = \"f\"\n[[case.check]]\nstep = 1\nquantity = \"w\"\nnode = 1\n" + lines +
                        "kind = \"recomputed\"\ntolerance = 1e-3\nbecause = \"b\"\nsource = \"s\"\n");
  return read_verification(file).at(0).checks.at(0).value;
}

}  // namespace

TEST_CASE("verification.toml lists exactly the files of reference/problems") {
  std::set<std::string> listed, there;
  for (const verification_case& c : read_verification((reference / "verification.toml").string()))
    listed.insert(c.file);
  for (const auto& entry : std::filesystem::directory_iterator(reference / "problems"))
    if (entry.path().extension() == ".toml") there.insert(entry.path().filename().string());
  CHECK(listed == there);
}

TEST_CASE("a number in verification.toml is refused if its exact value is not a decimal or a fraction") {
  for (const char* exact : {"1/2", "0.5", "5e-1", "-0.0", "-208/58875"})
    CHECK(value_in("value = 0.5\nexact = \"" + std::string(exact) + "\"\n") == 0.5);
  CHECK_THROWS_WITH(value_in("value = 0.5\n"), Contains("exact"));
  for (const char* exact :
       {"", "-", "1/0", "1/", "/2", "1.5/2", "010/3", "0x10", "inf", "nan", " 1", "--1", "half"}) {
    INFO(exact);
    CHECK_THROWS_WITH(value_in("value = 0.5\nexact = \"" + std::string(exact) + "\"\n"), Contains("exact"));
  }
}

TEST_CASE("contct verify compares computed and expected numbers with the exact number, with tolerances") {
  const expected_number third = number("w", 0, "1/3", 0.333333),
                        in = number("state", 0, "contact", in_contact);
  using row = std::tuple<expected_number, double, double, const char*>;
  const row rows[] = {
      {third, 1.0 / 3 + 1e-9, 1e-8, ""},
      {third, 1.0 / 3 + 1e-7, 1e-8, "exact value 1/3; allowed: a difference of 1e-08"},
      {third, std::nan(""), 1e-8, "computed nan"},
      // Without a certificate the table's tolerance applies.
      {third, 0.333334, 0.0, ""},
      {third, 0.33334, 0.0, "allowed: a difference of 3e-06"},
      {number("w", 0, "1/3", 0.333), 1.0 / 3, 1e-8,
       "exact value 1/3; allowed: a relative difference of 1e-05 from the expected 0.333"},
      {in, in_contact, 0.0, ""},
      {number("state", 0, "separated", in_contact), in_contact, 0.0, "the exact state is separated"},
      {number("w", 0, "", 0.333333), 7.0, 1e-8, ""},  // without an exact number
  };
  for (const auto& [e, computed, allowed, words] : rows) {
    const std::string said = exact_disagreement(e, computed, allowed);
    CHECK_THAT(said, Contains(words));
    CHECK(said.empty() == (*words == '\0'));
  }
}

TEST_CASE("the scale of an error is the largest number of the same kind on the path") {
  const measured pb1("pb01-cantilever-tip-stop.toml");
  const auto size = [&](const char* quantity, const char* dof = "") {
    expected_number e = number(quantity);
    e.dof = dof;
    return pb1.m.size_of(e);
  };
  CHECK(size("w") == Approx(0.016 / 3));
  CHECK(size("gap") == size("min w"));
  CHECK(size("theta") == Approx(0.004));
  CHECK(size("force") == Approx(41.8604651));
  CHECK(size("shear") == size("reaction", "w"));
  CHECK(size("max moment") == Approx(40.0));
  CHECK(size("reaction", "theta") == size("moment"));
  CHECK(size("event") == 1.0);
  for (const char* other : {"events", "contacts", "zero", "x of max moment"}) CHECK(size(other) == 0.0);
}

TEST_CASE("an extreme is found by its name, and what a structure does not have has the value NaN") {
  const measured plate("pp01a-simply-supported-plate-n4.toml"), pb7("pb07-three-gap-supports.toml");
  const auto at = [&](const char* quantity, int element, int place) {
    expected_number e = number(quantity);
    e.element = element;
    e.place = place;
    return plate.m.of(e);
  };
  CHECK(at("mx", 16, 3) == Approx(0.0489).epsilon(1e-3));
  for (const double missing : {at("mx", 16, 0), at("mx", 16, 5), at("mx", 17, 3), at("moment", 16, 3)})
    CHECK(std::isnan(missing));
  const auto of = [&](const char* quantity) {
    expected_number e = number(quantity);
    e.step = 3;
    return pb7.m.of(e);
  };
  CHECK(of("max moment") == Approx(167.984829).epsilon(1e-8));
  CHECK(std::abs(of("x of max moment") - 4.0) == Approx(0.299611).epsilon(1e-5));
  CHECK(of("min w") == Approx(-0.0103595331).epsilon(1e-8));
  for (const char* none : {"max mx", "x of min mxy", "mean moment", "max "}) CHECK(std::isnan(of(none)));
}

TEST_CASE("a difference is relative to the expected value, but absolute if the expected value is 0") {
  for (const auto& [value, computed, difference] :
       {std::tuple(2.0, 3.0, 0.5), {-4.0, -5.0, -0.25}, {0.0, 1e-3, 1e-3}}) {
    verified_number n;
    n.expected.value = value;
    n.computed = computed;
    CHECK(n.difference() == difference);
  }
}

TEST_CASE("contct verify compares each number on the paths of both rules") {
  const double right = -0.00483720930;
  expected_number tip = number("w", 3, "", right);
  tip.step = 2;
  tip.tolerance = 2e-9;
  expected_number wrong = tip, differs = tip, exact = tip, wrongly_exact = tip;
  wrong.value *= 1 + 1e-8;
  differs.value *= 1 + 1e-8;  // FORTRAN's value is right, and the corrected kernel's is wrong
  differs.faithful = right;
  exact.exact = "-26/5375";
  wrongly_exact.exact = "-27/5375";
  wrongly_exact.tolerance = 1.0;  // so that only the certified accuracy detects the error
  const verified_case c = verify_case({"a file", {tip, wrong, differs, exact, wrongly_exact}},
                                      reference_problem("pb01-cantilever-tip-stop.toml"));
  CHECK(c.failure.empty());
  CHECK(c.calls > 0);
  CHECK(c.mismatches == 0);
  REQUIRE(c.numbers.size() == 5);
  CHECK(c.numbers[0].certified);
  CHECK(c.numbers[0].exact_comparisons == 0);
  CHECK(c.numbers[3].exact_comparisons == 2);
  for (const int i : {0, 1, 2, 3, 4}) CHECK(c.numbers[i].passed == (i == 0 || i == 3));
  CHECK_THAT(c.numbers[4].apart, Contains("exact value -27/5375; allowed: "));
}

TEST_CASE("the description of a verified number has the quantity and the node, element or pair") {
  for (const auto& [quantity, node, pair, element, words] : {std::tuple("w", 3, 0, 0, "w, node 3"),
                                                             {"moment", 0, 0, 4, "moment, element 4.1"},
                                                             {"force", 0, 2, 4, "force, pair 2"},
                                                             {"event", 0, 2, 0, "pair 2 makes"},
                                                             {"min w", 0, 0, 0, "min w"},
                                                             {"reaction", 3, 0, 0, "reaction theta, node 3"},
                                                             {"events", 0, 0, 0, "toggles"},
                                                             {"zero", 0, 0, 0, "w = 0 along diagonal"}}) {
    expected_number e = number(quantity, node);
    e.pair = pair;
    e.element = element;
    e.place = 1;
    e.change = "make";
    e.dof = "theta";
    e.along = "diagonal";
    CHECK(quantity_words(e) == words);
  }
}
