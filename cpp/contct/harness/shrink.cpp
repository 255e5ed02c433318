#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "contct/harness/fuzz.hpp"
#include "contct/number/bits.hpp"

namespace contct {
namespace {

/// `x` with `digits` significant decimal digits.
double rounded(double x, int digits) {
  char text[64];
  (void)std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return std::strtod(text, nullptr);
}

/// Numbers rounder than `x`, the roundest first; never `x` itself, so that shrinking ends.
std::vector<double> rounder_than(double x) {
  std::vector<double> all;
  const auto is_rounder = [&all, x](double y) {  // also adds `y` to `all`, without repetition
    if (same_bits(x, y)) return false;
    if (std::none_of(all.begin(), all.end(), [y](double z) { return same_bits(y, z); })) all.push_back(y);
    return true;
  };
  for (const double r : {0.0, 1.0, -1.0, 0.5, -0.5, 2.0})
    if (!is_rounder(r)) return all;
  constexpr int all_digits = 6;
  for (int digits = 1; std::isfinite(x) && digits <= all_digits; ++digits)
    if (!is_rounder(rounded(x, digits))) return all;
  return all;
}

/// The same call with one dof for each node, and with nodes from 1 in the order of the pairs.
call_inputs with_dofs_of_pairs(const call_inputs& in) {
  call_inputs out;
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
      try_with(c, [](call_inputs& in) { in = with_dofs_of_pairs(in); });
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
    changed_ = true;
    return true;
  }

  template <class Change>
  bool try_with(std::size_t c, Change change) {
    call_sequence candidate = calls_;
    change(candidate[c]);
    return accept(std::move(candidate));
  }

  /// Tries the last call alone, then the last 2, 4, ... calls; then removes each earlier call, if possible.
  void fewer_calls() {
    const int all = static_cast<int>(calls_.size());
    for (int kept = 1; kept < all; kept *= 2) {
      if (accept({calls_.end() - kept, calls_.end()})) break;
    }
    for (int c = static_cast<int>(calls_.size()); c-- > 1;) {
      call_sequence candidate = calls_;
      candidate.erase(candidate.begin() + c - 1);
      accept(std::move(candidate));
    }
  }

  /// Tries to remove each half of the pairs, then each quarter, ... then each pair.
  void fewer_pairs(std::size_t c) {
    const auto pairs = [this, c] { return static_cast<int>(calls_[c].pairs()); };
    for (int chunk = (pairs() + 1) / 2; chunk > 0; chunk = chunk == 1 ? 0 : (chunk + 1) / 2) {
      for (int from = 0; from < pairs();) {
        const int to = std::min(from + chunk, pairs());
        const auto cut = [from, to](auto& list) { list.erase(list.begin() + from, list.begin() + to); };
        const bool cut_out = try_with(c, [&cut](call_inputs& in) {
          cut(in.cc);
          for (auto* list : {&in.id, &in.isep, &in.isurf}) cut(*list);
        });
        if (!cut_out) from = to;
      }
    }
  }

  template <class Number>
  bool try_at(std::size_t c, std::vector<Number> call_inputs::*list, std::size_t i, Number simpler) {
    return try_with(c, [&](call_inputs& in) { (in.*list)[i] = simpler; });
  }

  void rounder(std::size_t c, std::vector<double> call_inputs::*list, std::size_t i) {
    for (const double r : rounder_than((calls_[c].*list)[i])) {
      if (try_at(c, list, i, r)) return;
    }
  }

  /// Tries D = 0, d* = 1 and c = s at once, which keeps the scale factor s = (c - D) / d*.
  void plainer_pair(std::size_t c, std::size_t i) {
    const call_inputs& in = calls_[c];
    const std::size_t dof = in.dof_of_pair(i);
    const double s = (in.cc[i] - in.dd[dof]) / in.dtest[dof];
    if (!std::isfinite(s) || (in.dd[dof] == 0.0 && in.dtest[dof] == 1.0)) return;
    try_with(c, [i, dof, s](call_inputs& out) {
      out.dd[dof] = 0.0;
      out.dtest[dof] = 1.0;
      out.cc[i] = s;
    });
  }

  /// Tries rounder numbers, in rounds: a number may become rounder only after another number did.
  void rounder_numbers(std::size_t c) {
    constexpr int most_rounds = 4;
    changed_ = true;
    for (int round = 0; round < most_rounds && changed_; ++round) {
      changed_ = false;
      for (std::size_t i = 0; i < calls_[c].pairs(); ++i) {
        const std::size_t dof = calls_[c].dof_of_pair(i);
        plainer_pair(c, i);
        rounder(c, &call_inputs::dd, dof);
        rounder(c, &call_inputs::dtest, dof);
        rounder(c, &call_inputs::cc, i);
        if (calls_[c].isep[i] != separated) try_at(c, &call_inputs::isep, i, separated);
        if (calls_[c].isurf[i] != face_above) try_at(c, &call_inputs::isurf, i, face_above);
      }
    }
  }

  call_sequence calls_;
  const still_differs& differs_;
  int tries_left_;
  bool changed_ = true;  // a candidate was accepted in this round
};

}  // namespace

call_sequence shrink(call_sequence calls, const still_differs& differs, int most_tries) {
  return shrinker(std::move(calls), differs, most_tries).go();
}

std::optional<found_case> reproduce(kernel& leader, kernel& other, const call_sequence& calls,
                                    const std::string& field) {
  follower asked(leader.facts(), other);
  found_case c;
  (void)leader.take_text();
  for (const call_inputs& in : calls) {
    c.calls.push_back({std::ssize(c.calls) + 1, "", in, answer_of(leader, in)});
    (void)asked.ask(c.calls.back().answered());
  }
  const std::optional<mismatch>& last = asked.difference();
  if (!last || (!field.empty() && last->field != field)) return {};
  c.what = asked.report_of(*last, c.calls.back().answered());
  c.what.lines.clear();  // the lines taken are told of the mismatch that was found, before it was reduced
  return c;
}

std::optional<found_case> shrunk_case(kernel& leader, const fresh_kernel& follower,
                                      const call_sequence& calls, const std::string& field, int most_tries) {
  // A new process for each try would take most of the time. So one kernel is asked every try, and new kernels
  // only confirm what differs. If answers depend on earlier calls, or are missing, each try has a new kernel.
  const std::unique_ptr<kernel> tried = follower();
  const auto differs_in = [&](kernel& k, const call_sequence& c) {
    return bool(reproduce(leader, k, c, field));
  };
  if (!differs_in(*follower(), calls)) return {};
  const bool repeats = field != "answer" && differs_in(*tried, calls) && differs_in(*tried, calls);
  const still_differs differs = [&](const call_sequence& c) {
    return (!repeats || differs_in(*tried, c)) && differs_in(*follower(), c);
  };
  return reproduce(leader, *follower(), shrink(calls, differs, most_tries), field);
}

}  // namespace contct
