// A follower's answers are compared and counted, and its first mismatch is reported.
#include "contct/compare/follower.hpp"

#include <stdexcept>

#include "catch.hpp"
#include "contct/outside/registry.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// One pair that touches after half of the load.
const call_inputs<double> half_way{{0.0}, {1.0}, {0.5}, {1}, {separated}, {face_above}, {}};

/// The leader's answer to that call, with SMIN as given.
struct answered_half_way {
  call_outputs out;
  call<double> c = out.prepare(half_way);

  explicit answered_half_way(double smin = 0.5) {
    c.smin = smin;
    c.ss[0] = 0.5;
    c.isep[0] = in_contact;
  }
};

}  // namespace

TEST_CASE("a follower counts what is compared and keeps the mismatch of the earliest call") {
  const auto k = make_kernel("cpp");
  follower f(k->facts(), *k);
  const answered_half_way right;
  const answered_half_way wrong(0.25);
  CHECK_FALSE(f.ask(1, right.c, half_way.isep, std::nullopt));
  CHECK_FALSE(f.first());
  CHECK(f.answer().smin == 0.5);
  CHECK(f.compared.values == 3);
  REQUIRE(f.ask(5, wrong.c, half_way.isep, std::nullopt));
  CHECK(f.difference()->field == "SMIN");
  CHECK(f.answered());
  CHECK(f.first()->call == 5);
  CHECK(f.first()->decisions.size() == 6);
  (void)f.ask(6, wrong.c, half_way.isep, std::nullopt);
  CHECK(f.first()->call == 5);
  f.note(3, {"text", 2, "a", "b", 0}, wrong.c, half_way.isep);  // found later, in an earlier call
  CHECK(f.first()->call == 3);
  CHECK(f.first()->where.field == "text");
  CHECK(f.compared.values == 9);
  CHECK(f.compared.mismatches == 2);
}

TEST_CASE("text is compared where the leader's is given, as one value") {
  const auto k = make_kernel("cpp");
  follower f(k->facts(), *k);
  const answered_half_way right;
  const auto found = f.ask(1, right.c, half_way.isep, "another text\n");
  REQUIRE(found);
  CHECK(found->field == "text");
  CHECK(found->index == 1);
  CHECK(f.compared.values == 4);
  CHECK(f.compared.mismatches == 1);
}

TEST_CASE("kernels of another precision or rule are refused") {
  CHECK_NOTHROW(refuse_unequal(facts_of_kernel("fortran"), facts_of_kernel("cpp")));
  CHECK_THROWS_WITH(refuse_unequal(facts_of_kernel("fortran"), facts_of_kernel("cpp-r4")),
                    Contains("precision"));
  CHECK_THROWS_WITH(refuse_unequal(facts_of_kernel("fortran"), facts_of_kernel("corrected")),
                    Contains("rule"));
}

TEST_CASE("a report names the call, the kernels and the place, and calls a narrow decision a tie") {
  mismatch_report r{3, "fortran", "mine", {"ISEP", 2, "-1", "1", 0}, {}};
  r.decisions = {{branch::within_epsmul, 1, true, 1}, {branch::s_positive, 0, true, 1'000'000}};
  CHECK(words_of(r)[0] == "call 3: mine differs in ISEP(2): fortran has -1, mine has 1");
  CHECK_THAT(margin_words(r), Contains("was true by 1 ULP: a tie"));
  r.decisions[0].ulps = tie_ulps + 1;
  CHECK_THAT(margin_words(r), Contains("by 5 ULP") && Contains("a bug"));
  r.where = {"answer", 0, "an answer", "it ended with status 3", 0};
  CHECK(words_of(r) == std::vector<std::string>{"call 3: mine gave no answer: it ended with status 3"});
}
