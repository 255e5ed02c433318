// What ranks need that read a file by parts: the file, what is wrong with it as all ranks see it, and entries
// that go to the ranks that have their rows.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "contct/distributed/petsc/distributed_matrix.hpp"
#include "contct/distributed/petsc/matrix_file.hpp"
#include "contct/distributed/petsc/messages.hpp"
#include "contct/text/input_text.hpp"

namespace contct::distributed::petsc {

using text::input_error;

/// Something wrong with the file, and which of what ranks find comes first.
struct refusal {
  std::int64_t place;
  std::string words;
};

inline int rank_in(MPI_Comm job) {
  int rank = 0;
  MPI_Comm_rank(job, &rank);
  return rank;
}

inline int ranks_in(MPI_Comm job) {
  int ranks = 0;
  MPI_Comm_size(job, &ranks);
  return ranks;
}

/// Every rank throws the first refusal of any.
inline void agree(MPI_Comm job, const std::optional<refusal>& own) {
  struct {
    long place;
    int rank;
  } first{own ? own->place : std::numeric_limits<long>::max(), rank_in(job)};
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_LONG_INT, MPI_MINLOC, job);
  if (first.place == std::numeric_limits<long>::max()) return;
  std::string words = own ? own->words : "";
  int size = static_cast<int>(words.size());
  MPI_Bcast(&size, 1, MPI_INT, first.rank, job);
  words.resize(static_cast<std::size_t>(size));
  MPI_Bcast(words.data(), size, MPI_CHAR, first.rank, job);
  throw input_error(words);
}

/// The same where `work` may throw an input_error; those of lower ranks come first.
template <class Work>
void agree_on(MPI_Comm job, const Work& work) {
  std::optional<refusal> own;
  try {
    work();
  } catch (const input_error& e) {
    own = {rank_in(job), e.what()};
  }
  agree(job, own);
}

/// What rank 0 finds, on every rank; what it refuses, every rank refuses.
template <class Find>
auto found_by_rank_0(MPI_Comm job, const Find& find) {
  decltype(find()) found{};
  agree_on(job, [&] {
    if (rank_in(job) == 0) found = find();
  });
  const mpi_type<decltype(found)> type;
  MPI_Bcast(&found, 1, type.get(), 0, job);
  return found;
}

/// A file that is open. Its members may throw on one rank alone: whatever else waits for the others stands
/// outside of the agree_on that they are called in.
class open_file {
 public:
  explicit open_file(const matrix_file& f)
      : name_(f.name), file_(open(f.path.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat is {};
    if (file_ < 0 || fstat(file_, &is) != 0)
      throw input_error(name_ + ": cannot be read: " + std::strerror(errno));
    if (!S_ISREG(is.st_mode))
      text::refuse_line(name_, 0, S_ISDIR(is.st_mode) ? "a directory" : "no regular file",
                        "a regular file, of which each rank reads a part");
    size_ = static_cast<std::size_t>(is.st_size);
  }
  ~open_file() {
    if (file_ >= 0) (void)close(file_);
  }
  open_file(const open_file&) = delete;
  open_file& operator=(const open_file&) = delete;

  [[nodiscard]] std::size_t size() const { return size_; }
  /// A file that grows or shrinks has one size for all ranks. Collective.
  void agree_on_size(MPI_Comm job) {
    size_ = found_by_rank_0(job, [this] { return size_; });
  }
  /// As many bytes from `at` on as there are, at most `count`.
  [[nodiscard]] std::string bytes(std::size_t at, std::size_t count) const {
    std::string text(std::min(count, size_ - std::min(at, size_)), '\0');
    for (std::size_t got = 0; got < text.size();) {
      const ssize_t n = pread(file_, text.data() + got, text.size() - got, static_cast<off_t>(at + got));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) throw input_error(name_ + ": cannot be read to its end");
      got += static_cast<std::size_t>(n);
    }
    return text;
  }
  /// The first byte behind the line that byte `at` is in.
  [[nodiscard]] std::size_t end_of_line(std::size_t at) const {
    constexpr std::size_t block = 4096;
    for (; at < size_; at += block) {
      const std::size_t end = bytes(at, block).find('\n');
      if (end != std::string::npos) return at + end + 1;
    }
    return size_;
  }

 private:
  std::string name_;
  int file_;
  std::size_t size_ = 0;
};

inline std::int64_t sum_before(MPI_Comm job, std::int64_t own) {
  std::int64_t before = 0;
  MPI_Exscan(&own, &before, 1, MPI_INT64_T, MPI_SUM, job);
  return rank_in(job) == 0 ? 0 : before;
}

inline std::int64_t sum_of(MPI_Comm job, std::int64_t own) {
  MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_INT64_T, MPI_SUM, job);
  return own;
}

/// Which rank has which rows.
class owners {
 public:
  owners(MPI_Comm job, const own_rows& own) : starts_(static_cast<std::size_t>(ranks_in(job))) {
    MPI_Allgather(&own.first, 1, MPI_INT, starts_.data(), 1, MPI_INT, job);
  }
  [[nodiscard]] std::size_t of(int row) const {
    return static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), row) - starts_.begin()) -
           1;
  }
  [[nodiscard]] std::size_t count() const { return starts_.size(); }

 private:
  std::vector<int> starts_;
};

/// Each entry to the rank that `to` says; those that came, from rank 0 on.
template <class Entry, class To>
std::vector<Entry> exchanged(MPI_Comm job, const owners& all, std::vector<Entry> entries, const To& to) {
  std::vector<int> counts(all.count());
  for (const Entry& e : entries) ++counts[to(e)];
  std::vector<int> starts(all.count());
  for (std::size_t r = 1; r < starts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<Entry> sent(entries.size());
  std::vector<int> next = starts;
  for (const Entry& e : entries) sent[static_cast<std::size_t>(next[to(e)]++)] = e;
  entries = {};
  std::vector<int> coming(all.count());
  MPI_Alltoall(counts.data(), 1, MPI_INT, coming.data(), 1, MPI_INT, job);
  std::vector<int> places(all.count());
  for (std::size_t r = 1; r < places.size(); ++r) places[r] = places[r - 1] + coming[r - 1];
  std::vector<Entry> came(static_cast<std::size_t>(places.back() + coming.back()));
  const mpi_type<Entry> type;
  MPI_Alltoallv(sent.data(), counts.data(), starts.data(), type.get(), came.data(), coming.data(),
                places.data(), type.get(), job);
  return came;
}

}  // namespace contct::distributed::petsc
