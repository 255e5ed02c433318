#include "contct/linear/sparse_factor.hpp"

#ifdef CONTCT_HAS_CHOLMOD
#include <cholmod.h>

#include <algorithm>
#include <array>
#include <new>

// Functions of OpenMP; null if CHOLMOD is linked without OpenMP.
extern "C" {
__attribute__((weak)) int omp_get_max_active_levels();
__attribute__((weak)) void omp_set_max_active_levels(int levels);
}

namespace contct {
namespace {

/// Keeps this thread from starting OpenMP threads. CHOLMOD requests four threads to copy a supernode;
/// starting them and waiting for them took a sixth of the time of a plate's path.
class no_openmp_threads {
 public:
  no_openmp_threads() {
    if (omp_set_max_active_levels == nullptr || omp_get_max_active_levels == nullptr) return;
    before_ = omp_get_max_active_levels();
    omp_set_max_active_levels(0);
  }
  ~no_openmp_threads() {
    if (before_ >= 0) omp_set_max_active_levels(before_);
  }
  no_openmp_threads(const no_openmp_threads&) = delete;
  no_openmp_threads& operator=(const no_openmp_threads&) = delete;

 private:
  int before_ = -1;
};

/// Returns an object allocated by CHOLMOD; throws std::bad_alloc if it is null.
template <class T>
T* made(T* by_cholmod) {
  if (by_cholmod == nullptr) throw std::bad_alloc();
  return by_cholmod;
}

/// CHOLMOD's settings and workspace, which must not be copied: its only owner, `cholmod`, cannot be copied.
struct workspace : cholmod_common {
  workspace() : cholmod_common{} {
    cholmod_start(this);
    print = 0;
    quick_return_if_not_posdef = 1;
    supernodal = CHOLMOD_SUPERNODAL;
  }
  ~workspace() { cholmod_finish(this); }
};

/// One row of up to eight right-hand sides, which are solved together, so that the factor is read from memory
/// only once. CHOLMOD's own solve calls BLAS for this, and takes twice as long with the reference BLAS.
using row_of_block = std::array<double, 8>;

/// A supernode of CHOLMOD's L: neighbouring columns with the same rows below them, stored as one dense block.
class supernode {
 public:
  supernode(const cholmod_factor& l, std::size_t number)
      : rows_(static_cast<const int*>(l.s) + static_cast<const int*>(l.pi)[number]),
        entries_(static_cast<const double*>(l.x) + static_cast<const int*>(l.px)[number]),
        height_(static_cast<const int*>(l.pi)[number + 1] - static_cast<const int*>(l.pi)[number]),
        width_(static_cast<const int*>(l.super)[number + 1] - static_cast<const int*>(l.super)[number]) {}

  /// Does the part of solving L Y = B, in place, that belongs to this supernode's columns. Returns at once if
  /// B is 0 in the rows of these columns, as is usual for unit vectors.
  void go_forward(std::vector<row_of_block>& b) const {
    const auto is_zero = [](const row_of_block& r) { return r == row_of_block{}; };
    if (std::all_of(rows_, rows_ + width_, [&](int row) { return is_zero(b[row]); })) return;
    for (int j = 0; j < width_; ++j) {
      const double* const column = entries_ + std::size_t{1} * j * height_;
      row_of_block y = b[rows_[j]];
      for (double& part : y) part /= column[j];
      b[rows_[j]] = y;
      for (int i = j + 1; i < height_; ++i) subtract(b[rows_[i]], column[i], y);
    }
  }

  void append_to(sparse_columns& l) const {
    for (int j = 0; j < width_; ++j) {
      const double* const column = entries_ + std::size_t{1} * j * height_;
      l.rows.insert(l.rows.end(), rows_ + j, rows_ + height_);
      l.values.insert(l.values.end(), column + j, column + height_);
      l.starts.push_back(static_cast<int>(l.rows.size()));
    }
  }

  /// L^T X = Y, likewise.
  void go_back(std::vector<row_of_block>& b) const {
    for (int j = width_; j-- > 0;) {
      const double* const column = entries_ + std::size_t{1} * j * height_;
      row_of_block x = b[rows_[j]];
      for (int i = j + 1; i < height_; ++i) subtract(x, column[i], b[rows_[i]]);
      for (double& part : x) part /= column[j];
      b[rows_[j]] = x;
    }
  }

 private:
  static void subtract(row_of_block& from, double entry, const row_of_block& x) {
    for (std::size_t k = 0; k < x.size(); ++k) from[k] -= entry * x[k];
  }

  const int* rows_;
  const double* entries_;
  int height_, width_;
};

class cholmod final : public sparse_factor {
 public:
  explicit cholmod(const sparse_columns& a) {
    constexpr int many_rows = 25'000;  // METIS takes longer, but its order saves more time
    work_.nmethods = 0;
    if (a.order() >= many_rows) work_.method[work_.nmethods++].ordering = CHOLMOD_METIS;
    work_.method[work_.nmethods++].ordering = CHOLMOD_AMD;
    cholmod_sparse view = view_of(a);
    order_ = made(cholmod_analyze(&view, &work_));
    prepare();
  }
  cholmod(cholmod_factor& order, double flops) : order_(made(cholmod_copy_factor(&order, &work_))) {
    work_.fl = flops;
    prepare();
  }
  ~cholmod() override {
    for (cholmod_factor** factor : {&factor_, &order_}) cholmod_free_factor(factor, &work_);
    for (cholmod_dense** vector : {&b_, &x_, &y_, &e_}) cholmod_free_dense(vector, &work_);
  }

  [[nodiscard]] std::unique_ptr<sparse_factor> likewise() const override {
    return std::make_unique<cholmod>(*order_, work_.fl);
  }

  [[nodiscard]] std::int64_t bytes() const override {
    return static_cast<std::int64_t>(sizeof(double) * factor_->xsize + sizeof(int) * factor_->ssize);
  }

  [[nodiscard]] bool factor(const sparse_columns& a) override {
    cholmod_sparse view = view_of(a);
    const no_openmp_threads alone;
    const bool done = cholmod_factorize(&view, factor_, &work_) != 0;
    if (work_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    return done && work_.status == CHOLMOD_OK && factor_->minor == factor_->n;
  }

  void solve(std::span<double> b) override {
    const std::size_t n = factor_->n;
    constexpr std::size_t together = std::tuple_size_v<row_of_block>;
    if (b.size() > n && factor_->is_super != 0) {
      for (std::size_t from = 0; from < b.size(); from += together * n)
        solve_block(b.subspan(from, std::min(together * n, b.size() - from)));
      return;
    }
    for (std::size_t from = 0; from < b.size(); from += n) solve_one(b.subspan(from, n));
  }

  [[nodiscard]] sparse_columns lower() const override {
    sparse_columns l;
    l.rows.reserve(factor_->xsize);
    l.values.reserve(factor_->xsize);
    for (std::size_t s = 0; s < factor_->nsuper; ++s) supernode(*factor_, s).append_to(l);
    return l;
  }
  [[nodiscard]] const std::vector<int>& places() const override { return places_; }

  [[nodiscard]] double flops() const override { return work_.fl; }

 private:
  /// Allocates a factor with the rows in the order of order_, and vectors for solves.
  void prepare() {
    factor_ = made(cholmod_copy_factor(order_, &work_));
    // x_, y_ and e_ are for cholmod_solve2, which crashes if it cannot allocate them itself.
    for (cholmod_dense** vector : {&b_, &x_, &y_})
      *vector = made(cholmod_zeros(factor_->n, 1, CHOLMOD_REAL, &work_));
    e_ = made(cholmod_zeros(std::max<std::size_t>(factor_->maxesize, 1), 1, CHOLMOD_REAL, &work_));
    places_.resize(factor_->n);
    const auto* const order = static_cast<const int*>(factor_->Perm);
    for (int i = 0; i < static_cast<int>(factor_->n); ++i) places_[order[i]] = i;
  }

  /// CHOLMOD's view of A, without a copy. CHOLMOD's functions do not change A.
  static cholmod_sparse view_of(const sparse_columns& a) {
    cholmod_sparse view{};
    view.nrow = view.ncol = a.order();
    view.nzmax = a.values.size();
    // NOLINTBEGIN(*-const-cast)
    view.p = const_cast<int*>(a.starts.data());
    view.i = const_cast<int*>(a.rows.data());
    view.x = const_cast<double*>(a.values.data());
    // NOLINTEND(*-const-cast)
    view.stype = -1;  // symmetric; the lower triangle is stored
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    return view;
  }

  void solve_one(std::span<double> b) {
    std::copy(b.begin(), b.end(), static_cast<double*>(b_->x));
    if (cholmod_solve2(CHOLMOD_A, factor_, b_, nullptr, &x_, nullptr, &y_, &e_, &work_) == 0)
      throw std::bad_alloc();
    std::copy_n(static_cast<const double*>(x_->x), b.size(), b.begin());
  }

  /// Solves for at most as many right-hand sides as a row_of_block has numbers.
  void solve_block(std::span<double> b) {
    const std::size_t n = factor_->n;
    block_.assign(n, {});
    for (std::size_t i = 0; i < b.size(); ++i) block_[places_[i % n]][i / n] = b[i];
    for (std::size_t s = 0; s < factor_->nsuper; ++s) supernode(*factor_, s).go_forward(block_);
    for (std::size_t s = factor_->nsuper; s-- > 0;) supernode(*factor_, s).go_back(block_);
    for (std::size_t i = 0; i < b.size(); ++i) b[i] = block_[places_[i % n]][i / n];
  }

  workspace work_;
  std::vector<int> places_;          // [rows of A] the row in the factor
  cholmod_factor* order_ = nullptr;  // symbolic factor: the order of rows
  cholmod_factor* factor_ = nullptr;
  std::vector<row_of_block> block_;  // [rows of the factor]
  cholmod_dense* b_ = nullptr;
  cholmod_dense* x_ = nullptr;
  cholmod_dense* y_ = nullptr;
  cholmod_dense* e_ = nullptr;
};

}  // namespace

bool sparse_factor::available() {
  return true;
}

std::unique_ptr<sparse_factor> sparse_factor::make(const sparse_columns& a) {
  return std::make_unique<cholmod>(a);
}

}  // namespace contct
#else

#include <stdexcept>

namespace contct {

bool sparse_factor::available() {
  return false;
}

std::unique_ptr<sparse_factor> sparse_factor::make(const sparse_columns& /*a*/) {
  throw std::logic_error("a sparse factor needs CHOLMOD, which is not built in");
}

}  // namespace contct
#endif
