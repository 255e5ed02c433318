#include "referee/problem_text.hpp"

#include <set>

#include "catch.hpp"
#include "contct/exact/exact_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "referee/counts.hpp"
#include "referee/hard_problems.hpp"
#include "support/scratch_folder.hpp"

using namespace contct::referee;

namespace {

/// The numbers in a problem's text.
std::vector<std::string> numbers_in(const std::string& text) {
  std::vector<std::string> all;
  constexpr const char* characters = "0123456789.e+-";
  for (std::size_t from = text.find_first_of("0123456789"); from != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_not_of(characters, from), text.size());
    all.push_back(text.substr(from, end - from));
    from = text.find_first_of("0123456789", end);
  }
  return all;
}

std::size_t digits_of(std::string number) {
  number = number.substr(0, number.find('e'));
  std::erase(number, '.');
  number.erase(0, number.find_first_not_of('0'));
  return number.find_last_not_of('0') + 1;
}

}  // namespace

TEST_CASE("what a drawn problem is written as reads back as the same exact problem") {
  const contct::app::scratch_folder folder;
  std::set<std::string> kinds;
  for (std::uint64_t number = 0; number < 300; ++number) {
    const drawn_problem d = draw(2026, number);
    INFO("problem " << number << ", " << d.kind);
    const problem_text text = text_of(d.problem);
    if (!text.matrix.empty()) folder.write("K.mtx", text.matrix);
    const contct::structure::problem again =
        contct::read::read_problem(folder.write("problem.toml", text.toml));
    const problem_text second = text_of(again);
    CHECK(second.toml == text.toml);
    CHECK(second.matrix == text.matrix);
    const auto one = contct::exact::exact_problem_of(d.problem);
    const auto other = contct::exact::exact_problem_of(again);
    CHECK(one.stiffness == other.stiffness);
    REQUIRE(one.steps.size() == other.steps.size());
    for (std::size_t i = 0; i < one.steps.size(); ++i) CHECK(one.steps[i].load == other.steps[i].load);
    kinds.insert(d.kind);
  }
  CHECK(kinds.size() == 16 + hard_kinds);
}

TEST_CASE("hard problems have numbers of at most 15 digits, which doubles and decimals agree on") {
  long numbers = 0;
  for (int kind = 0; kind < hard_kinds; ++kind) {
    for (std::uint64_t number = 0; number < 50; ++number) {
      const problem_text text = text_of(make_hard_problem(11, number, static_cast<hard_kind>(kind)));
      for (const std::string& n : numbers_in(text.toml + text.matrix)) {
        INFO(name_of(static_cast<hard_kind>(kind)) << " " << number << ": " << n);
        CHECK(digits_of(n) <= 15);
        ++numbers;
      }
    }
  }
  CHECK(numbers > 10'000);
}
