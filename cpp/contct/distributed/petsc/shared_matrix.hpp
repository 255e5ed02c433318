// A matrix as all ranks share it: rank 0 has it and its right-hand sides whole, each rank its own rows.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "contct/distributed/petsc/distributed_matrix.hpp"
#include "contct/distributed/petsc/messages.hpp"
#include "contct/matrix/block_solve.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

namespace contct::distributed::petsc {

/// Right-hand sides that are solved for together.
inline constexpr int width = static_cast<int>(matrix::block_width);

/// A matrix as its ranks have it, and what rank 0 knows of them.
class shared_matrix {
 public:
  /// Collective; `a` counts on rank 0 alone.
  shared_matrix(MPI_Comm job, int order, const matrix::sparse_columns* a) : job_(job) {
    const own_rows rows(job, order);
    rows_.gather_counts(job, rows.count);
    own_.emplace(job, order, own_part(rows, a));
  }
  /// Of rows that every rank has already.
  shared_matrix(MPI_Comm job, int order, const upper_rows& own, const own_motions& motions) : job_(job) {
    rows_.gather_counts(job, static_cast<int>(own.starts.size()) - 1);
    own_.emplace(job, order, own, motions);
  }

  [[nodiscard]] distributed_matrix& own() { return *own_; }
  [[nodiscard]] int order() const { return rows_.all(); }  // on rank 0

  [[nodiscard]] factored factor(const double* diagonal) {
    return own_->factor(scattered(job_, diagonal, rows_, own_->rows().count));
  }

  void solve(double* b) {
    std::vector<double> part = scattered(job_, b, rows_, own_->rows().count);
    own_->solve(part);
    MPI_Gatherv(part.data(), own_->rows().count, MPI_DOUBLE, b, rows_.counts.data(), rows_.starts.data(),
                MPI_DOUBLE, 0, job_);
  }

  /// Solutions for unit vectors are wanted at these rows.
  void watch(std::vector<int> rows) {
    MPI_Bcast(rows.data(), static_cast<int>(rows.size()), MPI_INT, 0, job_);
    watched_ = std::move(rows);
    const own_rows& own = own_->rows();
    const auto is_own = [&own](int row) { return row >= own.first && row < own.first + own.count; };
    found_.gather_counts(job_,
                         width * static_cast<int>(std::count_if(watched_.begin(), watched_.end(), is_own)));
    order_.clear();
    for (std::size_t rank = 0; rank < rows_.counts.size(); ++rank) {  // as they will come
      const int first = rows_.starts[rank];
      for (std::size_t i = 0; i < watched_.size(); ++i)
        if (watched_[i] >= first && watched_[i] < first + rows_.counts[rank]) order_.push_back(i);
    }
  }
  [[nodiscard]] bool watches(std::span<const int> rows) const {
    return std::equal(rows.begin(), rows.end(), watched_.begin(), watched_.end());
  }

  /// `x` [watched][width] counts on rank 0.
  void solve_units(std::span<const int> units, std::vector<double>* x) {
    const std::vector<double> part = own_->solve_units(units, watched_, width);
    std::vector<double> all(x == nullptr ? 0 : static_cast<std::size_t>(found_.all()));
    MPI_Gatherv(part.data(), static_cast<int>(part.size()), MPI_DOUBLE, all.data(), found_.counts.data(),
                found_.starts.data(), MPI_DOUBLE, 0, job_);
    if (x == nullptr) return;
    x->resize(watched_.size() * width);
    for (std::size_t i = 0; i < order_.size(); ++i)
      std::copy_n(&all[i * width], width, &(*x)[order_[i] * width]);
  }

 private:
  /// Column j of a lower triangle is row j of the upper one.
  [[nodiscard]] upper_rows own_part(const own_rows& rows, const matrix::sparse_columns* a) const {
    std::vector<int> lengths;
    parts entries;
    if (a != nullptr) {
      for (int row = 0; row < a->order(); ++row) {
        const auto at = static_cast<std::size_t>(row);
        lengths.push_back(a->starts[at + 1] - a->starts[at]);
      }
    }
    upper_rows own;
    for (const int length : scattered(job_, lengths.data(), rows_, rows.count))
      own.starts.push_back(own.starts.back() + length);
    const int count = static_cast<int>(own.starts.back());
    entries.gather_counts(job_, count);
    const auto columns = scattered(job_, a != nullptr ? a->rows.data() : nullptr, entries, count);
    own.columns.assign(columns.begin(), columns.end());
    own.values = scattered(job_, a != nullptr ? a->values.data() : nullptr, entries, count);
    return own;
  }

  MPI_Comm job_;
  parts rows_;
  std::optional<distributed_matrix> own_;
  std::vector<int> watched_;
  parts found_;                     // entries of solve_units that each rank finds
  std::vector<std::size_t> order_;  // place in watched_ of what comes, rank by rank
};

}  // namespace contct::distributed::petsc
