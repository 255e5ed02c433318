// Draws small problems that are hard for double precision.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <utility>

#include "contct/kernel/call.hpp"
#include "contct/number/random.hpp"
#include "referee/judge.hpp"

namespace contct::referee {
namespace {

/// Returns the double nearest to the decimal mantissa * 10^exponent.
double decimal(std::int64_t mantissa, int exponent) {
  return std::strtod(fmt::format("{}e{}", mantissa, exponent).c_str(), nullptr);
}

/// Draws one problem. Lengths are in units of 10^u and EI in units of 10^e. Forces are in units of 10^(e -
/// 2u), which bend a beam of length 1 by about 1.
class hard_drawing {
 public:
  hard_drawing(std::uint64_t seed, std::uint64_t number, int kind)
      : random_((seed * 0x9e3779b97f4a7c15U + number) * 16U + static_cast<std::uint64_t>(kind)) {}

  problem draw(int kind) {
    constexpr void (hard_drawing::*draws[hard_kinds])() = {
        &hard_drawing::stiff_pairs,      &hard_drawing::drop,        &hard_drawing::small_after_large,
        &hard_drawing::cancelling_loads, &hard_drawing::graded_mesh, &hard_drawing::pairs_alone,
        &hard_drawing::near_tipping,     &hard_drawing::soft_matrix, &hard_drawing::spring_decades};
    u_ = random_.chance(0.5) ? 0 : random_.whole(-12, 12);
    e_ = random_.whole(-6, 6);
    p_.title = fmt::format("hard problem of kind {}", kind);
    // With `->*draws[..]`, g++ 12 warns about a wrong index.
    const auto draw_it = draws[kind];
    (this->*draw_it)();
    return std::move(p_);
  }

 private:
  using drawn = std::function<double()>;

  int two_digits() { return random_.whole(10, 99); }
  double either_way(double x) { return random_.chance(0.5) ? x : -x; }
  /// Return 1.0 to 9.9 times 10^exponent, in the units of lengths, forces or moments.
  double length(int exponent) { return decimal(two_digits(), exponent - 1 + u_); }
  double force(int exponent) { return decimal(two_digits(), exponent - 1 + e_ - 2 * u_); }
  double moment(int exponent) { return decimal(two_digits(), exponent - 1 + e_ - u_); }
  double stiffness(int exponent) { return decimal(two_digits(), exponent - 1 + e_ - 3 * u_); }
  [[nodiscard]] int last() const { return nodes(p_.geometry) - 1; }

  /// Makes a beam whose nodes are at `at` times 10^(u + exponent).
  void make_beam(const std::vector<std::int64_t>& at, int exponent) {
    beam b;
    for (const std::int64_t x : at) b.x.push_back(decimal(x, exponent + u_));
    b.EI.assign(at.size() - 1, decimal(two_digits(), e_ - 1));
    p_.geometry.kind = std::move(b);
  }
  /// Makes a beam with elements of 0.3 to 1.7.
  void make_beam(int elements) {
    std::vector<std::int64_t> at{0};
    for (int i = 0; i < elements; ++i) at.push_back(at.back() + random_.whole(3, 17));
    make_beam(at, -1);
  }

  void fix(int node, int dof) { p_.supports.push_back({node, dof, true, 0.0}); }
  /// Adds the supports of a cantilever, of a simple beam, or of a propped cantilever.
  void hold() {
    const int how = random_.whole(0, 2);
    fix(0, 0);
    if (how != 1) fix(0, 1);
    if (how != 0) fix(last(), 0);
  }
  bool hold_by_chance(double share) {
    const bool held = random_.chance(share);
    if (held) hold();
    return held;
  }
  [[nodiscard]] bool is_fixed(int node) const {
    return std::ranges::any_of(p_.supports,
                               [node](const support& s) { return s.fixed && s.node == node && s.dof == 0; });
  }

  void pair(int node, int surface, double gap, double k) {
    p_.pairs.push_back({node, surface, gap == 0.0 ? 0.0 : surface * gap, k, gap == 0.0});
  }
  /// Adds pairs at some of the nodes that are not fixed, and at least one pair.
  void pairs(double density, int surface, const drawn& gap, const drawn& k) {
    const auto place = [&](int node) {
      const double of_pair = gap();  // drawn before the stiffness, in a defined order
      pair(node, surface, of_pair, k());
    };
    for (int node = 0; node <= last(); ++node)
      if (!is_fixed(node) && random_.chance(density)) place(node);
    if (p_.pairs.empty()) place(is_fixed(last()) ? 1 : last());
  }
  /// Adds pairs below both ends and below some nodes between.
  void pairs_below(const drawn& gap, const drawn& k) {
    for (int node = 0; node <= last(); ++node) {
      if (node != 0 && node != last() && !random_.chance(0.5)) continue;
      const double of_pair = gap();
      pair(node, face_below, of_pair, k());
    }
  }
  void pairs_of(bool held, double density, const drawn& gap, const drawn& k) {
    held ? pairs(density, face_below, gap, k) : pairs_below(gap, k);
  }

  int node_between() { return random_.whole(1, last() - 1); }
  void step(std::vector<point_load> points) { p_.steps.push_back({std::move(points), {}}); }

  /// Pairs are up to 1e18 times as stiff as the beam.
  void stiff_pairs() {
    make_beam(random_.whole(2, 5));
    hold();
    const int depth = random_.whole(-5, 0);
    const int stiff = random_.whole(8, 18);
    pairs(
        0.6, face_below, [&] { return random_.chance(0.2) ? 0.0 : length(depth - random_.whole(0, 2)); },
        [&] { return stiffness(random_.chance(0.7) ? stiff : random_.whole(0, 18)); });
    const int steps = random_.whole(1, 3);
    for (int i = 0; i < steps; ++i)
      step({{random_.whole(1, last()), 0, i == 0 ? -force(depth + 1) : either_way(force(depth + 1))}});
    if (random_.chance(0.3)) step({{last(), 0, 0.0}});
  }

  /// A free beam falls on its pairs from up to 1e6 times its length.
  void drop() {
    make_beam(random_.whole(2, 5));
    const int height = random_.whole(0, 6);
    const int k = random_.whole(-2, 8);
    pairs_below([&] { return length(height); }, [&] { return stiffness(k); });
    step({{node_between(), 0, -force(random_.whole(-3, 1))}});
    if (random_.chance(0.3)) step({{node_between(), 0, -force(random_.whole(-3, 1))}});
  }

  /// A load is 1e4 to 1e12 times smaller than the load before it. It moves the pairs by about 10^(small - k),
  /// the order of their gaps.
  void small_after_large() {
    make_beam(random_.whole(3, 6));
    if (random_.chance(0.5)) return large_between_two_pairs();
    const bool held = hold_by_chance(0.4);
    const int small = random_.whole(-4, 0);
    const int k = random_.whole(-1, 3);
    const auto gap = [&] { return random_.chance(0.5) ? 0.0 : length(small - k + random_.whole(-1, 3)); };
    const auto of_pair = [&] { return stiffness(k); };
    pairs_of(held, 0.8, gap, of_pair);
    step({{node_between(), 0, -force(small + random_.whole(4, 12))}});
    step({{node_between(), 0, -force(small)}});
    if (random_.chance(0.5)) step({{node_between(), 0, -force(small)}});
  }

  /// The large load presses two pairs without gaps. The small load acts beyond them and turns the beam onto a
  /// third pair, so the first pair separates at the very end of the step.
  void large_between_two_pairs() {
    const int small = random_.whole(-4, 0);
    const int k = random_.whole(-1, 3);
    pair(0, face_below, 0.0, stiffness(k));
    pair(2, face_below, 0.0, stiffness(k));
    const double gap = length(small - k + random_.whole(-1, 3));
    pair(last(), face_below, gap, stiffness(k));
    step({{1, 0, -force(small + random_.whole(4, 12))}});
    step({{last() == 3 ? 3 : last() - 1, 0, -force(small)}});
  }

  /// Large loads have a small resultant.
  void cancelling_loads() {
    std::vector<std::int64_t> at(static_cast<std::size_t>(random_.whole(3, 6)) + 1);
    std::iota(at.begin(), at.end(), 0);
    make_beam(at, 0);
    const bool held = hold_by_chance(0.3);
    const int small = random_.whole(-4, 0);
    const auto gap = [&] { return random_.chance(0.5) ? 0.0 : length(small); };
    const auto k = [&] { return stiffness(random_.whole(-3, 3)); };
    pairs_of(held, 0.7, gap, k);
    const int large = two_digits();
    const int exponent = small - 1 + random_.whole(6, 13) + e_ - 2 * u_;
    const int middle = random_.whole(1, last() - 1);
    std::vector<point_load> points;
    for (const auto& [node, share] : {std::pair(middle - 1, 1), {middle, -2}, {middle + 1, 1}})
      points.push_back({node, 0, decimal(std::int64_t{share} * large, exponent)});
    points.push_back({0, 0, -force(small)});
    points.push_back({last(), 0, -force(small)});
    step(std::move(points));
    if (random_.chance(0.3)) step({{node_between(), 0, -force(small)}});
  }

  /// Elements are 1e5 times as long as others, or far from x = 0.
  void graded_mesh() {
    const bool far = random_.chance(0.3);
    constexpr std::int64_t offset = 100'000'000;
    std::vector<std::int64_t> at{far ? 10 * offset : 0};
    const int elements = random_.whole(3, 6);
    for (int i = 0; i < elements; ++i) {
      std::int64_t element = random_.whole(1, 9);
      for (int decades = far ? 0 : random_.whole(0, 5); decades > 0; --decades) element *= 10;
      at.push_back(at.back() + element);
    }
    make_beam(at, far ? -1 : -5);
    const bool held = hold_by_chance(0.7);
    pairs_of(
        held, 0.6, [&] { return random_.chance(0.3) ? 0.0 : length(-3); },
        [&] { return stiffness(random_.whole(0, 6)); });
    for (int steps = random_.whole(1, 3); steps > 0; --steps)
      step({{node_between(), 0, -force(random_.whole(-3, 1))}});
  }

  void pairs_alone() {
    make_beam(random_.whole(2, 6));
    pairs_below([&] { return random_.chance(0.5) ? 0.0 : length(random_.whole(-6, 0)); },
                [&] { return stiffness(random_.whole(-1, 8)); });
    for (int steps = random_.whole(1, 4); steps > 0; --steps) {
      std::vector<point_load> points{{random_.whole(0, last()), 0, -force(0)}};
      if (random_.chance(0.5)) points.push_back({random_.whole(0, last()), 0, either_way(force(-1))});
      if (random_.chance(0.3)) points.push_back({random_.whole(0, last()), 1, either_way(moment(-1))});
      step(std::move(points));
    }
  }

  /// The load acts over the first or the last pair. Without the moment, the beam balances on this pair.
  void near_tipping() {
    make_beam(random_.whole(2, 4));
    const int first = random_.whole(0, last() - 1);
    const int second = random_.whole(first + 1, last());
    const int k = random_.whole(0, 8);
    for (int node = first; node <= second; ++node)
      if (node == first || node == second || random_.chance(0.5)) pair(node, face_below, 0.0, stiffness(k));
    const int under = random_.chance(0.5) ? first : second;
    std::vector<point_load> points{{under, 0, -force(0)}};
    if (random_.chance(0.9)) points.push_back({under, 1, either_way(moment(-random_.whole(8, 16)))});
    step(std::move(points));
  }

  /// Makes a chain of springs of stiffness 1 whose last spring has a stiffness of eps.
  void soft_matrix() {
    const int n = random_.whole(2, 4);
    assembled a;
    a.name = "K.mtx";
    a.stiffness.order = n;
    const int places = random_.whole(3, 14);
    std::int64_t one = 1;
    for (int i = 0; i < places; ++i) one *= 10;
    const std::int64_t eps = random_.chance(0.1) ? 0 : random_.whole(1, 99);
    for (int i = 0; i < n; ++i) {
      const bool inner = i > 0 && i + 1 < n;
      a.stiffness.entries.push_back({i, i, i + 1 == n ? decimal(one + eps, -places) : inner ? 2.0 : 1.0});
      if (i + 1 < n) a.stiffness.entries.push_back({i + 1, i, -1.0});
    }
    p_.geometry.kind = std::move(a);
    const int surface = random_.chance(0.7) ? face_above : face_below;
    p_.pairs.push_back(
        {n - 1, surface, surface * decimal(two_digits(), -1), decimal(two_digits(), -1), false});
    if (random_.chance(0.3))
      p_.pairs.push_back({0, surface, surface * decimal(two_digits(), -1), decimal(two_digits(), -1), false});
    const std::int64_t rest = random_.whole(1, 199);
    step({{0, 0, 1.0}, {n - 1, 0, decimal(surface * rest - one, -places)}});
    if (random_.chance(0.3)) step({{0, 0, decimal(two_digits(), -2)}});
  }

  void spring_decades() {
    make_beam(random_.whole(2, 5));
    const auto k = [&] { return stiffness(random_.whole(-8, 8)); };
    for (int node = 0; node <= last(); ++node)
      if (node == 0 || node == last() || random_.chance(0.3)) p_.supports.push_back({node, 0, false, k()});
    if (random_.chance(0.5))
      p_.supports.push_back({random_.whole(0, last()), 1, false, moment(random_.whole(-8, 8))});
    pairs(
        0.6, random_.chance(0.5) ? face_below : face_above,
        [&] { return random_.chance(0.3) ? 0.0 : length(random_.whole(-6, 2)); }, k);
    for (int steps = random_.whole(1, 3); steps > 0; --steps)
      step({{random_.whole(0, last()), 0, either_way(force(random_.whole(-3, 1)))}});
  }

  random_numbers random_;
  problem p_;
  int u_ = 0, e_ = 0;
};

}  // namespace

problem make_hard_problem(std::uint64_t seed, std::uint64_t number, int kind) {
  return hard_drawing(seed, number, kind).draw(kind);
}

}  // namespace contct::referee
