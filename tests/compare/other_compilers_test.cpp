// Tests the listing as built by other compilers against gfortran's build and the C++ kernel.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>

#include "catch.hpp"
#include "contct/compare/compare.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_calls.hpp"
#include "support/one_pair.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// Returns the names of the kernels flang and f2c, if they are built.
std::vector<std::string> other_kernels() {
  std::vector<std::string> names = kernel_names();
  std::erase_if(names, [](const std::string& name) { return name != "flang" && name != "f2c"; });
  return names;
}

}  // namespace

TEST_CASE(
    "in 20,000 random calls, flang's and f2c's builds give gfortran's answers, and f2c's text has equal "
    "meaning") {
  constexpr int calls = 20'000;
  for (const std::string& name : other_kernels()) {
    INFO(name);
    const auto asked = make_kernel(name);
    const auto gfortran = make_kernel("fortran");
    const auto cpp = make_kernel("cpp");
    random_calls<double> source(1989);
    tally answers;
    tally text;
    std::int64_t lines = 0;
    std::int64_t different_bytes = 0;  // calls with texts that differ in bytes
    for (int i = 0; i < calls; ++i) {
      const call_inputs<double>& in = source.random(i);
      const call_outputs a = answer_of(*asked, in);
      for (kernel* other : {gfortran.get(), cpp.get()}) {
        const call_outputs b = answer_of(*other, in);
        (void)compare_answers<double>({b.smin, b.ss, b.isep}, {a.smin, a.ss, a.isep}, answers);
        (void)compare_text(b.text, a.text, text, text_equality_of(other->facts(), asked->facts()));
        different_bytes += a.text != b.text ? 1 : 0;
      }
      lines += std::count(a.text.begin(), a.text.end(), '\n');
    }
    CHECK(answers.values > 1'000'000);
    CHECK(answers.mismatches == 0);
    CHECK(lines > calls);
    CHECK(text.values == std::int64_t{2} * calls);
    CHECK(text.mismatches == 0);
    // Every call writes a number, whose leading zero libf2c omits.
    CHECK(different_bytes == (name == "f2c" ? std::int64_t{2} * calls : 0));
    CHECK_FALSE(std::filesystem::exists("fort.26"));
  }
}

TEST_CASE(
    "each compiler's run-time library has a unit 26 of its own, and only one of these units is open at a "
    "time") {
  const call_inputs<double> quarter{{0.0}, {4.0}, {1.0}, {1}, {separated}, {face_above}, {}};
  for (const std::string& name : other_kernels()) {
    INFO(name);
    const auto first = make_kernel(name);
    const auto beside = make_kernel("fortran");
    CHECK_THROWS_AS(make_kernel(name), std::logic_error);
    CHECK_THAT(answer_of(*first, quarter).text,
               Contains(name == "f2c" ? "SCALE FACTOR =   .2500E+00" : "SCALE FACTOR =  0.2500E+00"));
    CHECK(beside->take_text().empty());
  }
}
