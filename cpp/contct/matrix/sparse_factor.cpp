#include "contct/matrix/sparse_factor.hpp"

#include <algorithm>
#include <utility>

#include "contct/matrix/cholmod_library.hpp"
#include "contct/matrix/several_right_hand_sides.hpp"
#include "contct/matrix/supernodal_solve.hpp"

namespace contct {

class sparse_factor::library {
 public:
  explicit library(sparse_columns a) : a_(std::move(a)) {
    common_->supernodal = CHOLMOD_SUPERNODAL;  // dense blocks by BLAS
    common_->nmethods = 2;                     // the better of both
    common_->method[0].ordering = CHOLMOD_METIS;
    common_->method[1].ordering = CHOLMOD_AMD;
    cholmod_sparse k = seen_by_cholmod(a_);
    factor_ = made_by_cholmod(cholmod_analyze(&k, common_));
    b_ = made_by_cholmod(cholmod_zeros(k.nrow, 1, CHOLMOD_REAL, common_));
    places_.resize(k.nrow);
    const auto* const order = static_cast<const int*>(factor_->Perm);
    for (std::size_t i = 0; i < k.nrow; ++i) places_[static_cast<std::size_t>(order[i])] = i;
  }
  ~library() {
    cholmod_free_factor(&factor_, common_);
    cholmod_free_dense(&b_, common_);
    cholmod_free_dense(&x_, common_);
    cholmod_free_dense(&y_, common_);
    cholmod_free_dense(&e_, common_);
  }
  library(const library&) = delete;
  library& operator=(const library&) = delete;
  library(library&&) = delete;
  library& operator=(library&&) = delete;

  [[nodiscard]] std::int64_t bytes() const {
    return static_cast<std::int64_t>(sizeof(double) * factor_->xsize + sizeof(int) * factor_->ssize);
  }

  [[nodiscard]] bool factor(std::span<const double> diagonal) {
    for (std::size_t row = 0; row < diagonal.size(); ++row)
      a_.diagonal(static_cast<int>(row)) = diagonal[row];
    cholmod_sparse k = seen_by_cholmod(a_);
    const bool done = cholmod_factorize(&k, factor_, common_) != 0;
    if (common_->status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    return done && common_->status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  [[nodiscard]] double flops() const { return common_.flops(); }

  void solve_units(std::span<const int> rows, std::vector<double>& x) {
    in_order_.assign(factor_->n * side_by_side, 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i] >= 0) in_order_[place_of(rows[i]) * side_by_side + i] = 1.0;
    solve_many(in_supernodes(), in_order_);
    x.resize(in_order_.size());
    for (std::size_t row = 0; row < factor_->n; ++row)
      std::copy_n(&in_order_[place_of(static_cast<int>(row)) * side_by_side], side_by_side,
                  &x[row * side_by_side]);
  }

  void solve(std::span<double> b) {
    auto* const right_hand_side = static_cast<double*>(b_->x);
    std::copy(b.begin(), b.end(), right_hand_side);
    if (cholmod_solve2(CHOLMOD_A, factor_, b_, nullptr, &x_, nullptr, &y_, &e_, common_) == 0)
      throw std::bad_alloc();
    std::copy_n(static_cast<const double*>(x_->x), b.size(), b.begin());
  }

 private:
  [[nodiscard]] std::size_t place_of(int row) const { return places_[static_cast<std::size_t>(row)]; }

  [[nodiscard]] supernodes in_supernodes() const {
    const auto* const f = factor_;
    const auto ints = [](const void* at, std::size_t count) {
      return std::span<const int>(static_cast<const int*>(at), count);
    };
    return {ints(f->super, f->nsuper + 1),
            ints(f->pi, f->nsuper + 1),
            ints(f->px, f->nsuper),
            ints(f->s, f->ssize),
            {static_cast<const double*>(f->x), f->xsize}};
  }

  cholmod_library common_;
  sparse_columns a_;
  std::vector<std::size_t> places_;  // of each row in the factor's order
  std::vector<double> in_order_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* b_ = nullptr;
  cholmod_dense* x_ = nullptr;
  cholmod_dense* y_ = nullptr;
  cholmod_dense* e_ = nullptr;
};

bool sparse_factor::available() {
  return true;
}

sparse_factor::sparse_factor(sparse_columns a) : library_(std::make_unique<library>(std::move(a))) {}
sparse_factor::~sparse_factor() = default;
sparse_factor::sparse_factor(sparse_factor&& other) noexcept = default;
sparse_factor& sparse_factor::operator=(sparse_factor&& other) noexcept = default;

std::int64_t sparse_factor::bytes() const {
  return library_->bytes();
}

bool sparse_factor::factor(std::span<const double> diagonal) {
  return library_->factor(diagonal);
}

void sparse_factor::solve(std::span<double> b) {
  library_->solve(b);
}

void sparse_factor::solve_units(std::span<const int> rows, std::vector<double>& x) {
  library_->solve_units(rows, x);
}

double sparse_factor::flops() const {
  return library_->flops();
}

}  // namespace contct
