// Tests that the listing, also if other compilers build it, and the C++ kernel are equal to the bit. `contct
// prove` proves this equality for every input; these tests also cover the wrapper and the text.
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "catch.hpp"
#include "contct/harness/branches.hpp"
#include "contct/harness/compare.hpp"
#include "contct/harness/random_calls.hpp"
#include "contct/kernel/registry.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

/// Passes calls to a kernel and to the 1989 code in the kernel's precision, and compares the answers. Texts
/// are compared in blocks, because reading unit 26 after every call would take ten times as long.
struct beside_fortran {
  explicit beside_fortran(const std::string& name)
      : asked(make_kernel(name)),
        gfortran(make_kernel(asked->facts().real_bytes == 4 ? "fortran-r4" : "fortran")) {}

  void put(const call_inputs& in) {
    call<double> left = listing.prepare(in), right = other.prepare(in);
    gfortran->answer(left);
    asked->answer(right);
    listing.smin = left.smin;
    const auto found = compare_answers(left, right, answers);
    if (found && first.empty())
      first = "call " + std::to_string(calls) + ": " + found->field + " " + found->leader + ", " +
              found->follower;
    branches.count(left, in.isep);
    if (++calls % 10'000 == 0) compare_texts();
  }
  void compare_texts() {
    const std::string a = gfortran->take_text(), b = asked->take_text();
    (void)compare_text(a, b, texts, texts_by_meaning(gfortran->facts(), asked->facts()));
    lines += std::ranges::count(a, '\n');
    equal_bytes = equal_bytes && a == b;
  }
  void require_no_mismatch() {
    compare_texts();
    INFO(first);
    REQUIRE(answers.mismatches == 0);
    REQUIRE(texts.mismatches == 0);
    CHECK(lines >= calls);
  }

  std::unique_ptr<kernel> asked, gfortran;
  call_outputs listing, other;
  tally answers, texts;
  branch_counts branches;
  std::string first;  // the first mismatch
  std::int64_t calls = 0, lines = 0;
  bool equal_bytes = true;  // of the texts
};

template <class Real>
std::vector<double> interesting_numbers() {
  using limits = std::numeric_limits<Real>;
  const Real gap = sizeof(Real) == 4 ? static_cast<Real>(1.E-10F) : static_cast<Real>(1.E-10);
  std::vector<double> all = {limits::quiet_NaN()};
  for (const Real x :
       {Real(0), limits::denorm_min(), limits::min(), Real(1e-20), std::nextafter(gap, Real(0)), gap,
        std::nextafter(gap, Real(1)), Real(0.5), std::nextafter(Real(1), Real(0)), Real(1),
        std::nextafter(Real(1), Real(2)), Real(3), Real(1e30), limits::max(), limits::infinity()}) {
    all.push_back(x);
    all.push_back(-x);
  }
  return all;
}

template <class Real>
const char* const cpp_kernel = sizeof(Real) == 4 ? "cpp-r4" : "cpp";

}  // namespace

TEMPLATE_TEST_CASE("FORTRAN and C++ answer one pair equally, for 31 values of D, d* and c and all statuses",
                   "", float, double) {
  const std::vector<double> numbers = interesting_numbers<TestType>();
  REQUIRE(numbers.size() == 31);
  beside_fortran both(cpp_kernel<TestType>);
  for (const double d : numbers)
    for (const double d_star : numbers)
      for (const double c : numbers)
        for (const int isep : {1, -1, 0, 2})  // for 0 and 2 the listing takes its ELSE branches
          for (const int isurf : {1, -1}) both.put({{d}, {d_star}, {c}, {1}, {isep}, {isurf}, {}});
  both.require_no_mismatch();
  CHECK(both.equal_bytes);
  // Every IF had both outcomes, except IF (DIFF.LT.EPSMUL), which is always true for a single pair.
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true}) {
      const bool impossible = branch_names[b] == "within_epsmul" && !outcome;
      INFO(branch_names[b] << " " << outcome);
      CHECK((both.branches.of(static_cast<branch>(b), outcome) > 100) != impossible);
    }
  }
  CHECK(both.calls == 31L * 31 * 31 * 8);
  CHECK(both.answers.values == 3 * both.calls);
}

TEMPLATE_TEST_CASE("FORTRAN and C++ answer two pairs equally at ties and at a DIFF within one ULP of EPSMUL",
                   "", float, double) {
  using Real = TestType;
  const Real half = Real(0.5), edge = half + half / Real(256);
  const std::vector<double> faces = {
      half,        edge,       std::nextafter(edge, Real(0)), std::nextafter(edge, Real(1)), 0, 0.75, -half,
      Real(5e-11), Real(0.996)};
  const std::vector<double> responses = {0, 1, -1, 2, half, Real(1e-3), std::nan("")};
  beside_fortran both(cpp_kernel<Real>);
  std::array<int, 4> near_ties{};  // an exact tie; below, at and above EPSMUL
  for (const double c1 : faces) {
    for (const double c2 : faces) {
      for (const double d1 : responses) {
        for (const double d2 : responses) {
          for (int statuses = 0; statuses < 16; ++statuses) {
            const auto sign = [statuses](int bit) { return (statuses & bit) != 0 ? 1 : -1; };
            both.put({{0, 0}, {d1, d2}, {c1, c2}, {1, 2}, {sign(1), sign(2)}, {sign(4), sign(8)}, {}});
            const auto& [smin, ss, isep, text] = both.listing;
            if (smin == 1 || ss[0] != smin) continue;
            constexpr double eps = 1.0 / 256;
            const double difference = std::abs(ss[1] - smin) / smin;
            near_ties[0] += difference == 0;
            near_ties[1] += difference > eps / 2 && difference < eps;
            near_ties[2] += difference == eps;
            near_ties[3] += difference > eps && difference < 2 * eps;
          }
        }
      }
    }
  }
  both.require_no_mismatch();
  CHECK(both.equal_bytes);
  CHECK(both.branches.rarest() > 100);
  CHECK(both.calls == 9L * 9 * 7 * 7 * 16);
  for (const int reached : near_ties) CHECK(reached >= 16);
}

TEST_CASE("every kernel of the 1989 rule answers 10,000 random calls as the 1989 code does, with its texts") {
  std::vector<std::string> names = kernel_names();  // with flang and f2c, if they are built
  std::erase_if(names, [](const auto& name) {
    return facts_of_kernel(name).rule != contact_rule::listing || name.starts_with("fortran");
  });
  REQUIRE(names.size() >= 2);
  for (const std::string& name : names) {
    INFO(name);
    beside_fortran both(name);
    call_source source(1989, both.asked->facts().real_bytes);
    std::set<std::pair<int, int>> layouts;
    std::size_t most_pairs = 0;
    int shared_nodes = 0;
    for (int i = 1; i <= 10'000; ++i) {
      const call_inputs& in = source.at(i);
      both.put(in);
      layouts.insert({in.dof.indof, in.dof.ndofpn});
      most_pairs = std::max(most_pairs, in.pairs());
      shared_nodes += in.pairs() > 1 && in.id[0] == in.id[1] ? 1 : 0;
    }
    both.require_no_mismatch();
    CHECK(both.equal_bytes == (name != "f2c"));  // libf2c omits the leading zero of a number
    CHECK(both.answers.values > 200'000);
    CHECK(both.branches.rarest() > 500);
    CHECK(layouts.size() == 9);
    CHECK(most_pairs >= 64);
    CHECK(shared_nodes > 100);
  }
  CHECK_FALSE(std::filesystem::exists("fort.26"));
}

TEST_CASE("each compiler's run-time library has its own unit 26, of which only one is open at a time") {
  const call_inputs quarter{{0.0}, {4.0}, {1.0}, {1}, {separated}, {face_above}, {}};
  for (const std::string name : {"fortran", "flang", "f2c"}) {
    if (std::ranges::count(kernel_names(), name) == 0) continue;
    INFO(name);
    const auto first = make_kernel(name);
    CHECK_THROWS_AS(make_kernel(name), std::logic_error);
    const auto beside = name == "fortran" ? nullptr : make_kernel("fortran");
    CHECK_THAT(answer_of(*first, quarter).text,
               Contains(name == "f2c" ? "SCALE FACTOR =   .2500E+00" : "SCALE FACTOR =  0.2500E+00"));
    if (beside) CHECK(beside->take_text().empty());
  }
}
