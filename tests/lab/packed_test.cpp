// Values as bytes, and back.
#include "contct/lab/packed.hpp"

#include <array>
#include <cmath>
#include <limits>

#include "catch.hpp"

namespace contct::lab {

struct packed_sample {
  std::string name;
  std::vector<std::optional<std::string>> words;
  std::optional<std::vector<int>> numbers;
  std::array<double, 2> plain{};
};

template <class Visit>
void pack(Visit& visit, packed_sample& s) {
  visit(s.name, s.words, s.numbers, s.plain);
}

}  // namespace contct::lab

using namespace contct::lab;

namespace {

packed_sample sample() {
  return {std::string("a\0b", 3),
          {"", std::nullopt, "c"},
          std::vector<int>{1, -2},
          {-0.0, std::numeric_limits<double>::quiet_NaN()}};
}

}  // namespace

TEST_CASE("packed values come back to the bit, what is missing and what is no number, too") {
  packed_sample there = sample();
  packed_sample back{"before", {"x"}, std::nullopt, {}};
  unpack(packed(there), back);
  CHECK(back.name == there.name);
  CHECK(back.words == there.words);
  CHECK(back.numbers == there.numbers);
  CHECK(std::signbit(back.plain[0]));
  CHECK(std::isnan(back.plain[1]));
  there.numbers.reset();
  unpack(packed(there), back);
  CHECK_FALSE(back.numbers);
}

TEST_CASE("packed values that are cut short, or followed by more, are refused") {
  packed_sample there = sample();
  const std::string bytes = packed(there);
  packed_sample back;
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK_THROWS_AS(unpack(bytes.substr(0, size), back), std::length_error);
  CHECK_THROWS_AS(unpack(bytes + "x", back), std::length_error);
}
