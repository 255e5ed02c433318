#include <algorithm>
#include <limits>
#include <utility>

#include "contct/text/input_text.hpp"
#include "contct/trace/trace.hpp"
#include "contct/trace/trace_words.hpp"

namespace contct {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
// Statuses and sides that are none go in as well, as they would in 1989; their product must not overflow.
constexpr int most_status = 10'000;
constexpr std::int64_t most_calls = 1'000'000'000'000'000'000;

constexpr std::string_view dofs_line =
    "\"indof I ndofpn N dofs M nc K\", I and N from 1, M up to 10000000, K up to 1000000";

/// Text with every control character written out: whatever a file holds, its message is one line and whole.
std::string printable(std::string_view text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string shown;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      shown += c;
    } else {
      shown.append("\\x").append(1, digits[byte / 16]).append(1, digits[byte % 16]);
    }
  }
  return shown;
}

/// Cut `key` and a blank off the front of `line`.
bool takes(std::string_view& line, std::string_view key) {
  if (line.substr(0, key.size()) != key || line.size() <= key.size() || line[key.size()] != ' ') return false;
  line.remove_prefix(key.size() + 1);
  return true;
}

}  // namespace

trace_reader::trace_reader(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

void trace_reader::refuse(std::string_view found, std::string_view allowed) const {
  constexpr std::size_t most_shown = 80;
  throw input_error(name_ + ":" + std::to_string(line_number_) + ": found " +
                    printable(found.substr(0, most_shown)) + "; allowed: " + std::string(allowed));
}

bool trace_reader::next_line(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  ++line_number_;
  return true;
}

std::string_view trace_reader::need_line(std::string_view allowed) {
  std::string_view line;
  if (!next_line(line)) refuse("the end of the text", allowed);
  return line;
}

trace_header trace_reader::read_header() {
  const std::string_view first = need_line("\"" + std::string(trace_format) + "\" as its first line");
  if (first == std::string(trace_format) + "\r") refuse("a line that ends in CR LF", "lines that end in LF");
  if (first != trace_format)
    refuse("a file that is no trace of this format: " + std::string(first.substr(0, 40)),
           "\"" + std::string(trace_format) + "\" as its first line");
  trace_header h;
  std::vector<std::string_view> keys;
  std::string_view line;
  while (next_line(line) && !line.empty()) {
    const std::string_view key = line.substr(0, line.find(' '));
    if (key != "about" && std::find(keys.begin(), keys.end(), key) != keys.end())
      refuse(line, "each line of the header once, but for about");
    keys.push_back(key);
    read_header_line(line, h);
  }
  return h;
}

void trace_reader::read_header_line(std::string_view line, trace_header& h) const {
  std::string_view value = line;
  if (takes(value, "about")) {
    h.about.emplace_back(value);
  } else if (takes(value, "kernel")) {
    h.kernel = value;
  } else if (takes(value, "rule")) {
    if (value != "listing" && value != "corrected") refuse(line, "\"rule listing\" or \"rule corrected\"");
    h.rule = value;
  } else if (takes(value, "real")) {
    if (value != "4" && value != "8") refuse(line, "\"real 8\" or \"real 4\"");
    h.real_bytes = value == "4" ? 4 : 8;
  } else if (takes(value, "listing")) {
    h.listing = value;
  } else if (takes(value, "compiler")) {
    h.compiler = value;
  } else if (takes(value, "flags")) {
    h.flags = value;
  } else if (takes(value, "lapack")) {
    h.lapack = value;
  } else if (takes(value, "floating-point")) {
    h.floating_point = value;
  } else {
    refuse(line,
           "about, kernel, real, rule, listing, compiler, flags, lapack, floating-point, or an empty line");
  }
}

bool trace_reader::next(recorded_call& c) {
  if (!next_inputs(c)) return false;
  c.out.ss.resize(c.in.pairs());
  c.out.isep.resize(c.in.pairs());
  read_answer(c.out);
  return true;
}

bool trace_reader::next_inputs(recorded_call& c) {
  std::string_view line;
  do {
    if (!next_line(line)) return false;
  } while (line.empty());
  if (!trace_words(line).key("call").whole(c.number, last_call_ + 1, most_calls).done())
    refuse(line, "\"call N\", N greater than that of the call before, up to 10^18");
  last_call_ = c.number;
  c.note.clear();
  if (rest_.substr(0, 5) == "note ") c.note = need_line("").substr(5);
  read_dofs(c.in);
  read_pairs(c.in);
  refuse_missing_dofs(c.in);
  return true;
}

void trace_reader::read_dofs(call_inputs<double>& in) {
  constexpr int most_pairs = 1'000'000;
  constexpr std::size_t shortest_pair = std::string_view("pair 1 id 1 isep 1 isurf 1 cc 0\n").size();
  int dofs = 0;
  int nc = 0;
  const std::string_view layout = need_line(dofs_line);
  if (!trace_words(layout)
           .key("indof")
           .whole(in.dof.indof, 1, most_dofs)
           .key("ndofpn")
           .whole(in.dof.ndofpn, 1, most_dofs)
           .key("dofs")
           .whole(dofs, 0, most_dofs)
           .key("nc")
           .whole(nc, 0, most_pairs)
           .done())
    refuse(layout, dofs_line);
  if (static_cast<std::size_t>(nc) > rest_.size() / shortest_pair)
    refuse(layout, "as many pairs as the rest of the text has lines for");
  for (const std::size_t dof : given_) {
    if (dof < in.dd.size()) in.dd[dof] = in.dtest[dof] = unknown;
    is_given_[dof] = 0;
  }
  given_.clear();
  in.dd.resize(static_cast<std::size_t>(dofs), unknown);
  in.dtest.resize(static_cast<std::size_t>(dofs), unknown);
  in.cc.resize(static_cast<std::size_t>(nc));
  if (is_given_.size() < in.dd.size()) is_given_.resize(in.dd.size(), 0);
  while (rest_.substr(0, 4) == "dof ") {
    const std::string_view line = need_line("");
    int dof = 0;
    double dd = 0.0;
    double dtest = 0.0;
    if (!trace_words(line).key("dof").whole(dof, 1, dofs).key("dd").real(dd).key("dtest").real(dtest).done())
      refuse(line, "\"dof N dd X dtest X\", N from 1 to " + std::to_string(dofs));
    const auto at = static_cast<std::size_t>(dof - 1);
    if (is_given_[at] != 0) refuse(line, "each dof once");
    is_given_[at] = 1;
    given_.push_back(at);
    in.dd[at] = dd;
    in.dtest[at] = dtest;
  }
}

void trace_reader::read_pairs(call_inputs<double>& in) {
  const std::size_t nc = in.cc.size();
  in.id.resize(nc);
  in.isep.resize(nc);
  in.isurf.resize(nc);
  for (std::size_t i = 0; i < nc; ++i) {
    const auto number = static_cast<int>(i) + 1;
    const std::string allowed = "\"pair " + std::to_string(number) +
                                " id N isep S isurf S cc X\", N a node from 1, S from -10000 to 10000";
    const std::string_view line = need_line(allowed);
    int pair = 0;
    if (!trace_words(line)
             .key("pair")
             .whole(pair, number, number)
             .key("id")
             .whole(in.id[i], 1, most_dofs)
             .key("isep")
             .whole(in.isep[i], -most_status, most_status)
             .key("isurf")
             .whole(in.isurf[i], -most_status, most_status)
             .key("cc")
             .real(in.cc[i])
             .done())
      refuse(line, allowed);
    const std::int64_t dof = static_cast<std::int64_t>(in.id[i] - 1) * in.dof.ndofpn + in.dof.indof;
    if (dof > static_cast<std::int64_t>(in.dd.size()))
      refuse("a pair at dof " + std::to_string(dof),
             "up to " + std::to_string(in.dd.size()) + ", as \"dofs\" has it");
  }
  const std::string_view line = need_line("\"ask\"");
  if (line != "ask") refuse(line, "\"ask\", behind the last pair");
}

void trace_reader::refuse_missing_dofs(const call_inputs<double>& in) const {
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    if (is_given_[in.dof_of_pair(i)] != 0) continue;
    refuse("no line \"dof " + std::to_string(in.dof_of_pair(i) + 1) + " ...\" in this call",
           "one for every pair; pair " + std::to_string(i + 1) + " is at that dof");
  }
}

void trace_reader::read_answer(call_outputs& out) {
  const std::string_view smin = need_line("\"smin X\"");
  if (!trace_words(smin).key("smin").real(out.smin).done()) refuse(smin, "\"smin X\"");
  for (std::size_t i = 0; i < out.ss.size(); ++i) {
    const auto number = static_cast<int>(i) + 1;
    const std::string allowed = "\"pair " + std::to_string(number) + " ss X isep S\"";
    const std::string_view line = need_line(allowed);
    int pair = 0;
    constexpr int any = std::numeric_limits<int>::max();
    if (!trace_words(line)
             .key("pair")
             .whole(pair, number, number)
             .key("ss")
             .real(out.ss[i])
             .key("isep")
             .whole(out.isep[i], -any, any)
             .done())
      refuse(line, allowed);
  }
  out.text.clear();
  std::string_view line = need_line("\"end\"");
  for (; line.substr(0, 1) == "|"; line = need_line("\"end\"")) out.text.append(line.substr(1)).append("\n");
  if (line != "end") refuse(line, "\"|\" and a line of unit 26, or \"end\"");
}

}  // namespace contct
