#include "contct/distributed/petsc/petsc_file.hpp"

#include <bit>
#include <cmath>
#include <numeric>

#include "contct/read/petsc_matrix.hpp"

namespace contct::distributed::petsc {
namespace {

constexpr std::size_t bytes_of_header = 16, bytes_of_int = 4, bytes_of_value = 8;

/// `count` numbers from byte `at` on, each with its most significant byte first.
template <class Number, class Unsigned>
std::vector<Number> numbers_at(const open_file& f, std::size_t at, std::size_t count) {
  const std::string bytes = f.bytes(at, count * sizeof(Number));
  std::vector<Number> all;
  for (std::size_t byte = 0; byte + sizeof(Number) <= bytes.size(); byte += sizeof(Number)) {
    Unsigned number = 0;
    for (std::size_t i = 0; i < sizeof(Number); ++i)
      number = static_cast<Unsigned>(number << 8 | static_cast<unsigned char>(bytes[byte + i]));
    all.push_back(std::bit_cast<Number>(number));
  }
  return all;
}

std::vector<int> ints_at(const open_file& f, std::size_t at, std::size_t count) {
  return numbers_at<std::int32_t, std::uint32_t>(f, at, count);
}

/// Of the whole matrix.
struct matrix_header {
  int rows, entries;
};

/// Nothing where it cannot be.
std::optional<matrix_header> header_of(const open_file& f) {
  const std::vector<int> header = ints_at(f, 0, 4);
  if (header.size() < 4 || header[0] != static_cast<int>(read::petsc_matrix_id)) return std::nullopt;
  const auto [rows, columns, entries] = std::tuple(header[1], header[2], header[3]);
  if (rows < 1 || columns != rows || entries < rows || rows == std::numeric_limits<int>::max() ||
      entries == std::numeric_limits<int>::max())
    return std::nullopt;
  const std::size_t all = bytes_of_header + bytes_of_int * static_cast<std::size_t>(rows) +
                          (bytes_of_int + bytes_of_value) * static_cast<std::size_t>(entries);
  if (f.size() != all) return std::nullopt;
  return matrix_header{rows, entries};
}

struct place {
  int row, column;
  double value;
};

/// Own rows, in the order of the columns.
class own_part {
 public:
  own_part(MPI_Comm job, const open_file& f, const own_rows& own, matrix_header whole) : own_(own) {
    const auto [rows, entries] = whole;
    const auto n = static_cast<std::size_t>(rows);
    std::vector<int> lengths;
    agree_on(job, [&] {
      lengths = ints_at(f, bytes_of_header + bytes_of_int * static_cast<std::size_t>(own.first),
                        static_cast<std::size_t>(own.count));
    });
    const bool possible = std::ranges::all_of(lengths, [n = whole.rows](int x) { return x >= 1 && x <= n; });
    const std::int64_t count =
        possible ? std::accumulate(lengths.begin(), lengths.end(), std::int64_t{0}) : 0;
    const auto before = static_cast<std::size_t>(sum_before(job, count));
    const bool all_possible = sum_of(job, possible ? 0 : 1) == 0;
    if (sum_of(job, count) != entries || !all_possible) return;
    const std::size_t columns = bytes_of_header + bytes_of_int * n;
    const std::size_t values = columns + bytes_of_int * static_cast<std::size_t>(entries);
    const auto size = static_cast<std::size_t>(count);
    std::vector<int> column;
    std::vector<double> value;
    agree_on(job, [&] {
      column = ints_at(f, columns + bytes_of_int * before, size);
      value = numbers_at<double, std::uint64_t>(f, values + bytes_of_value * before, size);
    });
    places_.reserve(size);
    std::size_t next = 0;
    for (int row = 0; row < own.count; ++row)
      for (int i = 0; i < lengths[static_cast<std::size_t>(row)]; ++i, ++next)
        places_.push_back({own.first + row, column[next], value[next]});
    std::ranges::sort(places_, before_in_order);
    is_sound_ = std::ranges::all_of(places_, [n = whole.rows](const place& p) {
      return p.column >= 0 && p.column < n && std::isfinite(p.value);
    });
    for (std::size_t i = 1; i < size; ++i)
      is_sound_ =
          is_sound_ && (places_[i].row != places_[i - 1].row || places_[i].column != places_[i - 1].column);
  }

  [[nodiscard]] bool is_sound() const { return is_sound_; }
  [[nodiscard]] const std::vector<place>& places() const { return places_; }

  /// Is the other triangle the same? Collective.
  [[nodiscard]] bool is_symmetric(MPI_Comm job, const owners& all) const {
    std::vector<place> upper;
    for (const place& p : places_)
      if (p.column > p.row && p.value != 0.0) upper.push_back({p.column, p.row, p.value});
    std::vector<place> other =
        exchanged(job, all, std::move(upper), [&](const place& p) { return all.of(p.row); });
    std::ranges::sort(other, before_in_order);
    std::vector<place> lower;
    for (const place& p : places_)
      if (p.column < p.row && p.value != 0.0) lower.push_back(p);
    return std::ranges::equal(lower, other, [](const place& a, const place& b) {
      return a.row == b.row && a.column == b.column && a.value == b.value;
    });
  }

  /// Is a diagonal missing or negative, or 0 where its row has entries? Collective.
  [[nodiscard]] bool may_be_semidefinite(MPI_Comm job) const {
    std::vector<char> stiff(static_cast<std::size_t>(own_.count));
    int diagonals = 0;
    bool sound = true;
    for (const place& p : places_) {
      if (p.row != p.column) continue;
      ++diagonals;
      sound = sound && p.value >= 0;
      stiff[static_cast<std::size_t>(p.row - own_.first)] = p.value > 0 ? 1 : 0;
    }
    const std::vector<char> all = gathered_everywhere(job, std::span<const char>(stiff));
    for (const place& p : places_)
      sound = sound && (p.value == 0.0 || (all[static_cast<std::size_t>(p.row)] != 0 &&
                                           all[static_cast<std::size_t>(p.column)] != 0));
    return sound && diagonals == own_.count;
  }

 private:
  static bool before_in_order(const place& a, const place& b) {
    return a.row != b.row ? a.row < b.row : a.column < b.column;
  }
  own_rows own_;
  bool is_sound_ = false;
  std::vector<place> places_;
};

/// One process looks for what is wrong, and says it.
[[noreturn]] void refuse(MPI_Comm job, const open_file& file, const matrix_file& what) {
  agree_on(job, [&] {
    if (rank_in(job) == 0) (void)read::parse_petsc_matrix(file.bytes(0, file.size()), what.name);
  });
  throw input_error(what.name + ": cannot be read by parts: it has changed since");
}

}  // namespace

own_matrix read_own_binary(MPI_Comm job, const open_file& file, const matrix_file& what) {
  const auto header = found_by_rank_0(job, [&] { return header_of(file); });
  if (!header) refuse(job, file, what);
  const own_rows own(job, header->rows);
  const owners all(job, own);
  const own_part part(job, file, own, *header);
  if (sum_of(job, part.is_sound() ? 0 : 1) > 0) refuse(job, file, what);
  const bool symmetric = part.is_symmetric(job, all);
  const bool semidefinite = part.may_be_semidefinite(job);
  if (sum_of(job, symmetric && semidefinite ? 0 : 1) > 0) refuse(job, file, what);
  own_matrix m;
  m.rows.first = own.first;
  auto next = part.places().begin();
  for (int row = own.first; row < own.first + own.count; ++row) {
    for (; next != part.places().end() && next->row == row; ++next) {
      if (next->value == 0.0) continue;
      m.rows.columns.push_back(next->column);
      m.rows.values.push_back(next->value);
    }
    m.rows.starts.push_back(m.rows.columns.size());
  }
  return m;
}

}  // namespace contct::distributed::petsc
