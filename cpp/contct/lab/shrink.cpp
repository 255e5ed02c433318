#include "contct/lab/shrink.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <utility>

#include "contct/numeric/bits.hpp"
#include "contct/outside/registry.hpp"

namespace contct::lab {
namespace {

/// `x` with `digits` significant decimal digits.
double rounded(double x, int digits) {
  char text[64];
  (void)std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return std::strtod(text, nullptr);
}

/// The numbers rounder than `x`, the roundest first. Each is rounder than those after it and than `x`, so
/// that shrinking ends.
std::vector<double> rounder_than(double x) {
  std::vector<double> all;
  const auto offer = [&all, x](double y) {
    const bool known = std::any_of(all.begin(), all.end(), [y](double z) { return same_bits(y, z); });
    if (!known && !same_bits(x, y)) all.push_back(y);
  };
  constexpr double roundest[] = {0.0, 1.0, -1.0, 0.5, -0.5, 2.0};
  for (const double r : roundest) {
    if (same_bits(x, r)) return all;
    offer(r);
  }
  if (!std::isfinite(x)) return all;
  constexpr int all_digits = 6;
  for (int digits = 1; digits <= all_digits; ++digits) {
    const double r = rounded(x, digits);
    if (same_bits(x, r)) return all;
    offer(r);
  }
  return all;
}

/// The call without pairs `from` to `to`.
call_inputs<double> without(const call_inputs<double>& in, int from, int to) {
  call_inputs<double> out = in;
  const auto cut = [from, to](auto& list) { list.erase(list.begin() + from, list.begin() + to); };
  cut(out.cc);
  for (auto* list : {&out.id, &out.isep, &out.isurf}) cut(*list);
  return out;
}

/// The call with one dof a node, and nodes from 1 in the order of the pairs.
call_inputs<double> compact(const call_inputs<double>& in) {
  call_inputs<double> out;
  out.cc = in.cc;
  out.isep = in.isep;
  out.isurf = in.isurf;
  std::vector<std::size_t> dofs;
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    const std::size_t dof = in.dof_of_pair(i);
    const auto known = std::find(dofs.begin(), dofs.end(), dof);
    out.id.push_back(static_cast<int>(known - dofs.begin()) + 1);
    if (known != dofs.end()) continue;
    dofs.push_back(dof);
    out.dd.push_back(in.dd[dof]);
    out.dtest.push_back(in.dtest[dof]);
  }
  return out;
}

class shrinker {
 public:
  shrinker(call_sequence calls, const still_differs& differs, int most_tries)
      : calls_(std::move(calls)), differs_(differs), tries_left_(most_tries) {}

  call_sequence go() {
    fewer_calls();
    for (std::size_t c = calls_.size(); c-- > 0;) {
      fewer_pairs(c);
      replace(c, compact(calls_[c]));
      rounder_numbers(c);
    }
    return std::move(calls_);
  }

 private:
  bool accept(call_sequence candidate) {
    if (tries_left_ <= 0) return false;
    --tries_left_;
    if (!differs_(candidate)) return false;
    calls_ = std::move(candidate);
    return true;
  }

  bool replace(std::size_t c, call_inputs<double> smaller) {
    call_sequence candidate = calls_;
    candidate[c] = std::move(smaller);
    return accept(std::move(candidate));
  }

  /// The last call alone, the last two, four, ...; then each of the others left out.
  void fewer_calls() {
    const int all = static_cast<int>(calls_.size());
    for (int kept = 1; kept < all; kept *= 2) {
      if (accept({calls_.end() - kept, calls_.end()})) break;
    }
    for (int c = static_cast<int>(calls_.size()); c-- > 1;) {
      call_sequence candidate = calls_;
      candidate.erase(candidate.begin() + c - 1);
      (void)accept(std::move(candidate));
    }
  }

  /// Halves, then quarters, ... then single pairs left out.
  void fewer_pairs(std::size_t c) {
    const auto pairs = [this, c] { return static_cast<int>(calls_[c].pairs()); };
    for (int chunk = (pairs() + 1) / 2; chunk > 0; chunk = chunk == 1 ? 0 : (chunk + 1) / 2) {
      for (int from = 0; from < pairs();) {
        const int to = std::min(from + chunk, pairs());
        if (!replace(c, without(calls_[c], from, to))) from = to;
      }
    }
  }

  template <class Number>
  bool try_at(std::size_t c, std::vector<Number> call_inputs<double>::*list, std::size_t i, Number simpler) {
    call_sequence candidate = calls_;
    (candidate[c].*list)[i] = simpler;
    return accept(std::move(candidate));
  }

  void rounder(std::size_t c, std::vector<double> call_inputs<double>::*list, std::size_t i) {
    const double x = (calls_[c].*list)[i];
    for (const double r : rounder_than(x)) {
      if (try_at(c, list, i, r)) return;
    }
  }

  /// The same scale factor from D = 0 and d* = 1: values that depend on each other are simplified together.
  void plainer_pair(std::size_t c, std::size_t i) {
    const call_inputs<double>& in = calls_[c];
    const std::size_t dof = in.dof_of_pair(i);
    const double s = (in.cc[i] - in.dd[dof]) / in.dtest[dof];
    if (!std::isfinite(s) || (in.dd[dof] == 0.0 && in.dtest[dof] == 1.0)) return;
    call_inputs<double> plainer = in;
    plainer.dd[dof] = 0.0;
    plainer.dtest[dof] = 1.0;
    plainer.cc[i] = s;
    (void)replace(c, std::move(plainer));
  }

  /// All numbers of a call, again until none becomes rounder: one number may become so only after another
  /// did.
  void rounder_numbers(std::size_t c) {
    constexpr int most_rounds = 4;
    for (int round = 0; round < most_rounds; ++round) {
      const int left_before = tries_left_;
      const call_inputs<double> before = calls_[c];
      for (std::size_t i = 0; i < calls_[c].pairs(); ++i) {
        const std::size_t dof = calls_[c].dof_of_pair(i);
        plainer_pair(c, i);
        rounder(c, &call_inputs<double>::dd, dof);
        rounder(c, &call_inputs<double>::dtest, dof);
        rounder(c, &call_inputs<double>::cc, i);
        if (calls_[c].isep[i] != separated) try_at(c, &call_inputs<double>::isep, i, separated);
        if (calls_[c].isurf[i] != face_above) try_at(c, &call_inputs<double>::isurf, i, face_above);
      }
      if (tries_left_ <= 0 || tries_left_ == left_before || same(before, calls_[c])) return;
    }
  }

  static bool same(const call_inputs<double>& a, const call_inputs<double>& b) {
    const auto equal = [](const std::vector<double>& x, const std::vector<double>& y) {
      return std::equal(x.begin(), x.end(), y.begin(), y.end(), same_bits<double>);
    };
    return equal(a.dd, b.dd) && equal(a.dtest, b.dtest) && equal(a.cc, b.cc) && a.isep == b.isep &&
           a.isurf == b.isurf;
  }

  call_sequence calls_;
  const still_differs& differs_;
  int tries_left_;
};

}  // namespace

call_sequence shrink(call_sequence calls, const still_differs& differs, int most_tries) {
  return shrinker(std::move(calls), differs, most_tries).go();
}

std::optional<found_case> reproduce(kernel& leader, const std::string& follower, const call_sequence& calls,
                                    const std::string& field) {
  const std::unique_ptr<kernel> fresh = make_kernel(follower);
  found_case c;
  c.real_bytes = leader.facts().real_bytes;
  c.calls = calls;
  std::optional<mismatch> last;
  call_outputs its;
  tally ignored;
  (void)leader.take_text();
  for (const call_inputs<double>& in : calls) {
    call_outputs& out = c.leader.emplace_back();
    call<double> asked = out.prepare(in);
    leader.answer(asked);
    out.smin = asked.smin;
    out.text = leader.take_text();
    const auto text = leader.facts().has_text ? std::optional<std::string_view>(out.text) : std::nullopt;
    last = ask_and_compare(*fresh, asked, in.isep, text, text_equality_of(leader.facts(), fresh->facts()),
                           its, ignored);
    c.what.decisions = decisions_of(asked, in.isep, c.real_bytes);
  }
  if (!last || (!field.empty() && last->field != field)) return {};
  c.what.call = static_cast<std::int64_t>(calls.size());
  c.what.leader = leader.facts().name;
  c.what.follower = follower;
  c.what.where = *last;
  return c;
}

std::optional<found_case> shrunk_case(kernel& leader, const std::string& follower, const call_sequence& calls,
                                      const std::string& field, int most_tries) {
  const still_differs differs = [&](const call_sequence& candidate) {
    return reproduce(leader, follower, candidate, field).has_value();
  };
  if (!differs(calls)) return {};
  return reproduce(leader, follower, shrink(calls, differs, most_tries), field);
}

}  // namespace contct::lab
