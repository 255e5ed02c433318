#include "contct/kernel/trace.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <optional>

#include "contct/number/bits.hpp"
#include "contct/number/probe.hpp"

namespace contct {
namespace {

/// The header lines "key value" after "about", in order. The lines "real" and "rule" follow "kernel". A line
/// with an empty value is omitted.
constexpr std::pair<std::string_view, std::string trace_header::*> trace_facts[] = {
    {"kernel", &trace_header::name},       {"listing", &trace_header::listing},
    {"compiler", &trace_header::compiler}, {"flags", &trace_header::flags},
    {"lapack", &trace_header::lapack},     {"floating-point", &trace_header::floating_point}};

void append_line(std::string& text, std::string_view key, std::string_view value) {
  if (value.empty()) return;
  text.append(key).append(" ").append(value).append("\n");
  // Line ends become blanks: the name of a kernel may be a command of several lines.
  std::replace(text.end() - static_cast<std::ptrdiff_t>(value.size()) - 1, text.end() - 1, '\n', ' ');
}

/// The dofs of a call's pairs, from 0, sorted and without duplicates.
std::vector<std::size_t> addressed_dofs(const call<double>& c) {
  std::vector<std::size_t> dofs;
  dofs.reserve(c.id.size());
  for (const int node : c.id) dofs.push_back(c.dof.dof_of(node) - 1);
  std::ranges::sort(dofs);
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  return dofs;
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
// Invalid values of ISEP and ISURF are accepted, as in 1989, but their product must not overflow.
constexpr int most_status = std::numeric_limits<int>::max();
constexpr std::int64_t most_calls = 1'000'000'000'000'000'000;

constexpr std::string_view dofs_line =
    "\"indof I ndofpn N dofs M nc K\", I and N from 1, M up to 10000000, K up to 10000000";

/// Reads a hexadecimal number such as -0x1.8p+1, a decimal number, inf or nan.
std::optional<double> real_in(std::string_view word) {
  const bool negative = word.starts_with('-');
  if (negative) word.remove_prefix(1);
  const bool hex = word.starts_with("0x");
  if (hex) word.remove_prefix(2);
  // Refuses a second sign, and inf after 0x, which from_chars would accept.
  if (word.starts_with('-') || (hex && word.find_first_of("0123456789abcdefABCDEF") != 0)) return {};
  const auto value = number_in<double>(word, hex ? std::chars_format::hex : std::chars_format::general);
  return value && negative ? -*value : value;
}

/// Reads a line word by word, with one blank between words. After a failure, `done` is false.
class trace_words {
 public:
  explicit trace_words(std::string_view line) : rest_(line) {}

  /// Reads the next word, which must be `word`.
  trace_words& key(std::string_view word) {
    if (next() != word) failed_ = true;
    return *this;
  }

  /// Reads the next two words, which must be `word` and an integer from `least` to `most`.
  template <class Whole>
  trace_words& whole(std::string_view word, Whole& value, std::int64_t least, std::int64_t most) {
    const auto read = key(word).take(number_in<std::int64_t>(next()));
    if (read < least || read > most) failed_ = true;
    if (!failed_) value = static_cast<Whole>(read);
    return *this;
  }

  /// Reads the next two words, which must be `word` and a real number.
  trace_words& real(std::string_view word, double& value) {
    value = key(word).take(real_in(next()));
    return *this;
  }

  /// True if all words were as required and the line has no further word.
  [[nodiscard]] bool done() const { return !failed_ && rest_.empty(); }

 private:
  std::string_view next() {
    const std::size_t end = rest_.find(' ');
    const std::string_view word = rest_.substr(0, end);
    if (word.empty()) failed_ = true;
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    return word;
  }

  template <class Number>
  Number take(const std::optional<Number>& read) {
    if (!read) failed_ = true;
    return read.value_or(Number{});
  }

  std::string_view rest_;
  bool failed_ = false;
};

/// Removes `key` and a blank from the start of `line`. Returns false if `line` has another start.
bool takes(std::string_view& line, std::string_view key) {
  if (!line.starts_with(key) || line.size() <= key.size() || line[key.size()] != ' ') return false;
  line.remove_prefix(key.size() + 1);
  return true;
}

}  // namespace

trace_header header_for(const kernel_facts& k, const std::string& listing, const std::string& lapack) {
  return {k, {}, listing, lapack, describe(probe_floating_point())};
}

void append_header(const trace_header& h, std::string& text) {
  text.append(trace_format).append("\n");
  for (const std::string& line : h.about) append_line(text, "about", line);
  for (const auto& [key, value] : trace_facts) {
    append_line(text, key, h.*value);
    if (key != "kernel") continue;
    append_line(text, "real", std::to_string(h.real_bytes));
    append_line(text, "rule", name_of(h.rule));
  }
}

void append_inputs(const answered_call& answered, std::string_view note, std::string& text) {
  const call<double>& c = answered.c;
  text += "\ncall " + std::to_string(answered.number) + "\n";
  append_line(text, "note", note);
  text += "indof " + std::to_string(c.dof.indof) + " ndofpn " + std::to_string(c.dof.ndofpn) + " dofs " +
          std::to_string(c.dd.size()) + " nc " + std::to_string(c.nc()) + "\n";
  for (const std::size_t dof : addressed_dofs(c)) {
    text += "dof " + std::to_string(dof + 1) + " dd " + hexfloat(c.dd[dof]) + " dtest " +
            hexfloat(c.dtest[dof]) + "\n";
  }
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    text += "pair " + std::to_string(i + 1) + " id " + std::to_string(c.id[i]) + " isep " +
            std::to_string(answered.isep_before[i]) + " isurf " + std::to_string(c.isurf[i]) + " cc " +
            hexfloat(c.cc[i]) + "\n";
  }
  text += "ask\n";
}

void append_answer(double smin, std::span<const double> ss, std::span<const int> isep,
                   std::string_view unit_26, std::string& text) {
  text += "smin " + hexfloat(smin) + "\n";
  for (std::size_t i = 0; i < ss.size(); ++i) {
    text += "pair " + std::to_string(i + 1) + " ss " + hexfloat(ss[i]) + " isep " + std::to_string(isep[i]) +
            "\n";
  }
  while (!unit_26.empty()) {
    const std::size_t end = std::min(unit_26.find('\n'), unit_26.size());
    text.append("|").append(unit_26.substr(0, end)).append("\n");
    unit_26.remove_prefix(std::min(end + 1, unit_26.size()));
  }
  text += "end\n";
}

void append_call(const answered_call& answered, std::string_view note, std::string& text) {
  append_inputs(answered, note, text);
  append_answer(answered.c.smin, answered.c.ss, answered.c.isep, answered.text.value_or(""), text);
}

void trace_reader::refuse(std::string_view found, std::string_view allowed) const {
  constexpr std::size_t most_shown = 80;
  lines_.refuse(printable(found, most_shown), allowed);
}

std::string_view trace_reader::need_line(std::string_view allowed) {
  if (!lines_.next()) refuse("the end of the text", allowed);
  return lines_.here();
}

trace_header trace_reader::read_header() {
  const std::string allowed = "\"" + std::string(trace_format) + "\" as the first line";
  const std::string_view first = need_line(allowed);
  if (first == std::string(trace_format) + "\r") refuse("a line that ends in CR LF", "lines that end in LF");
  if (first != trace_format)
    refuse("a file that is not a trace of this format: " + std::string(first.substr(0, 40)), allowed);
  trace_header h;
  std::vector<std::string_view> keys;
  while (lines_.next() && !lines_.here().empty()) {
    const std::string_view line = lines_.here();
    const std::string_view key = line.substr(0, line.find(' '));
    if (key != "about" && std::ranges::find(keys, key) != keys.end())
      refuse(line, "each key of the header once, except about");
    keys.push_back(key);
    read_header_line(line, h);
  }
  return h;
}

void trace_reader::read_header_line(std::string_view line, trace_header& h) const {
  std::string_view value = line;
  if (takes(value, "about")) {
    h.about.emplace_back(value);
    return;
  }
  if (takes(value, "real")) {
    if (value != "4" && value != "8") refuse(line, R"("real 8" or "real 4")");
    h.real_bytes = value == "4" ? 4 : 8;
    return;
  }
  if (takes(value, "rule")) {
    const auto* const rule = std::ranges::find(rule_names, value);
    if (rule == rule_names.end()) refuse(line, R"("rule listing" or "rule corrected")");
    h.rule = static_cast<contact_rule>(rule - rule_names.begin());
    return;
  }
  const auto* const fact =
      std::ranges::find_if(trace_facts, [&](const auto& f) { return takes(value, f.first); });
  if (fact == std::end(trace_facts))
    refuse(line,
           "about, kernel, real, rule, listing, compiler, flags, lapack, floating-point, or an empty line");
  h.*fact->second = value;
}

bool trace_reader::next(recorded_call& c) {
  if (!next_inputs(c)) return false;
  c.out.ss.resize(c.in.pairs());
  c.out.isep.resize(c.in.pairs());
  read_answer(c.out);
  return true;
}

bool trace_reader::next_inputs(recorded_call& c) {
  do {
    if (!lines_.next()) return false;
  } while (lines_.here().empty());
  if (!trace_words(lines_.here()).whole("call", c.number, last_call_ + 1, most_calls).done())
    refuse(lines_.here(), "\"call N\", N greater than in the call before, up to 10^18");
  last_call_ = c.number;
  c.note.clear();
  if (lines_.rest().starts_with("note ")) c.note = need_line("").substr(5);
  read_layout(c.in);
  read_dofs(c.in);
  read_pairs(c.in);
  refuse_missing_dofs(c.in);
  return true;
}

void trace_reader::read_layout(call_inputs& in) {
  constexpr int most_pairs = 10'000'000;
  constexpr std::size_t shortest_pair = std::string_view("pair 1 id 1 isep 1 isurf 1 cc 0\n").size();
  std::size_t dofs = 0;
  std::size_t nc = 0;
  const std::string_view layout = need_line(dofs_line);
  if (!trace_words(layout)
           .whole("indof", in.dof.indof, 1, most_dofs)
           .whole("ndofpn", in.dof.ndofpn, 1, most_dofs)
           .whole("dofs", dofs, 0, most_dofs)
           .whole("nc", nc, 0, most_pairs)
           .done())
    refuse(layout, dofs_line);
  if (nc > lines_.rest().size() / shortest_pair)
    refuse(layout, "at most as many pairs as the rest of the text has lines");
  forget_dofs(in);
  in.dd.resize(dofs, unknown);
  in.dtest.resize(dofs, unknown);
  in.cc.resize(nc);
  if (is_given_.size() < dofs) is_given_.resize(dofs, 0);
}

/// Clears only the dofs of the previous call. Clearing all dofs at every call would cost quadratic time.
void trace_reader::forget_dofs(call_inputs& in) {
  for (const std::size_t dof : given_) {
    if (dof < in.dd.size()) in.dd[dof] = in.dtest[dof] = unknown;
    is_given_[dof] = 0;
  }
  given_.clear();
}

void trace_reader::read_dofs(call_inputs& in) {
  while (lines_.rest().starts_with("dof ")) {
    const std::string_view line = need_line("");
    std::size_t dof = 0;
    double dd = 0.0;
    double dtest = 0.0;
    const auto dofs = static_cast<std::int64_t>(in.dd.size());
    if (!trace_words(line).whole("dof", dof, 1, dofs).real("dd", dd).real("dtest", dtest).done())
      refuse(line, "\"dof N dd X dtest X\", N from 1 to " + std::to_string(dofs));
    --dof;
    if (is_given_[dof] != 0) refuse(line, "each dof once");
    is_given_[dof] = 1;
    given_.push_back(dof);
    in.dd[dof] = dd;
    in.dtest[dof] = dtest;
  }
}

void trace_reader::read_pairs(call_inputs& in) {
  const std::size_t nc = in.cc.size();
  in.id.resize(nc);
  in.isep.resize(nc);
  in.isurf.resize(nc);
  for (std::size_t i = 0; i < nc; ++i) {
    const std::string allowed = "\"pair " + std::to_string(i + 1) +
                                " id N isep S isurf S cc X\", N from 1, each S and their product from "
                                "-2147483647 to 2147483647";
    const std::string_view line = need_line(allowed);
    std::size_t number = 0;
    if (!trace_words(line)
             .whole("pair", number, i + 1, i + 1)
             .whole("id", in.id[i], 1, most_dofs)
             .whole("isep", in.isep[i], -most_status, most_status)
             .whole("isurf", in.isurf[i], -most_status, most_status)
             .real("cc", in.cc[i])
             .done() ||
        std::abs(std::int64_t{in.isep[i]} * in.isurf[i]) > most_status)
      refuse(line, allowed);
    const std::int64_t dof = static_cast<std::int64_t>(in.id[i] - 1) * in.dof.ndofpn + in.dof.indof;
    if (dof > static_cast<std::int64_t>(in.dd.size()))
      refuse("a pair at dof " + std::to_string(dof),
             "1 to " + std::to_string(in.dd.size()) + ", the number in the line \"dofs\"");
  }
  const std::string_view line = need_line("\"ask\"");
  if (line != "ask") refuse(line, "\"ask\" after the last pair");
}

void trace_reader::refuse_missing_dofs(const call_inputs& in) const {
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    if (is_given_[in.dof_of_pair(i)] != 0) continue;
    refuse("no line \"dof " + std::to_string(in.dof_of_pair(i) + 1) + " ...\" in this call",
           "a line for the dof of every pair; pair " + std::to_string(i + 1) + " is at this dof");
  }
}

void trace_reader::read_answer(call_outputs& out) {
  constexpr int any = std::numeric_limits<int>::max();
  const std::string numbers = ", X such as 1.1e-20 (E, not D), 0x1.8p-3, inf or nan; one blank between words";
  const std::string_view smin = need_line("\"smin X\"");
  if (!trace_words(smin).real("smin", out.smin).done()) refuse(smin, "\"smin X\"" + numbers);
  for (std::size_t i = 0; i < out.ss.size(); ++i) {
    const std::string allowed = "\"pair " + std::to_string(i + 1) + " ss X isep S\"" + numbers;
    const std::string_view line = need_line(allowed);
    std::size_t number = 0;
    if (!trace_words(line)
             .whole("pair", number, i + 1, i + 1)
             .real("ss", out.ss[i])
             .whole("isep", out.isep[i], -any, any)
             .done())
      refuse(line, allowed);
  }
  out.text.clear();
  std::string_view line = need_line("\"end\"");
  for (; line.starts_with('|'); line = need_line("\"end\"")) out.text.append(line.substr(1)).append("\n");
  if (line != "end") refuse(line, R"("|" and a line of unit 26, or "end")");
}

}  // namespace contct
