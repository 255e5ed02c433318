#include "contct/write/matrix_output.hpp"

#include <fmt/format.h>

#include <bit>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace contct::write {
namespace {

constexpr std::uint32_t petsc_matrix_id = 1211216;

/// Collects what is written, so that an entry costs no call of the system.
class collected {
 public:
  explicit collected(output_file& out) : out_(out) {}

  template <class... Arguments>
  void print(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(text_), words, std::forward<Arguments>(arguments)...);
    flush_if(most);
  }
  /// The most significant byte first.
  template <class Unsigned>
  void put(Unsigned number) {
    for (int shift = 8 * (static_cast<int>(sizeof number) - 1); shift >= 0; shift -= 8)
      text_ += static_cast<char>(number >> shift & 0xff);
    flush_if(most);
  }
  void put_int(int number) { put(static_cast<std::uint32_t>(number)); }
  void flush() { flush_if(1); }

 private:
  static constexpr std::size_t most = 1 << 16;

  void flush_if(std::size_t size) {
    if (text_.size() < size) return;
    out_.write(text_);
    text_.clear();
  }

  output_file& out_;
  std::string text_;
};

/// The entries below the diagonal, row by row, columns ascending.
struct strictly_lower_rows {
  explicit strictly_lower_rows(const sparse_columns& k) : starts(static_cast<std::size_t>(k.order()) + 1, 0) {
    const auto for_each = [&k](const auto& visit) {
      for (int column = 0; column < k.order(); ++column)
        for (int i = k.starts[column] + 1; i < k.starts[column + 1]; ++i) visit(k.rows[i], column, i);
    };
    for_each([&](int row, int /*column*/, int /*entry*/) { ++starts[row + std::size_t{1}]; });
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<int> next(starts.begin(), starts.end() - 1);
    columns.resize(static_cast<std::size_t>(starts.back()));
    entries.resize(columns.size());
    for_each([&](int row, int column, int entry) {
      columns[next[row]] = column;
      entries[next[row]++] = entry;
    });
  }

  std::vector<int> starts;   ///< [rows + 1]
  std::vector<int> columns;  ///< [entries]
  std::vector<int> entries;  ///< [entries] their places in the columns
};

}  // namespace

std::int64_t write_matrix_market(const sparse_matrix& a, output_file& out) {
  const sparse_columns k = columns_of(a);
  collected text(out);
  text.print("%%MatrixMarket matrix coordinate real symmetric\n{0} {0} {1}\n", k.order(), k.starts.back());
  for (int column = 0; column < k.order(); ++column)
    for (int i = k.starts[column]; i < k.starts[column + 1]; ++i)
      text.print("{} {} {}\n", k.rows[i] + 1, column + 1, k.values[i]);
  text.flush();
  return k.starts.back();
}

std::int64_t write_petsc_matrix(const sparse_matrix& a, output_file& out, std::int64_t most) {
  const sparse_columns k = columns_of(a);
  const std::int64_t count = 2 * std::int64_t{k.starts.back()} - k.order();
  if (count > most)
    throw std::length_error(fmt::format(
        "found {} entries in both triangles; allowed in PETSc's binary: at most {}", count, most));
  const strictly_lower_rows lower(k);
  collected bytes(out);
  bytes.put(petsc_matrix_id);
  for (const int size : {k.order(), k.order(), static_cast<int>(count)}) bytes.put_int(size);
  for (int row = 0; row < k.order(); ++row)
    bytes.put_int(lower.starts[row + 1] - lower.starts[row] + k.starts[row + 1] - k.starts[row]);
  for (int row = 0; row < k.order(); ++row) {
    for (int i = lower.starts[row]; i < lower.starts[row + 1]; ++i) bytes.put_int(lower.columns[i]);
    for (int i = k.starts[row]; i < k.starts[row + 1]; ++i) bytes.put_int(k.rows[i]);
  }
  const auto put_value = [&](int entry) { bytes.put(std::bit_cast<std::uint64_t>(k.values[entry])); };
  for (int row = 0; row < k.order(); ++row) {
    for (int i = lower.starts[row]; i < lower.starts[row + 1]; ++i) put_value(lower.entries[i]);
    for (int i = k.starts[row]; i < k.starts[row + 1]; ++i) put_value(i);
  }
  bytes.flush();
  return count;
}

}  // namespace contct::write
