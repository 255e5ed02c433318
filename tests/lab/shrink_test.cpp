// Divergences made small: fewer calls, fewer pairs, rounder numbers, and still diverging.
#include "contct/lab/shrink.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/lab/call_campaign.hpp"
#include "contct/lab/case_files.hpp"
#include "contct/lab/reproduce.hpp"
#include "contct/outside/registry.hpp"

using namespace contct;

namespace {

/// Does some pair of the call come to a face above it from below, at less than a third?
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

TEST_CASE("what one pair of one call shows is shrunk to one pair with round numbers") {
  const still_diverges diverges = [](const call_sequence& c) { return approaches(c.back()); };
  const call_sequence small = shrink(some_calls(20), diverges);
  REQUIRE(small.size() == 1);
  REQUIRE(small[0].pairs() == 1);
  CHECK(approaches(small[0]));
  CHECK(small[0].dd.size() == 1);
  CHECK(small[0].dof.indof == 1);
  CHECK(small[0].dof.ndofpn == 1);
  CHECK(small[0].dd[0] == 0.0);
  CHECK(small[0].dtest[0] == 1.0);
  CHECK(std::abs(small[0].cc[0] * 10 - std::round(small[0].cc[0] * 10)) < 1e-12);  // one digit is enough
  CHECK(small[0].isurf[0] == face_above);
}

TEST_CASE("what needs a call before it keeps just that one") {
  const still_diverges diverges = [](const call_sequence& c) {
    int many = 0;
    for (std::size_t i = 0; i + 1 < c.size(); ++i) many += c[i].pairs() >= 3;
    return many >= 1 && approaches(c.back());
  };
  const call_sequence small = shrink(some_calls(30), diverges);
  REQUIRE(small.size() == 2);
  CHECK(small[0].pairs() == 3);
  CHECK(small[1].pairs() == 1);
}

TEST_CASE("shrinking stops when its tries are used up, with something that still diverges") {
  int tries = 0;
  const still_diverges diverges = [&tries](const call_sequence& c) {
    ++tries;
    return approaches(c.back());
  };
  const call_sequence small = shrink(some_calls(20), diverges, 5);
  CHECK(tries == 5);
  CHECK(approaches(small.back()));
}

TEST_CASE("kernels that agree give nothing to shrink") {
  const auto leader = make_kernel("fortran");
  CHECK_FALSE(shrunk_case(*leader, "cpp", some_calls(3), ""));
}

TEST_CASE("a case as a FORTRAN main program fits its columns, and its literals are read back exactly") {
  found_case c;
  c.what = {1, "fortran", "mine", {"SS", 1, "0x1p+0", "0x1p-1", 1}, {}};
  c.calls = {some_calls(1).back()};
  c.leader.resize(1);
  c.leader[0].ss.resize(c.calls[0].pairs());
  c.leader[0].isep = c.calls[0].isep;
  const std::string main = fortran_main_of(c);
  std::size_t from = 0;
  int lines = 0;
  for (std::size_t to = 0; (to = main.find('\n', from)) != std::string::npos; from = to + 1, ++lines) {
    INFO(main.substr(from, to - from));
    CHECK(to - from <= 72);
  }
  CHECK(lines > 10);
  CHECK_THAT(main, Catch::Matchers::Contains("CALL CONTCT (DD, DTEST, CC, SS, SMIN, ID, ISEP, ISURF, "));
}
