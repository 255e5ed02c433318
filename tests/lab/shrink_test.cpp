// Tests that a mismatch is shrunk to fewer calls, fewer pairs and rounder numbers that still give different
// answers.
#include <cmath>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/fuzz.hpp"
#include "contct/lab/random_calls.hpp"

using namespace contct;

namespace {

/// Returns true if a pair in contact has gap / d* between 0.1 and 1/3.
bool approaches(const call_inputs<double>& in) {
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    const std::size_t dof = in.dof_of_pair(i);
    const double s = (in.cc[i] - in.dd[dof]) / in.dtest[dof];
    if (s > 0.1 && s < 1.0 / 3 && in.isep[i] == in_contact) return true;
  }
  return false;
}

call_sequence some_calls(std::size_t last) {
  call_source source(1989, 8);
  call_sequence calls;
  std::uint64_t n = 1;
  for (; calls.size() + 1 < last; ++n) calls.push_back(source.at(n));
  while (!approaches(source.at(n))) ++n;
  calls.push_back(source.at(n));
  return calls;
}

}  // namespace

TEST_CASE(
    "if one pair of one call is enough for a difference, shrinking leaves only this pair, with round "
    "numbers") {
  const still_differs differs = [](const call_sequence& c) { return approaches(c.back()); };
  const call_sequence small = shrink(some_calls(20), differs);
  REQUIRE(small.size() == 1);
  REQUIRE(small[0].pairs() == 1);
  CHECK(approaches(small[0]));
  CHECK(small[0].dd.size() == 1);
  CHECK(small[0].dof.indof == 1);
  CHECK(small[0].dof.ndofpn == 1);
  CHECK(small[0].dd[0] == 0.0);
  CHECK(small[0].dtest[0] == 1.0);
  CHECK(std::abs(small[0].cc[0] * 10 - std::round(small[0].cc[0] * 10)) < 1e-12);  // one digit
  CHECK(small[0].isurf[0] == face_above);
}

TEST_CASE("if a difference needs one earlier call, shrinking leaves two calls") {
  const still_differs differs = [](const call_sequence& c) {
    int many = 0;
    for (std::size_t i = 0; i + 1 < c.size(); ++i) many += c[i].pairs() >= 3 ? 1 : 0;
    return many >= 1 && approaches(c.back());
  };
  const call_sequence small = shrink(some_calls(30), differs);
  REQUIRE(small.size() == 2);
  CHECK(small[0].pairs() == 3);
  CHECK(small[1].pairs() == 1);
}

TEST_CASE(
    "shrinking stops after the allowed number of tries, and the answers to the remaining calls still "
    "differ") {
  int tries = 0;
  const still_differs differs = [&tries](const call_sequence& c) {
    ++tries;
    return approaches(c.back());
  };
  const call_sequence small = shrink(some_calls(20), differs, 5);
  CHECK(tries == 5);
  CHECK(approaches(small.back()));
}

TEST_CASE("calls to which both kernels give equal answers are not shrunk") {
  const auto leader = make_kernel("fortran");
  CHECK_FALSE(shrunk_case(
      *leader, [] { return make_kernel("cpp"); }, some_calls(3), ""));
}

TEST_CASE(
    "a mismatch is reproduced with newly made kernels, and the shrunk case contains the leader's answers") {
  const auto leader = make_kernel("fortran");
  const fresh_kernel in_single_precision = [] { return make_kernel("cpp-r4"); };
  const call_sequence calls = some_calls(3);
  // Single precision gives other answers than the leader.
  const auto found = reproduce(*leader, in_single_precision, calls, "");
  REQUIRE(found);
  CHECK(found->what.call == 3);
  CHECK(found->what.follower == "cpp-r4");
  CHECK(found->leader.size() == 3);
  CHECK(found->leader[2].ss.size() == calls[2].pairs());
  CHECK_FALSE(reproduce(*leader, in_single_precision, calls, "no such field"));
  const auto small = shrunk_case(*leader, in_single_precision, calls, found->what.where.field);
  REQUIRE(small);
  CHECK(small->calls.size() == 1);
  CHECK(small->what.where.field == found->what.where.field);
}
