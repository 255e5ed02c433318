#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "contct/number/rational.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/explain.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

constexpr int shown_digits = 20;

std::string exact_number(const rational& x) {
  return short_words(x, shown_digits);
}

/// "no pair", "pair 1", "pairs 1, 2 and 3", of pairs from 0.
std::string counted_pairs(const std::vector<int>& pairs) {
  if (pairs.empty()) return "no pair";
  std::string words = pairs.size() == 1 ? "pair " : "pairs ";
  for (std::size_t i = 0; i < pairs.size(); ++i)
    words += fmt::format("{}{}", i == 0 ? "" : i + 1 == pairs.size() ? " and " : ", ", pairs[i] + 1);
  return words;
}

/// "+0.31 ULP", "exact", or what the number is.
std::string off_words(double x, const rational& exactly, int real_bytes) {
  if (!std::isfinite(x)) return fmt::format("{}", x);
  const double error = error_in_ulps(x, exactly, real_bytes);
  if (error == 0.0) return "exact";
  const double size = std::abs(error);
  if (size < 100.0) return fmt::format("{:+.2f} ULP", error);
  return size < 1e6 ? fmt::format("{:+.0f} ULP", error) : fmt::format("{:+.3g} ULP", error);
}

/// "fortran and cpp +0.31 ULP", "fortran +0.31 ULP, cpp exact".
std::string errors_words(const explained_kernels& of, double first, const double* second,
                         const rational& exactly) {
  const std::string of_first = off_words(first, exactly, of.real_bytes);
  if (second == nullptr) return fmt::format("{} {}", of.names[0], of_first);
  const std::string of_second = off_words(*second, exactly, of.real_bytes);
  if (of_first == of_second) return fmt::format("{} and {} {}", of.names[0], of.names[1], of_first);
  return fmt::format("{} {}, {} {}", of.names[0], of_first, of.names[1], of_second);
}

const double* other_s(const explained_increment& i, const explained_pair& p) {
  return i.other == nullptr ? nullptr : &i.other->ss[static_cast<std::size_t>(p.pair)];
}

const double* other_smin(const explained_increment& i) {
  return i.other == nullptr ? nullptr : &i.other->smin;
}

/// Pairs, from 0, that CONTCT toggled.
std::vector<int> toggled_in(const explained_call& c) {
  std::vector<int> pairs;
  for (const explained_pair& p : c.pairs)
    if (p.toggled()) pairs.push_back(p.pair);
  return pairs;
}

std::string events_words(std::span<const event> events) {
  std::vector<std::string> words;
  for (const event& e : events)
    words.push_back(fmt::format("pair {} {}", e.pair + 1, e.what == change::make ? "makes" : "breaks"));
  return words.empty() ? "none" : joined(words, ", ");
}

/// s where the exact answer reached it by the branch that the kernel took; otherwise that it did not.
added_remark s_remark(const explained_kernels& of, const explained_increment& i, const explained_pair& p,
                      const listing_answer& a, std::string_view where) {
  const auto pair = static_cast<std::size_t>(p.pair);
  if (a.way[pair] != p.way)
    return {fmt::format("s {}: {}, by another branch: there the pair is {}{}.", where,
                        exact_number(a.s[pair]), kind_name(a.way[pair], p.isep_before == separated),
                        a.s[pair] == 1 ? ", and 1 is the mark" : ""),
            true};
  return {fmt::format("s {}: {}; {}.", where, exact_number(a.s[pair]),
                      errors_words(of, p.s, other_s(i, p), a.s[pair]))};
}

json errors_json(const explained_kernels& of, double first, const double* second, const rational& exactly) {
  const auto error = [&](double x) -> json {
    if (!std::isfinite(x)) return nullptr;
    return error_in_ulps(x, exactly, of.real_bytes);
  };
  json out = {{of.names[0], error(first)}};
  if (second != nullptr) out[of.names[1]] = error(*second);
  return out;
}

json answer_json(const explained_kernels& of, const explained_increment& i, const listing_answer& a) {
  return {{"smin", fraction_words(a.s_min)},
          {"ulps_off", errors_json(of, i.call.smin, other_smin(i), a.s_min)},
          {"winners", numbered(a.winners())},
          {"toggled", numbered(a.toggled)}};
}

json pair_answer_json(const explained_kernels& of, const explained_increment& i, const explained_pair& p,
                      const listing_answer& a) {
  const auto pair = static_cast<std::size_t>(p.pair);
  return {{"s", fraction_words(a.s[pair])},
          {"kind", kind_name(a.way[pair], p.isep_before == separated)},
          {"ulps_off", errors_json(of, p.s, other_s(i, p), a.s[pair])}};
}

}  // namespace

std::optional<listing_answer> answer_of(const explained_call& c) {
  std::vector<listing_pair> pairs;
  for (const explained_pair& p : c.pairs) {
    if (!std::isfinite(p.c) || !std::isfinite(p.d) || !std::isfinite(p.d_star)) return std::nullopt;
    pairs.push_back({binary_value(p.c), binary_value(p.d), binary_value(p.d_star),
                     p.isep_before == in_contact, p.surface});
  }
  return answer_exactly(pairs);
}

exact_addition::remarks exact_addition::of_s(const explained_kernels& of, const explained_increment& i,
                                             const explained_pair& p) const {
  remarks all;
  if (!call_) {
    all.push_back({"Not every number of this call is finite: there is no exact s.", true});
  } else {
    all.push_back(s_remark(of, i, p, *call_, "exactly, from the numbers of this call"));
  }
  if (const exact_call* const c = path_call())
    all.push_back(s_remark(of, i, p, c->answer, "on the exact path"));
  return all;
}

exact_addition::remarks exact_addition::of_smin(const explained_kernels& of,
                                                const explained_increment& i) const {
  remarks all;
  const auto number_and_errors = [&](const rational& s_min) {
    return exact_number(s_min) + "; " + errors_words(of, i.call.smin, other_smin(i), s_min);
  };
  if (call_) {
    const std::vector<int> here = toggled_in(i.call);
    const bool same = call_->toggled == here;
    all.push_back({fmt::format("SMIN exactly, from the numbers of this call: {}. Exactly, {} {} toggled{}.",
                               number_and_errors(call_->s_min), counted_pairs(call_->toggled),
                               call_->toggled.size() > 1 ? "are" : "is",
                               same ? ", as here" : "; here " + counted_pairs(here)),
                   !same});
  }
  const exact_call* const c = path_call();
  if (c == nullptr) return all;
  all.push_back({fmt::format("SMIN on the exact path: {}.", number_and_errors(c->answer.s_min))});
  if (const std::vector<int> tied = c->answer.winners(); tied.size() > 1)
    all.push_back({fmt::format("A tie: there {} have exactly this s.", counted_pairs(tied))});
  return all;
}

exact_addition::remarks exact_addition::of_end(const explained_kernels& of,
                                               const explained_increment& i) const {
  if (path_ == nullptr) return {{"The exact path is not followed: " + why_no_path_ + "."}};
  if (!path_->stopped().empty())
    return {{fmt::format("The exact path is not shown: {}.", path_->stopped()), true}};
  const exact_call* const c = path_call();
  if (c == nullptr)
    return {{fmt::format("The exact path has had other events since {}.{}: its numbers are not shown.",
                         path_->parted()->step, path_->parted()->increment),
             true}};
  const std::string share = exact_number(c->led_to.fraction);
  if (!path_->parted())
    return {
        {fmt::format("The exact path has the same events. It has reached the share {} of the step; here {}.",
                     share, off_words(i.what.fraction, c->led_to.fraction, of.real_bytes))}};
  return {{fmt::format("The exact path has other events, at share {} of the step: {}; here: {}. From now on "
                       "it is not shown, because its calls are no longer those of this path.",
                       share, events_words(c->led_to.events), events_words(i.what.events)),
           true}};
}

json exact_addition::path_json(const explained_kernels& of, const explained_increment& i) const {
  if (path_ == nullptr) return {{"stopped", why_no_path_}};
  json out = json::object();
  if (const exact_call* const c = path_->call()) {
    out = answer_json(of, i, c->answer);
    out["fraction"] = fraction_words(c->led_to.fraction);
    out["fraction_ulps_off"] = error_in_ulps(i.what.fraction, c->led_to.fraction, of.real_bytes);
  }
  if (const auto& at = path_->parted()) out["parted"] = {{"step", at->step}, {"increment", at->increment}};
  if (!path_->stopped().empty()) out["stopped"] = path_->stopped();
  return out;
}

void exact_addition::put_increment(json& out, const explained_kernels& of,
                                   const explained_increment& i) const {
  out["exact"] = nullptr;
  if (call_) out["exact"] = answer_json(of, i, *call_);
  out["exact_path"] = path_json(of, i);
}

void exact_addition::put_pair(json& out, const explained_kernels& of, const explained_increment& i,
                              const explained_pair& p) const {
  out["exact"] = nullptr;
  if (call_) out["exact"] = pair_answer_json(of, i, p, *call_);
  out["exact_path"] = nullptr;
  if (const exact_call* const c = path_call()) out["exact_path"] = pair_answer_json(of, i, p, c->answer);
}

}  // namespace contct
