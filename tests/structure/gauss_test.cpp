#include "contct/structure/gauss.hpp"

#include <cmath>

#include "catch.hpp"

using namespace contct::app;

TEST_CASE("n points integrate every polynomial up to degree 2 n - 1, and not beyond") {
  for (int n = 1; n <= 13; ++n) {
    const auto integral = [&](int degree) {
      double sum = 0.0;
      for (const auto& [t, weight] : gauss_points(n)) sum += weight * std::pow(t, degree);
      return sum;
    };
    for (int degree = 0; degree <= 2 * n - 1; ++degree) {
      INFO(n << " points, degree " << degree);
      CHECK(integral(degree) == Approx(1.0 / (degree + 1)).epsilon(1e-14));
    }
    if (n <= 4) CHECK(std::abs(integral(2 * n) - 1.0 / (2 * n + 1)) > 1e-6);
  }
}
