// Tests traces: calls are read to the bit as they were written, all allowed forms are read, and everything
// else is refused with file and line.
#include "contct/kernel/trace.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <regex>
#include <tuple>

#include "catch.hpp"
#include "contct/text/input_text.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

using limits = std::numeric_limits<double>;

/// Returns numbers of every kind, each with both signs.
std::vector<double> numbers() {
  std::vector<double> all;
  for (const double x : {0.0, 1.0, 0.1, 1.0 / 3.0, limits::min(), limits::max(), limits::denorm_min(),
                         3 * limits::denorm_min(), std::nextafter(limits::min(), 0.0),
                         std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0), 1e-10, 1e-20, .390625e-02,
                         9007199254740993.0, limits::infinity(), limits::quiet_NaN()}) {
    all.push_back(x);
    all.push_back(-x);
  }
  // Random bits give numbers of every exponent.
  std::uint64_t bits = 1989;
  for (int i = 0; i < 2000; ++i) {
    bits = bits * 6364136223846793005U + 1442695040888963407U;
    all.push_back(std::bit_cast<double>(bits));
  }
  return all;
}

/// Returns a call that has each number as a deflection, a response, a face and an s.
recorded_call call_with(const std::vector<double>& x) {
  recorded_call c;
  c.number = 1;
  c.in.dof = {2, 3};
  c.in.dd.assign(3 * x.size(), limits::quiet_NaN());
  c.in.dtest = c.in.dd;
  for (std::size_t i = 0; i < x.size(); ++i) {
    c.in.id.push_back(static_cast<int>(i) + 1);
    c.in.dd[3 * i + 1] = x[i];
    c.in.dtest[3 * i + 1] = -x[i];
    c.in.cc.push_back(x[x.size() - 1 - i]);
    c.in.isep.push_back(i % 2 == 0 ? separated : -10'000);
    c.in.isurf.push_back(i % 3 == 0 ? face_below : 10'000);
    c.out.ss.push_back(x[i]);
    c.out.isep.push_back(i % 2 == 0 ? in_contact : std::numeric_limits<int>::max());
  }
  c.out.smin = x[0];
  return c;
}

std::string written(recorded_call c) {
  std::string text;
  append_header({}, text);
  append_call(c.answered(), c.note, text);
  return text;
}

recorded_call read_back(const std::string& text) {
  trace_reader reader(text, "a trace");
  (void)reader.read_header();
  recorded_call c, none;
  REQUIRE(reader.next(c));
  CHECK_FALSE(reader.next(none));
  return c;
}

const std::string good =
    // Lines 1 to 6.
    "contct-trace-1 2026-11-21\nabout two pairs at two nodes\nkernel fortran\nreal 8\nrule listing\n\n"
    // Lines 7 to 13.
    "call 1\nnote the first\nindof 1 ndofpn 2 dofs 4 nc 2\n"
    "dof 1 dd 0x0p+0 dtest 0x1p+0\ndof 3 dd 0x1p-1 dtest -0x1p+0\n"
    "pair 1 id 1 isep 1 isurf 1 cc 0x1p-1\npair 2 id 2 isep -1 isurf -1 cc 0x1p-2\n"
    // Lines 14 to 19.
    "ask\nsmin 0x1p-2\npair 1 ss 0x1p-1 isep 1\npair 2 ss 0x1p-2 isep 1\n|  ****** BREAKING CONTACT "
    "*******\nend\n"
    // Lines 20 to 25.
    "\ncall 2\nindof 1 ndofpn 1 dofs 0 nc 0\nask\nsmin 0x1p+0\nend\n";

/// Reads a whole trace and returns its number of calls and the message of an input_error, or an empty text.
std::pair<int, std::string> read_all(const std::string& text) {
  int calls = 0;
  trace_reader reader(text, "bad.trace");
  recorded_call c;
  try {
    (void)reader.read_header();
    while (reader.next(c)) ++calls;
  } catch (const input_error& e) {
    return {calls, e.what()};
  }
  return {calls, ""};
}

/// Returns the trace `good` with the first `from` replaced by `to`.
std::string with(const std::string& from, const std::string& to) {
  std::string text = good;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

struct bad_trace {
  std::string what;
  std::string text;
  int line;           // the line of the refusal, 0 for an empty text
  std::string found;  // required part of the message
};

std::vector<bad_trace> bad_traces() {
  const std::string pair_1 = "pair 1 id 1 isep 1 isurf 1 cc 0x1p-1\n";
  const std::string pair_2 = "pair 2 id 2 isep -1 isurf -1 cc 0x1p-2\n";
  const std::string layout = "indof 1 ndofpn 2 dofs 4 nc 2";
  const auto number = [](const std::string& word) { return with("dof 1 dd 0x0p+0", "dof 1 dd " + word); };
  std::string crlf;
  for (const char c : good) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  std::vector<bad_trace> all = {
      {"nothing", "", 0, "the end of the text"},
      {"another format", with("trace-1", "trace-2"), 1, "contct-trace-2"},
      {"binary", std::string("\177ELF\0\1\2\xff", 8) + good, 1, "\\x7fELF\\x00\\x01\\x02"},
      {"a byte order mark", "\xef\xbb\xbf" + good, 1, "not a trace"},
      {"CR LF", crlf, 1, "CR LF"},
      {"a header line that is none", with("rule listing", "author me"), 5, "author me"},
      {"a precision that is none", with("real 8", "real 16"), 4, "real 16"},
      {"a header line twice", with("rule listing", "real 4"), 5, "real 4"},
      {"a header line without a value", with("kernel fortran", "kernel"), 3, "kernel"},
      {"no line between header and calls", with("rule listing\n\n", "rule listing\n"), 6, "call 1"},
      {"call 0", with("call 1", "call 0"), 7, "call 0"},
      {"calls that do not rise", with("call 2", "call 1"), 21, "call 1"},
      {"a call's number that overflows", with("call 2", "call 9223372036854775808"), 21, "922337203"},
      {"no call", with("call 1\n", ""), 7, "note the first"},
      {"a late note", with("note the first\n" + layout + "\n", layout + "\nnote the first\n"), 9, "note"},
      {"no layout", with(layout + "\n", ""), 9, "dof 1 dd"},
      {"a layout in another order", with(layout, "ndofpn 2 indof 1 dofs 4 nc 2"), 9, "ndofpn 2"},
      {"INDOF 0", with("indof 1", "indof 0"), 9, "indof 0"},
      {"a negative NC", with("nc 2", "nc -2"), 9, "nc -2"},
      {"too many dofs", with("dofs 4", "dofs 10000001"), 9, "dofs 10000001"},
      {"a million pairs in a small file", with("nc 2", "nc 1000000"), 9, "nc 1000000"},
      {"more pairs than lines", with("nc 2", "nc 3"), 14, "ask"},
      {"fewer pairs than lines", with("nc 2", "nc 1"), 13, "pair 2 id 2"},
      {"a dof's line missing", with("dof 3 dd 0x1p-1 dtest -0x1p+0\n", ""), 13, "no line \"dof 3 ...\""},
      {"a dof twice", with("dof 3 dd", "dof 1 dd"), 11, "dof 1 dd"},
      {"a dof that is not there", with("dof 3 dd", "dof 5 dd"), 11, "dof 5"},
      {"a dof behind the pairs", with("ask\n", "dof 2 dd 0 dtest 0\nask\n"), 14, "dof 2"},
      {"DD without DTEST", with(" dtest 0x1p+0", ""), 10, "dof 1 dd 0x0p+0;"},
      {"a pair twice", with(pair_2, pair_1), 13, "pair 1"},
      {"a node that is not there", with("id 2", "id 3"), 13, "a pair at dof 5"},
      {"a node whose dof overflows", with("ndofpn 2", "ndofpn 10000000"), 13, "a pair at dof 10000001"},
      {"a status that is a number and a half", with("isep -1", "isep -1.5"), 13, "isep -1.5"},
      {"a status that is too large", with("isep -1", "isep -2147483648"), 13, "isep -2147483648"},
      {"a product of 2^31", with("isep -1 isurf -1", "isep 65536 isurf 32768"), 13, "isep 65536"},
      {"a whole number with a plus", with("isep 1", "isep +1"), 12, "isep +1"},
      {"a word too many", with("cc 0x1p-1\n", "cc 0x1p-1 0\n"), 12, "cc 0x1p-1 0"},
      {"a blank at the end", with("ask\n", "ask \n"), 14, "ask ;"},
      {"capitals", with("ask\n", "ASK\n"), 14, "ASK"},
      {"a NUL in a number", number(std::string("1\0", 2)), 10, "1\\x00"},
      {"an escape sequence", with("ask\n", "\033[2J\n"), 14, "\\x1b[2J"},
      {"no ask", with("ask\n", ""), 14, "smin"},
      {"no smin", with("smin 0x1p-2\n", ""), 15, "pair 1 ss"},
      {"an answer's pair missing", with("pair 2 ss 0x1p-2 isep 1\n", ""), 17, "|  ****"},
      {"an answer's pair too many", with("\n|", "\npair 3 ss 1 isep 1\n|"), 18, "pair 3"},
      {"an answered status of 2^31", with("ss 0x1p-1 isep 1", "ss 0x1p-1 isep 2147483648"), 16, "214748"},
      {"no end", with("BREAKING CONTACT *******\nend\n", "BREAKING CONTACT *******\n"), 19, "found ;"},
      {"text behind end", with("end\n\n", "end\n|more\n"), 20, "|more"},
      {"a second header", good + good, 26, "contct-trace-1"},
      {"a long line", with("ask\n", std::string(8'000'000, 'x') + "\n"), 14, "xxxx"},
  };
  for (const char* word : {"--1", "0x-1p0", "0x", "0xinf", "0X1p0", "1e999", "1e-999", "0x1p+1024", "1D0"})
    all.push_back({"a number that is none", number(word), 10, "dd " + std::string(word) + " dtest"});
  return all;
}

/// Returns true if `message` is one line FILE:LINE: found ...; allowed: ... The line is missing for an empty
/// text.
bool well_formed(const std::string& message) {
  static const std::regex form("bad\\.trace(:\\d+)?: found .*; allowed: .*");
  return message.size() < 700 && std::regex_match(message, form);
}

}  // namespace

TEST_CASE("numbers of every kind are written to a trace and read back with the same bits") {
  recorded_call c = call_with(numbers());
  const recorded_call back = read_back(written(c));
  CHECK(equal_bits(c.in.dd, back.in.dd));
  CHECK(equal_bits(c.in.dtest, back.in.dtest));
  CHECK(equal_bits(c.in.cc, back.in.cc));
  CHECK(equal_bits(c.out.ss, back.out.ss));
  CHECK(back.in.id == c.in.id);
  CHECK(back.in.isep == c.in.isep);
  CHECK(back.in.isurf == c.in.isurf);
  CHECK(back.out.isep == c.out.isep);
  CHECK(back.in.dof.indof == 2);
  CHECK(back.in.dof.ndofpn == 3);
  for (const double x : numbers()) {
    c.out.smin = x;
    CHECK(same_bits(read_back(written(c)).out.smin, x));
    if (std::isnan(x)) break;  // the special numbers come before the random bits
  }
}

TEST_CASE("notes and texts of unit 26 with any characters are written to a trace and read back unchanged") {
  recorded_call c = call_with({1.0});
  c.note = "a note with \"quotes\", | bars |, end, \t tabs and \xc3\xa9";
  c.out.text = "|bar\n\nend\n  call 2\n\t\x01\x7f\xff" + std::string(1, '\0') + "\ncarriage\r\n ask\n";
  for (const bool empty : {false, true}) {
    if (empty) c.note = c.out.text = "";
    const recorded_call back = read_back(written(c));
    CHECK(back.note == c.note);
    CHECK(back.out.text == c.out.text);
  }
}

TEST_CASE("the header of a trace is read back as written, with the name of a kernel on one line") {
  const kernel_facts by{"fortran-r4", 4, contact_rule::corrected, "", "GNU", "-O3"};
  trace_header h{by, {"a", "b"}, "c9f2", "none", "strict"};
  const auto parts = [](const trace_header& t) {
    return std::tuple(t.about, t.name, t.real_bytes, t.rule, t.listing, t.compiler, t.flags, t.lapack,
                      t.floating_point);
  };
  const auto back = [](const trace_header& given) {
    std::string text;
    append_header(given, text);
    return trace_reader(text, "a trace").read_header();
  };
  CHECK((parts(back(h)) == parts(h)));
  h.name = "pipe:while read x\ndo echo $x\ndone";
  CHECK(back(h).name == "pipe:while read x do echo $x done");
}

TEST_CASE("a malformed trace is refused with file, line, what was found and what is allowed") {
  const std::vector<bad_trace> all = bad_traces();
  CHECK(all.size() >= 55);
  for (const bad_trace& a : all) {
    const std::string refused = read_all(a.text).second;
    INFO(a.what << ": " << refused);
    CHECK(well_formed(refused));
    CHECK(refused.starts_with(a.line == 0 ? "bad.trace: " : "bad.trace:" + std::to_string(a.line) + ": "));
    CHECK_THAT(refused, Contains(a.found));
  }
}

TEST_CASE("a trace is refused if it is cut inside a call") {
  std::size_t whole = 0;
  for (std::size_t length = 0; length <= good.size(); ++length) {
    const auto [calls, refused] = read_all(good.substr(0, length));
    if (!refused.empty()) {
      CHECK(well_formed(refused));
      continue;
    }
    ++whole;
    // The cut trace is complete if the cut is between calls, or in the header, where it has no calls.
    const bool behind_call_1 = length >= good.find("\n\ncall 2") && length <= good.find("call 2");
    const bool behind_call_2 = length >= good.size() - 1;
    CHECK(calls == (behind_call_2 ? 2 : behind_call_1 ? 1 : 0));
    CHECK((calls > 0 || length <= good.find("call 1")));
  }
  CHECK(whole < good.find("call 1") + 6);
}

TEST_CASE("a dof without a pair is not written to a trace, and a dof that a call does not give is NaN") {
  recorded_call one = call_with({1.0});
  one.in.dd[0] = 7.0;
  CHECK(written(one).find("dof 1 ") == std::string::npos);
  const std::string pair = " isep 1 isurf 1 cc 1\nask\nsmin 1\npair 1 ss 1 isep 1\nend\n\n";
  const std::string text =
      "call 1\nindof 1 ndofpn 1 dofs 3 nc 1\ndof 1 dd 1 dtest 1\ndof 3 dd 3 dtest 3\npair 1 id 1" + pair +
      "call 2\nindof 1 ndofpn 1 dofs 2 nc 1\ndof 2 dd 2 dtest 2\npair 1 id 2" + pair +
      "call 3\nindof 1 ndofpn 1 dofs 3 nc 0\nask\nsmin 1\nend\n";
  trace_reader reader(text, "a trace");
  const double nan = limits::quiet_NaN();
  recorded_call c;
  for (const std::vector<double>& dd : {std::vector{1.0, nan, 3.0}, {nan, 2.0}, {nan, nan, nan}}) {
    REQUIRE(reader.next(c));
    CHECK(equal_bits(c.in.dd, dd));
  }
  CHECK_FALSE(reader.next(c));
}

TEST_CASE("a number in a trace may be a decimal, a hex float, inf or nan") {
  const std::pair<const char*, double> numbers_of_words[] = {
      {"1", 1.0},
      {"-0.1", -0.1},
      {".5", 0.5},
      {"1e-10", 1e-10},
      {"1E+3", 1000.0},
      {"-0", -0.0},
      {"4.9406564584124654e-324", limits::denorm_min()},
      {"0x1.8p+1", 3.0},
      {"0x1.8000p1", 3.0},
      {"0xc.0p-2", 3.0},
      {"-inf", -limits::infinity()},
      {"nan", limits::quiet_NaN()},
      {"-nan", limits::quiet_NaN()}};
  for (const auto& [word, number] : numbers_of_words) {
    const std::string text = "call 1\nindof 1 ndofpn 1 dofs 1 nc 1\ndof 1 dd " + std::string(word) +
                             " dtest 1\npair 1 id 1 isep 1 isurf 1 cc 1\nask\n";
    trace_reader reader(text, "a call");
    recorded_call c;
    INFO(word);
    REQUIRE(reader.next_inputs(c));
    CHECK(same_bits(c.in.dd[0], number));
  }
}
