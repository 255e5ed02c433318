// Tests the measurements and judgements of contct verify. app/verify_test.cpp verifies every problem.
#include "contct/lab/verify.hpp"

#include <cmath>
#include <filesystem>
#include <set>

#include "catch.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/session/run.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

const std::filesystem::path reference = CONTCT_REFERENCE;

/// A reference problem, and its path by the FORTRAN kernel.
struct followed {
  explicit followed(const char* name) : p(read_problem((reference / "problems" / name).string())) {
    path.go({});
  }

  problem p;
  linear_structure s = structure_of(p);
  contct::run path{p, s, {.kernels = {"fortran"}, .engine = "refactor"}};
};

}  // namespace

TEST_CASE("verification.toml lists exactly the files of reference/problems") {
  std::set<std::string> listed;
  for (const verification_case& c : read_verification((reference / "verification.toml").string()))
    listed.insert(c.file);
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(reference / "problems")) {
    if (entry.path().extension() == ".toml") there.insert(entry.path().filename().string());
  }
  CHECK(listed == there);
}

namespace {

/// Returns a number with the exact value 1/3.
expected_number third() {
  expected_number e;
  e.quantity = "w";
  e.value = 0.333333;
  e.tolerance = 1e-5;
  e.exact = "1/3";
  return e;
}

/// Returns the error of read_verification for a table with these lines in its only check, or an empty text.
std::string refusal_of(const std::string& lines) {
  const scratch_folder here;
  const std::string file = here.write(
      "table.toml", "[[case]]\nfile = \"f\"\n[[case.check]]\nstep = 1\nquantity = \"w\"\nnode = 1\n" + lines +
                        "kind = \"recomputed\"\ntolerance = 1e-3\nbecause = \"b\"\nsource = \"s\"\n");
  std::string said;
  double value = 0.5;
  try {
    value = read_verification(file).at(0).checks.at(0).value;
  } catch (const input_error& e) {
    said = e.what();
  }
  CHECK(value == 0.5);
  return said;
}

}  // namespace

TEST_CASE("a number in verification.toml is refused if its exact value is not a decimal or a fraction") {
  for (const char* exact : {"1/2", "0.5", "5e-1", "-0.0", "-208/58875"})
    CHECK(refusal_of("value = 0.5\nexact = \"" + std::string(exact) + "\"\n").empty());
  CHECK_THAT(refusal_of("value = 0.5\n"), Contains("exact"));
  for (const char* exact :
       {"", "-", "1/0", "1/", "/2", "1.5/2", "010/3", "0x10", "inf", "nan", " 1", "--1", "half"}) {
    INFO(exact);
    CHECK_THAT(refusal_of("value = 0.5\nexact = \"" + std::string(exact) + "\"\n"), Contains("exact"));
  }
}

TEST_CASE(
    "contct verify compares computed and expected numbers with the exact value, each within a tolerance") {
  expected_number e = third();
  CHECK(exact_disagreement(e, 1.0 / 3 + 1e-9, 1e-8).empty());
  CHECK_THAT(exact_disagreement(e, 1.0 / 3 + 1e-7, 1e-8),
             Contains("exact value 1/3; allowed: a difference of 1e-08"));
  CHECK_THAT(exact_disagreement(e, std::nan(""), 1e-8), Contains("computed nan"));
  // Without a certificate the table's tolerance applies.
  CHECK(exact_disagreement(e, 0.333334, 0.0).empty());
  CHECK_THAT(exact_disagreement(e, 0.33334, 0.0), Contains("allowed: a difference of 3e-06"));
  e.value = 0.333;
  CHECK_THAT(exact_disagreement(e, 1.0 / 3, 1e-8),
             Contains("exact value 1/3; allowed: a relative difference of 1e-05 from the expected 0.333"));
}

TEST_CASE(
    "contct verify compares states with exact states by name, and omits a number without an exact value") {
  expected_number e;
  e.quantity = "state";
  e.value = in_contact;
  e.exact = "contact";
  CHECK(exact_disagreement(e, in_contact, 0.0).empty());
  e.exact = "separated";
  CHECK(exact_disagreement(e, in_contact, 0.0) == "the exact state is separated");
  expected_number unknown = third();
  unknown.exact.clear();
  CHECK(exact_disagreement(unknown, 7.0, 1e-8).empty());
}

TEST_CASE(
    "the scale of an error is the largest number of the same kind on the path, such as the largest "
    "deflection") {
  const followed f("pb01-cantilever-tip-stop.toml");
  const measurement m(f.p, f.path.result.record);
  const auto size = [&](const char* quantity, const char* dof = "") {
    expected_number e;
    e.quantity = quantity;
    e.dof = dof;
    return m.size_of(e);
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

TEST_CASE("a quantity, corner or element that a plate does not have has the value NaN") {
  const followed f("pp01a-simply-supported-plate-n4.toml");
  const measurement m(f.p, f.path.result.record);
  expected_number e;
  e.step = 1;
  e.quantity = "mx";
  e.element = 16;
  e.place = 3;
  CHECK(m.of(e) == Approx(0.0489).epsilon(1e-3));
  for (const int place : {0, 5}) {
    e.place = place;
    CHECK(std::isnan(m.of(e)));
  }
  e.place = 3;
  e.element = 17;
  CHECK(std::isnan(m.of(e)));
  e.element = 16;
  e.quantity = "moment";
  CHECK(std::isnan(m.of(e)));
}

TEST_CASE("a difference is relative to the expected value, but absolute if the expected value is 0") {
  verified_number n;
  n.expected.value = 2.0;
  n.computed = 3.0;
  CHECK(n.difference() == 0.5);
  n.expected.value = -4.0;
  n.computed = -5.0;
  CHECK(n.difference() == -0.25);
  n.expected.value = 0.0;
  n.computed = 1e-3;
  CHECK(n.difference() == 1e-3);
}

TEST_CASE(
    "contct verify compares each number on the paths of both rules, with the expected and with the exact "
    "value") {
  const problem p = read_problem((reference / "problems" / "pb01-cantilever-tip-stop.toml").string());
  expected_number tip;
  tip.step = 2;
  tip.quantity = "w";
  tip.node = 3;
  tip.value = -0.00483720930;
  tip.tolerance = 2e-9;
  expected_number wrong = tip;
  wrong.value *= 1 + 1e-8;
  expected_number differs = wrong;  // FORTRAN's value is right, and the corrected kernel's is wrong
  differs.faithful = tip.value;
  expected_number exact = tip;
  exact.exact = "-26/5375";
  expected_number wrongly_exact = exact;
  wrongly_exact.tolerance = 1.0;  // so that only the certified accuracy detects the error
  wrongly_exact.exact = "-27/5375";
  const verified_case c = verify_case({"a file", {tip, wrong, differs, exact, wrongly_exact}}, p);
  CHECK(c.failure.empty());
  CHECK(c.calls > 0);
  CHECK(c.mismatches == 0);
  REQUIRE(c.numbers.size() == 5);
  CHECK(c.numbers[0].certified);
  CHECK(c.numbers[0].exact_comparisons == 0);
  CHECK(c.numbers[3].exact_comparisons == 2);
  for (const int right : {0, 3}) CHECK(c.numbers[right].passed);
  for (const int not_right : {1, 2, 4}) CHECK_FALSE(c.numbers[not_right].passed);
  CHECK_THAT(c.numbers[4].apart, Contains("exact value -27/5375; allowed: "));
}

TEST_CASE("an extreme is found by a name such as max moment, and an unknown name gives NaN") {
  const followed f("pb07-three-gap-supports.toml");
  const measurement m(f.p, f.path.result.record);
  expected_number e;
  e.step = 3;
  const auto of = [&](const char* quantity) {
    e.quantity = quantity;
    return m.of(e);
  };
  CHECK(of("max moment") == Approx(167.984829).epsilon(1e-8));
  CHECK(std::abs(of("x of max moment") - 4.0) == Approx(0.299611).epsilon(1e-5));
  CHECK(of("min w") == Approx(-0.0103595331).epsilon(1e-8));
  CHECK(quantity_words(e) == "min w");
  for (const char* none : {"max mx", "x of min mxy", "mean moment", "max "}) CHECK(std::isnan(of(none)));
}

TEST_CASE("the description of a verified number has the quantity and the node, element or pair") {
  expected_number e;
  e.quantity = "w";
  e.node = 3;
  CHECK(quantity_words(e) == "w, node 3");
  e.element = 4;
  e.place = 1;
  e.quantity = "moment";
  CHECK(quantity_words(e) == "moment, element 4.1");
  e.pair = 2;
  e.quantity = "force";
  CHECK(quantity_words(e) == "force, pair 2");
  e.quantity = "event";
  e.change = "make";
  CHECK(quantity_words(e) == "pair 2 makes");
}
