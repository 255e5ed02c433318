// Calls as text: what is written is read back to the bit.
#include "contct/trace/trace.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "catch.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/numeric/bits.hpp"

using namespace contct::app;

namespace {

using limits = std::numeric_limits<double>;

/// Numbers of every kind, both signs of each.
std::vector<double> numbers() {
  std::vector<double> all;
  for (const double x : {0.0, 1.0, 0.1, 1.0 / 3.0, limits::min(), limits::max(), limits::denorm_min(),
                         3 * limits::denorm_min(), std::nextafter(limits::min(), 0.0),
                         std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0), 1e-10, 1e-20, .390625e-02,
                         9007199254740993.0, limits::infinity(), limits::quiet_NaN()}) {
    all.push_back(x);
    all.push_back(-x);
  }
  // And bits as they come, of every exponent.
  std::uint64_t bits = 1989;
  for (int i = 0; i < 2000; ++i) {
    bits = bits * 6364136223846793005U + 1442695040888963407U;
    all.push_back(std::bit_cast<double>(bits));
  }
  return all;
}

/// A call with every number as a deflection, a response and a face, and an answer of the same.
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

std::string written(const recorded_call& c) {
  std::string text;
  append_header({}, text);
  append_inputs(c.number, c.note, c.in, text);
  append_answer(c.out.smin, c.out.ss, c.out.isep, c.out.text, text);
  return text;
}

recorded_call read_back(const std::string& text) {
  trace_reader reader(text, "a trace");
  (void)reader.read_header();
  recorded_call c;
  REQUIRE(reader.next(c));
  recorded_call none;
  CHECK_FALSE(reader.next(none));
  return c;
}

int differences(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += same_bits(a[i], b[i]) ? 0 : 1;
  return count;
}

}  // namespace

TEST_CASE("numbers of every kind come back from a trace to the bit") {
  recorded_call c = call_with(numbers());
  const recorded_call back = read_back(written(c));
  CHECK(differences(c.in.dd, back.in.dd) == 0);
  CHECK(differences(c.in.dtest, back.in.dtest) == 0);
  CHECK(differences(c.in.cc, back.in.cc) == 0);
  CHECK(differences(c.out.ss, back.out.ss) == 0);
  CHECK(back.in.id == c.in.id);
  CHECK(back.in.isep == c.in.isep);
  CHECK(back.in.isurf == c.in.isurf);
  CHECK(back.out.isep == c.out.isep);
  CHECK(back.in.dof.indof == 2);
  CHECK(back.in.dof.ndofpn == 3);
  for (const double x : numbers()) {
    c.out.smin = x;
    CHECK(same_bits(read_back(written(c)).out.smin, x));
    if (std::isnan(x)) break;  // the special ones have been
  }
}

TEST_CASE("a dof that no pair looks at is nobody's: it is not written, and read as NaN") {
  recorded_call c = call_with({1.0, 2.0});
  c.in.dd[0] = 7.0;
  const std::string text = written(c);
  CHECK(text.find("dof 1 ") == std::string::npos);
  const recorded_call back = read_back(text);
  CHECK(std::isnan(back.in.dd[0]));
  CHECK(back.in.dd[1] == 1.0);
}

TEST_CASE("notes and unit-26 text come back, whatever characters they have") {
  recorded_call c = call_with({1.0});
  c.note = "a note with \"quotes\", | bars |, end, \t tabs and \xc3\xa9";
  c.out.text = "|bar\n\nend\n  call 2\n\t\x01\x7f\xff" + std::string(1, '\0') + "\ncarriage\r\n ask\n";
  const recorded_call back = read_back(written(c));
  CHECK(back.note == c.note);
  CHECK(back.out.text == c.out.text);
  c.note.clear();
  c.out.text.clear();
  CHECK(read_back(written(c)).note.empty());
  CHECK(read_back(written(c)).out.text.empty());
}

TEST_CASE("a header comes back") {
  const trace_header h{{"what it is for", "in two lines"},
                       "fortran-r4",
                       4,
                       "corrected",
                       "c9f2",
                       "GNU 12.2.0",
                       "-O3 -ffp-contract=off",
                       "none",
                       "strict"};
  std::string text;
  append_header(h, text);
  trace_reader reader(text, "a trace");
  const trace_header back = reader.read_header();
  CHECK(back.about == h.about);
  CHECK(back.kernel == h.kernel);
  CHECK(back.real_bytes == 4);
  CHECK(back.rule == "corrected");
  CHECK(back.listing == h.listing);
  CHECK(back.compiler == h.compiler);
  CHECK(back.flags == h.flags);
  CHECK(back.lapack == h.lapack);
  CHECK(back.floating_point == h.floating_point);
}

TEST_CASE("a kernel's name of several lines stays one line of the header") {
  trace_header h;
  h.kernel = "pipe:while read x\ndo echo $x\ndone";
  std::string text;
  append_header(h, text);
  trace_reader reader(text, "a trace");
  CHECK(reader.read_header().kernel == "pipe:while read x do echo $x done");
}
