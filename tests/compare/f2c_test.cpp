#include <filesystem>

#include "catch.hpp"
#include "compare/other_compiler.hpp"
#include "contct/compare/compare.hpp"
#include "contct/outside/registry.hpp"

using namespace contct::app;

TEST_CASE("f2c's translation answers 20,000 random calls as gfortran's and C++ do, its text by meaning") {
  const three_compared found = compare_three("f2c", 20'000);
  CHECK(found.answers.values > 1'000'000);
  CHECK(found.answers.mismatches == 0);
  CHECK(found.lines > 20'000);
  CHECK(found.text.values == 40'000);
  CHECK(found.text.mismatches == 0);
  CHECK(found.different_bytes == 40'000);  // every call writes a number, and libf2c drops its zero
  CHECK_FALSE(std::filesystem::exists("fort.26"));
}

TEST_CASE("f2c's text is accepted for what it means, and a number that is another is not") {
  const auto f2c = make_kernel("f2c");
  const auto gfortran = make_kernel("fortran");
  const text_equality how = text_equality_of(gfortran->facts(), f2c->facts());
  CHECK(how == text_equality::meaning);
  for (const double s : {0.25, 1.0 / 3.0, 1e-12, 1e-100, 1e-150, 1.0}) {
    INFO(s);
    const std::string theirs = ask_kernel(*gfortran, one_pair_at(s)).text;
    const std::string text = ask_kernel(*f2c, one_pair_at(s)).text;
    CHECK_THAT(text, Catch::Matchers::Contains("=   ."));
    tally t;
    CHECK_FALSE(compare_text(theirs, text, t, how));
    const std::string another = ask_kernel(*f2c, one_pair_at(s / 2)).text;
    CHECK(compare_text(theirs, another, t, how));
    CHECK(compare_text(theirs, text, t));  // not the same bytes
  }
}

TEST_CASE("f2c's unit 26 is its own: one for each run-time library, and one at a time") {
  const auto first = make_kernel("f2c");
  const auto beside = make_kernel("fortran");
  CHECK_THROWS_AS(make_kernel("f2c"), std::logic_error);
  CHECK_THAT(ask_kernel(*first, one_pair_at(0.25)).text,
             Catch::Matchers::Contains("SCALE FACTOR =   .2500E+00"));
  CHECK(beside->take_text().empty());
}

TEST_CASE("a trace recorded from f2c is replayed by every 8-byte kernel, its text by meaning") {
  std::string trace;
  trace_header header;
  header.kernel = "f2c";
  append_header(header, trace);
  const auto f2c = make_kernel("f2c");
  random_calls<double> source(26);
  for (int i = 1; i <= 100; ++i) {
    const call_inputs<double>& in = source.random(i);
    append_inputs(i, "", in, trace);
    const kernel_answer a = ask_kernel(*f2c, in);
    append_answer(a.smin, a.ss, a.isep, a.text, trace);
  }
  for (const std::string name : {"fortran", "cpp"}) {
    INFO(name);
    trace_reader calls(trace, "f2c.trace");
    const trace_header h = calls.read_header();
    const replay_report r = replay(h, calls, *make_kernel(name));
    CHECK(r.calls == 100);
    CHECK(r.compared.values > 1'000);
    CHECK(r.compared.mismatches == 0);
  }
}
