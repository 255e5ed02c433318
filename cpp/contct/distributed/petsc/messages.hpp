// What ranks say to each other: vectors that rank 0 has whole, and the parts of them.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace contct::distributed::petsc {

/// A type of so many bytes, for MPI.
template <class Number>
class mpi_type {
 public:
  mpi_type() {
    static_assert(std::is_trivially_copyable_v<Number>);
    MPI_Type_contiguous(sizeof(Number), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~mpi_type() { MPI_Type_free(&type_); }
  mpi_type(const mpi_type&) = delete;
  mpi_type& operator=(const mpi_type&) = delete;
  [[nodiscard]] MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// The parts of a vector that the ranks have, in entries, and where they begin; on rank 0.
struct parts {
  std::vector<int> counts, starts;

  void gather_counts(MPI_Comm job, int own) {
    int ranks = 0;
    MPI_Comm_size(job, &ranks);
    counts.resize(static_cast<std::size_t>(ranks));
    MPI_Gather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, job);
    starts.assign(counts.size(), 0);
    for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  }
  [[nodiscard]] int all() const { return starts.back() + counts.back(); }
};

/// Each rank's part of what rank 0 has in `all`.
template <class Number>
std::vector<Number> scattered(MPI_Comm job, const Number* all, const parts& p, int own) {
  const mpi_type<Number> type;
  std::vector<Number> part(static_cast<std::size_t>(own));
  MPI_Scatterv(all, p.counts.data(), p.starts.data(), type.get(), part.data(), own, type.get(), 0, job);
  return part;
}

/// The parts of all ranks one after the other, on rank 0; nothing on the others.
template <class Number>
std::vector<Number> gathered(MPI_Comm job, std::span<const Number> own) {
  int rank = 0;
  MPI_Comm_rank(job, &rank);
  const mpi_type<Number> type;
  parts p;
  p.gather_counts(job, static_cast<int>(own.size()));
  std::vector<Number> all(rank == 0 ? static_cast<std::size_t>(p.all()) : 0);
  MPI_Gatherv(own.data(), static_cast<int>(own.size()), type.get(), all.data(), p.counts.data(),
              p.starts.data(), type.get(), 0, job);
  return all;
}

/// The same on every rank.
template <class Number>
std::vector<Number> gathered_everywhere(MPI_Comm job, std::span<const Number> own) {
  std::vector<Number> all = gathered(job, own);
  std::uint64_t size = all.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, job);
  all.resize(size);
  const mpi_type<Number> type;
  MPI_Bcast(all.data(), static_cast<int>(size), type.get(), 0, job);
  return all;
}

/// What rank 0 has in `whole`, on every rank; what the others have there does not count.
template <class Number>
std::vector<Number> from_rank_0(MPI_Comm job, std::span<const Number> whole) {
  int rank = 0;
  MPI_Comm_rank(job, &rank);
  std::uint64_t size = whole.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, job);
  std::vector<Number> all(size);
  if (rank == 0) all.assign(whole.begin(), whole.end());
  const mpi_type<Number> type;
  MPI_Bcast(all.data(), static_cast<int>(size), type.get(), 0, job);
  return all;
}

}  // namespace contct::distributed::petsc
