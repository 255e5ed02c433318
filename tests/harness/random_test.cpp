// Tests that random calls and problems have their declared properties and are the same on every machine, and
// that paths are the same in many threads. Under ThreadSanitizer (preset tsan) a data race fails.
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <thread>

#include "catch.hpp"
#include "contct/harness/branches.hpp"
#include "contct/harness/random_calls.hpp"
#include "contct/kernel/contct.hpp"
#include "contct/kernel/registry.hpp"
#include "support/tried_problem.hpp"

using namespace contct;

namespace {

/// Returns a hash of a call.
std::uint64_t digest(const call_inputs& in) {
  std::uint64_t sum = in.pairs();
  const auto mix = [&sum](double x) {
    sum = (sum ^ (std::isnan(x) ? 1 : std::bit_cast<std::uint64_t>(x))) * 0x9e3779b97f4a7c15;
  };
  for (std::size_t i = 0; i < in.pairs(); ++i)
    for (const double x : {in.dd[in.dof_of_pair(i)], in.dtest[in.dof_of_pair(i)], in.cc[i],
                           static_cast<double>(in.isep[i] * 8 + in.isurf[i] + 64 * in.id[i])})
      mix(x);
  return sum;
}

/// Returns most of a problem's numbers.
std::vector<double> numbers_of(const random_problem& p) {
  std::vector<double> all{p.unit, static_cast<double>(nodes(p.geometry))};
  for (const contact_pair& c : p.pairs)
    for (const double x : {static_cast<double>(c.node), static_cast<double>(c.surface), c.face, c.stiffness})
      all.push_back(x);
  for (const support& s : p.supports) all.push_back(s.node + 0.25 * s.dof + s.spring);
  for (const load& l : p.steps) {
    for (const point_load& f : l.points) all.push_back(f.value);
    for (const distributed_load& d : l.distributed) all.push_back(d.polynomial[0]);
  }
  return all;
}

bool is_nothing(const load& l) {
  return std::ranges::all_of(l.points, [](const point_load& p) { return p.value == 0.0; }) &&
         std::ranges::all_of(l.distributed, [](const distributed_load& d) { return d.polynomial[0] == 0.0; });
}

}  // namespace

TEMPLATE_TEST_CASE("adversarial calls reach the threshold of every IF exactly, and most within one ULP", "",
                   float, double) {
  constexpr int real_bytes = sizeof(TestType);
  call_source source(1989, real_bytes);
  std::map<branch, std::array<int, 2>> near;  // counts of IFs whose sides are equal, or differ by one ULP
  call_outputs out;
  std::vector<event> events;
  for (std::uint64_t n = 1; n <= 60'000; ++n) {
    const call_inputs& in = source.adversarial(n);
    events.resize(in.pairs());
    call<double> drawn = out.prepare(in);
    in_precision(drawn, real_bytes, [&](auto& c) {
      (void)contct::contct(c, std::span<event>(events));
      for_each_decision(c, in.isep, [&near](branch b, std::size_t, bool, auto left, auto right) {
        const std::uint64_t ulps = margin_between(left, right);
        if (ulps <= 1) ++near[b][ulps];
      });
    });
  }
  for (const branch b : {branch::no_response, branch::stationary, branch::s_positive, branch::s_is_smallest,
                         branch::no_events, branch::within_epsmul, branch::check_positive}) {
    INFO(branch_names[index_of(b)]);
    CHECK(near[b][0] >= 20);
    // One ULP of SS changes DIFF by many ULPs, so DIFF is rarely one ULP from EPSMUL.
    CHECK((near[b][1] >= 20 || b == branch::within_epsmul || b == branch::check_positive));
  }
}

TEST_CASE("a random call depends only on its seed and its number, and has NaN at every dof without a pair") {
  for (const int real_bytes : {4, 8}) {
    call_source forwards(7, real_bytes), backwards(7, real_bytes), other(8, real_bytes);
    std::map<std::uint64_t, std::uint64_t> seen;
    for (std::uint64_t n = 1; n <= 200; ++n) seen[n] = digest(forwards.at(n));
    for (std::uint64_t n = 200; n >= 1; --n) CHECK(digest(backwards.at(n)) == seen[n]);
    int same = 0, wrong = 0;
    for (std::uint64_t n = 1; n <= 200; ++n) {
      const call_inputs& in = other.at(n);
      same += digest(in) == seen[n] ? 1 : 0;
      std::vector<char> watched(in.dd.size(), 0);
      for (std::size_t i = 0; i < in.pairs(); ++i) watched[in.dof_of_pair(i)] = 1;
      for (std::size_t dof = 0; dof < in.dd.size(); ++dof)
        wrong += watched[dof] == 0 && !(std::isnan(in.dd[dof]) && std::isnan(in.dtest[dof])) ? 1 : 0;
    }
    CHECK(same < 10);  // calls without pairs are equal
    CHECK(wrong == 0);
  }
}

TEST_CASE("a random problem depends only on its seed and number, and 300 of these problems all differ") {
  std::set<std::vector<double>> seen;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    for (std::uint64_t number = 0; number < 100; ++number) {
      const std::vector<double> once = numbers_of(make_random_problem(seed, number));
      CHECK(once == numbers_of(make_random_problem(seed, number)));
      seen.insert(once);
    }
  }
  CHECK(seen.size() == 300);
}

TEST_CASE("three pinned random problems keep their sizes, faces and stiffnesses in every version") {
  // Faces are computed by a solve and units by pow(), so the last digits of faces and units are not compared.
  // Seed and number; held; layout; numbers of nodes, supports, pairs and steps; unit, last face and
  // stiffness.
  using sizes_of = std::tuple<bool, face_layout, int, std::size_t, std::size_t, std::size_t>;
  using pinned = std::tuple<std::uint64_t, std::uint64_t, sizes_of, std::array<double, 3>>;
  const pinned known[] = {
      {1, 0, {true, face_layout::mixed, 22, 2, 4, 1}, {0.0227337944608467, 0, 2.251095155184}},
      {1, 1, {true, face_layout::gaps, 6, 2, 2, 5}, {792067.46454214, -11560.1760943103, 9.93323884198174}},
      {3,
       12345,
       {true, face_layout::near_ties, 23, 4, 20, 3},
       {1.68588277682789e-08, 3.256594026e-13, 55822045918044.2}},
  };
  for (const auto& [seed, number, sizes, numbers] : known) {
    const random_problem p = make_random_problem(seed, number);
    INFO(seed << ", " << number);
    CHECK((sizes_of(p.held, p.layout, nodes(p.geometry), p.supports.size(), p.pairs.size(), p.steps.size()) ==
           sizes));
    CHECK(p.unit == Approx(numbers[0]).epsilon(1e-10));
    CHECK(p.pairs.back().face == Approx(numbers[1]).epsilon(1e-6));
    CHECK(p.pairs.back().stiffness == Approx(numbers[2]).epsilon(1e-10));
  }
}

TEST_CASE("every random problem has valid supports, pairs and steps") {
  for (std::uint64_t number = 0; number < 1000; ++number) {
    const random_problem p = make_random_problem(21, number);
    INFO(number << " " << name_of(p.layout));
    const int count = nodes(p.geometry);
    std::set<int> fixed;
    for (const support& s : p.supports) {
      CHECK((s.node >= 0 && s.node < count));
      CHECK(s.fixed == (s.spring == 0.0));
      if (s.fixed && s.dof == 0) fixed.insert(s.node);
    }
    CHECK(p.held == !p.supports.empty());
    REQUIRE_FALSE(p.pairs.empty());
    for (const contact_pair& c : p.pairs) {
      CHECK((c.node >= 0 && c.node < count));
      // If no other pair was drawn, there is a pair at the middle node, which may be fixed.
      CHECK((!fixed.contains(c.node) || c.node == count / 2));
      CHECK((c.surface == face_above || c.surface == face_below));
      CHECK(c.stiffness > 0.0);
      CHECK(c.surface * c.face >= 0.0);  // no face is inside the structure
      CHECK(c.closed == (c.face == 0.0));
    }
    CHECK((!p.steps.empty() && p.steps.size() <= 5));
    // An antisymmetric problem has no load in the middle, so its first step may be empty.
    CHECK((!is_nothing(p.steps[0]) || p.layout == face_layout::antisymmetric));
    for (const load& l : p.steps)
      for (const point_load& f : l.points)
        CHECK((f.node >= 0 && f.node < count && f.dof >= 0 && f.dof < dofs_per_node(p.geometry)));
    if (const beam* b = std::get_if<beam>(&p.geometry.kind)) {
      CHECK(std::is_sorted(b->x.begin(), b->x.end(), std::less_equal<>()));
      CHECK(b->x.back() == Approx(p.unit).epsilon(1e-12));
    }
  }
}

TEST_CASE("sixteen threads follow different paths, and each path equals the same path in a single thread") {
  constexpr std::size_t threads = 16, problems = 6;
  random_problem_kind kind;
  kind.most_elements = 8;
  kind.most_lines = 3;
  // Returns the result of thread t for its problem i. Only one thread uses the listing, because unit 26
  // belongs to the whole process.
  const auto result_of = [&](std::size_t t, std::size_t i) {
    const random_problem p = make_random_problem(2026, t * problems + i + 1, kind);
    const char* const leader = t == 0 ? "fortran" : (t + i) % 2 == 0 ? "cpp" : "corrected";
    return try_problem(p, *make_kernel(leader), i % 2 == 0 ? "refactor" : "updated");
  };
  std::vector<problem_result> expected;
  for (std::size_t n = 0; n < threads * problems; ++n)
    expected.push_back(result_of(n / problems, n % problems));
  std::atomic<int> right = 0;
  std::vector<std::thread> all;
  for (std::size_t t = 0; t < threads; ++t)
    all.emplace_back([&, t] {
      for (std::size_t i = 0; i < problems; ++i) {
        const problem_result found = result_of(t, i);
        const problem_result& wanted = expected[t * problems + i];
        const bool same = std::ranges::equal(found.followed.steps, wanted.followed.steps, {},
                                             &solved_step::displacement, &solved_step::displacement);
        right += same && found.came_to == wanted.came_to ? 1 : 0;
      }
    });
  for (std::thread& t : all) t.join();
  CHECK(right == threads * problems);
}
