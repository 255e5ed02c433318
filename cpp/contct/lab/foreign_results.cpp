#include "contct/lab/foreign_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/read/json_reader.hpp"

namespace contct {
namespace {

std::string name_of(const verification_case& c) {
  return c.file.substr(0, c.file.rfind('.'));
}

std::string step_words(const expected_number& e) {
  return fmt::format("step {}, {}", e.step, quantity_words(e));
}

bool is_same(const expected_number& a, const expected_number& b) {
  return a.step == b.step && a.quantity == b.quantity && a.node == b.node && a.pair == b.pair &&
         a.element == b.element && a.place == b.place && a.dof == b.dof && a.change == b.change &&
         a.from == b.from && a.along == b.along;
}

auto find_same(const std::vector<expected_number>& all, const expected_number& e) {
  return std::ranges::find_if(all, [&](const expected_number& other) { return is_same(other, e); });
}

bool is_count_or_state(const expected_number& e) {
  return e.quantity == "state" || e.quantity == "contacts" || e.quantity == "events";
}

/// The number by which the error of `e` is divided; `all` are the numbers of the same problem.
double size_of(const expected_number& e, const std::vector<expected_number>& all) {
  if (e.quantity == "event" || is_count_or_state(e)) return 1.0;
  const kind_of_number kind = kind_of(e);
  double size = 0.0;
  for (const expected_number& other : all)
    if (kind == kind_of_number::other ? other.quantity == e.quantity : kind_of(other) == kind)
      size = std::max(size, std::abs(exact_value(other)));
  return size == 0.0 ? 1.0 : size;
}

/// Lists the table's numbers for a step, for a message.
std::string known_in_step(const std::vector<expected_number>& all, int step) {
  std::string words;
  for (const expected_number& e : all)
    if (e.step == step) words += (words.empty() ? "" : "; ") + quantity_words(e);
  return words.empty() ? "a step of this problem in verification.toml" : words;
}

void judge_entry(const toml_value& entry, const std::vector<expected_number>& all, double tolerance,
                 foreign_case& c) {
  const expected_number asked = read_place(entry);
  const std::string words = fmt::format("{} in step {}", quantity_words(asked), asked.step);
  const auto at = find_same(all, asked);
  if (at == all.end()) entry.refuse(words, known_in_step(all, asked.step));
  if (std::ranges::any_of(c.numbers, [&](const foreign_number& n) { return is_same(n.expected, asked); }))
    entry.refuse(words + ", a second time", "each number once");
  const toml_value value = entry["value"];
  foreign_number& n = c.numbers.emplace_back(foreign_number{*at});
  n.given = at->quantity != "state"                       ? value.real(any_real)
            : value.choice({"contact", "separated"}) == 0 ? in_contact
                                                          : separated;
  n.error = std::abs(n.given - exact_value(*at)) / size_of(*at, all);
  n.passed = n.error <= (is_count_or_state(*at) ? 0.0 : tolerance);
  if (!n.passed)
    c.failures.push_back(fmt::format("{}: found {:.10g}; exact value {}; error {:.1e}; allowed: {:.1e}",
                                     step_words(*at), n.given, at->exact, n.error, tolerance));
  c.largest_error = std::max(c.largest_error, n.error);
}

foreign_case judge_case(const toml_value& given, const verification_case& of, double tolerance) {
  foreign_case c{name_of(of)};
  std::vector<expected_number> all;  // each number once, even if the table has several sources
  for (const expected_number& e : of.checks)
    if (find_same(all, e) == all.end()) all.push_back(e);
  std::vector<std::string_view> keys(place_keys.begin(), place_keys.end());
  keys.emplace_back("value");
  for (const toml_value& entry : given.entries("an array of at least one number", 1)) {
    entry.table().allow_only(keys);
    judge_entry(entry, all, tolerance, c);
  }
  for (const expected_number& e : all)
    if (std::ranges::none_of(c.numbers, [&](const foreign_number& n) { return is_same(n.expected, e); }))
      c.not_given.push_back(step_words(e));
  return c;
}

}  // namespace

foreign_results judge_results(const std::string& path, const std::vector<verification_case>& table) {
  const json_tree document = parse_json(read_input(path, "file of results"), path);
  const toml_value top(document.table, path, document.places);
  top.allow_only({"format", "program", "version", "tolerance", "problems"});
  (void)top["format"].choice({"contct-answers-1"});
  constexpr real_range tolerances{0.0, true, "a number from 0 to 0.1", 0.1};
  foreign_results r{top["program"].text(), top["version"].text(), top["tolerance"].real(tolerances)};
  const toml_value problems = top["problems"].table();
  std::vector<std::string> known;
  for (const verification_case& of : table) {
    known.push_back(name_of(of));
    if (!problems.has(known.back())) {
      r.not_given.push_back(known.back());
      continue;
    }
    const foreign_case& c = r.cases.emplace_back(judge_case(problems[known.back()], of, r.tolerance));
    r.judged += c.numbers.size();
    r.failed += c.failures.size();
  }
  problems.allow_only({known.begin(), known.end()});
  return r;
}

}  // namespace contct
