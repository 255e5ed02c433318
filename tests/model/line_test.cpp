// Tests the exact meaning of a file's numbers, and faces and loads that are polynomials in x whose terms
// cancel.
#include "contct/model/line.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "contct/model/placed_loads.hpp"
#include "contct/number/rational.hpp"

using namespace contct;

namespace {

std::vector<element_piece> pieces_on(const beam& b, const load& l, int element) {
  const auto all = pieces_of(b, l);
  const auto* const pieces = pieces_at(all, element);
  return pieces == nullptr ? std::vector<element_piece>{} : *pieces;
}

/// Returns the coefficients of a load that is one polynomial on the element.
std::vector<double> load_on(const beam& b, const load& l, int element) {
  const std::vector<element_piece> pieces = pieces_on(b, l, element);
  REQUIRE(pieces.size() == 1);
  std::vector<double> q;
  for (const double_double& coefficient : pieces[0].q) q.push_back(coefficient.hi);
  return q;
}

double_double decimal(double x) {
  return contct::number_of<double_double>(x);
}

const std::vector<double> sixth_power = {1e18, -6e15, 1.5e13, -2e10, 1.5e7, -6000, 1};  // (x - 1000)^6

}  // namespace

TEST_CASE("the number 0.1 is read as the decimal one tenth, and not as the double next to one tenth") {
  CHECK(decimal(0.1).hi == 0.1);
  CHECK(decimal(0.1).lo != 0.0);
  CHECK(std::abs((decimal(0.1) * 10 - 1.0).hi) <= 0x1p-100);
  CHECK(std::abs((decimal(-2.5e-7) * 4e6 + 1.0).hi) <= 0x1p-100);
  CHECK(std::abs((decimal(1.25e22) / 1e22 - 1.25).hi) <= 0x1p-100);
  for (const double x : {0.0, -0.0, 3.0, -7.0, 0x1p52, 0.5, 0.25}) {
    CHECK(decimal(x).hi == x);
    CHECK(decimal(x).lo == 0.0);
  }
}

TEST_CASE("decimals at the ends of the range of doubles equal the doubles") {
  for (const double x : {5e-324, -5e-324, 1e-310, 2.2250738585072014e-308, -1.2345678901234567e-300,
                         1.2345678901234567e-293, 1.7976931348623157e308}) {
    INFO(x);
    CHECK(decimal(x).hi == x);
    CHECK(std::abs(decimal(x).lo) <= std::abs(x) * 0x1p-53);
    CHECK(contct::difference_of<double_double>(x, 1.0).hi == x - 1.0);
  }
}

TEST_CASE("decimals are added exactly before rounding, so 0.1, 0.2 and -0.3 have the sum 0") {
  const auto loads = [](const std::vector<double>& parts) {
    std::vector<point_load> all;
    for (const double x : parts) all.push_back({0, 0, x});
    return all;
  };
  const auto sum = [&](const std::vector<double>& parts) {
    return contct::sum_of<double_double>(loads(parts));
  };
  CHECK(sum({}) == 0.0);
  CHECK(sum({0.1, 0.2, -0.3}) == 0.0);
  CHECK(sum({-0.3, 1e-20, 0.2, 0.1}) == decimal(1e-20));
  CHECK(sum({1e300, 1e-300, -1e300}) == decimal(1e-300));
  CHECK(contct::sum_of<double>(loads({0.1, 0.2, -0.3})) == 0.0);
}

TEST_CASE("a number with a factor is the product of the two decimals, rounded once") {
  CHECK(contct::product_of<rational>(0.1, 1.1) == rational(11, 100));
  CHECK(contct::product_of<double>(0.1, 3.0) == 0.3);  // in doubles 0.1 * 3.0 is 0.30000000000000004
  CHECK(contct::product_of<double_double>(0.1, 1.1) == decimal(0.11));
  CHECK(contct::product_of<double>(0.1, 1.0) == 0.1);
}

TEST_CASE(
    "loads at one dof have the sum 0 if value times factor cancels in decimals, such as 0.1 times 3 and "
    "-0.3") {
  const std::vector<point_load> all = {{0, 0, 0.1, 3.0}, {0, 0, -0.3}, {0, 0, 1.1, 0.1}, {0, 0, -0.11}};
  CHECK(contct::sum_of<double>(all) == 0.0);
  CHECK(contct::sum_of<rational>(all) == 0);
}

TEST_CASE("a distributed load is the exact sum of its parts, each times a factor, in decimals") {
  const distributed_load d{{-0.135}, {}, {{{-0.1}, 1.35}, {{0.3}, 0.1}, {{-0.03}}}};
  CHECK(contct::coefficients_of<rational>(d) == std::vector<rational>{rational(-135, 1000)});
}

TEST_CASE("A polynomial face is rounded once, although its terms are 1e33 times as large as the face") {
  const beam b{{0.0, 1.1, 2.2}, {1e4, 1e4}};
  const auto faces = contct::values_at<double_double>(b, std::vector<double>{-0.001, -1.21e30, 0.0, 1e30},
                                                      std::vector<int>{1, 0});
  REQUIRE(faces.size() == 2);
  for (const auto& face : faces) {
    CHECK(face.hi == -0.001);
    CHECK(face == decimal(-0.001));
  }
}

TEST_CASE("the tributary length of a node is half of each of the intervals beside the node") {
  CHECK(contct::tributary_lengths<double>(std::vector<double>{2, 1}) == std::vector<double>{1, 1.5, 0.5});
}

TEST_CASE(
    "If nodes divide a length equally, a polynomial face is evaluated at exact fractions of the length") {
  const beam thirds{{0.0, 1.0 / 3, 2.0 / 3, 1.0}, {1, 1, 1}, {{1.0, 3}}};
  const auto faces =
      contct::values_at<double_double>(thirds, std::vector<double>{-1.0, 3.0}, std::vector<int>{1, 2});
  CHECK(faces[0] == 0.0);
  CHECK(faces[1] == 1.0);
}

TEST_CASE("The load (x - 1000)^6 is t^6 in the coordinate t of the element that begins at x = 1000") {
  const beam b{{1000.0, 1001.0, 1003.0}, {1, 1}};
  const load l{{}, {{sixth_power, {}}}};
  CHECK(load_on(b, l, 0) == std::vector<double>{0, 0, 0, 0, 0, 0, 1});
  CHECK(load_on(b, l, 1) == std::vector<double>{1, 12, 60, 160, 240, 192, 64});  // (1 + 2 t)^6
  CHECK(pieces_on(b, l, 0).at(0).size == 1.0);
}

TEST_CASE(
    "The polynomials of a distributed load are added exactly, and then expressed in the coordinate of an "
    "element") {
  const beam b{{0.0, 1.0, 2.0}, {1, 1}};
  load l{{}, {{{0.1 + 0.2 - 0.3}, {1}, {{{0.1}}, {{0.2}}, {{-0.3}}}}}};
  CHECK(load_on(b, l, 1) == std::vector<double>{0.0});
  CHECK(pieces_on(b, l, 0).empty());
  CHECK(pieces_on(b, l, 1).at(0).size == 0.0);
  l.distributed.push_back({{4.0, 2.0}, {}});
  CHECK(load_on(b, l, 0) == std::vector<double>{4.0, 2.0});
  CHECK(load_on(b, l, 1) == std::vector<double>{6.0, 2.0});
}

TEST_CASE("Equal elements under the same constant loads share one list of load pieces") {
  const beam b{{0.0, 0.1, 0.2, 0.3, 0.7}, {1, 1, 1, 1}};
  const auto all = pieces_of(b, {{}, {{{4.0}, {}}, {{2.0}, {1, 2, 3}}}});
  REQUIRE(all.size() == 3);
  CHECK(all.at(0).last == 0);
  CHECK(all.at(1).last == 2);
  CHECK(all.at(3).last == 3);  // this element has another length
  CHECK(pieces_at(all, 2)->at(0).q[0] == 6.0);
}
