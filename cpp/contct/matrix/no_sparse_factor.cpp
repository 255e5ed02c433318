// Where CHOLMOD is not built in.
#include <stdexcept>

#include "contct/matrix/sparse_factor.hpp"

namespace contct {
namespace {

[[noreturn]] void refuse() {
  throw std::logic_error("a sparse factor needs CHOLMOD, which is not built in");
}

}  // namespace

class sparse_factor::library {};

bool sparse_factor::available() {
  return false;
}

// NOLINTNEXTLINE(performance-unnecessary-value-param)
sparse_factor::sparse_factor(sparse_columns /*a*/) {
  refuse();
}
sparse_factor::~sparse_factor() = default;
sparse_factor::sparse_factor(sparse_factor&& other) noexcept = default;
sparse_factor& sparse_factor::operator=(sparse_factor&& other) noexcept = default;

// NOLINTBEGIN(readability-convert-member-functions-to-static): the header is that of the real one
std::int64_t sparse_factor::bytes() const {
  refuse();
}

bool sparse_factor::factor(std::span<const double> /*diagonal*/) {
  refuse();
}

void sparse_factor::solve(std::span<double> /*b*/) {
  refuse();
}

void sparse_factor::solve_units(std::span<const int> /*rows*/, std::vector<double>& /*x*/) {
  refuse();
}

double sparse_factor::flops() const {
  refuse();
}
// NOLINTEND(readability-convert-member-functions-to-static)

}  // namespace contct
