// What memory exact arithmetic takes, before it is taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "contct/structure/problem.hpp"

namespace contct::exact {

/// The sizes that decide it.
struct demand {
  std::int64_t dofs = 0;
  std::int64_t band = 0;     ///< subdiagonals of the factor modulo a prime
  std::int64_t entries = 0;  ///< of K, both triangles
  std::int64_t vectors = 0;  ///< of exact numbers at all dofs that are held at once
  std::int64_t bits = 0;     ///< of the longest number in the file

  [[nodiscard]] std::int64_t bytes_of_equations() const;  ///< K in rational numbers, and its factor
  [[nodiscard]] std::int64_t bytes_of_vectors(std::int64_t bits_each) const;
  [[nodiscard]] std::int64_t bytes() const { return bytes_of_equations() + bytes_of_vectors(bits); }
  /// How long numbers may become so that all is within `bytes`, and at most `most`.
  [[nodiscard]] std::size_t bits_within(std::int64_t bytes, std::size_t most) const;

  /// "120 dofs by a half bandwidth of 5, and 14 vectors of 120 numbers of 64 bits: 1.2 MiB".
  [[nodiscard]] std::string words() const;
};

[[nodiscard]] demand demand_of(const problem& p);

}  // namespace contct::exact
