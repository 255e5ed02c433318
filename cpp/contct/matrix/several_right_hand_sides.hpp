// Several right-hand sides side by side.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

namespace contct {

/// How many right-hand sides go through a factor together.
inline constexpr int side_by_side = 8;

/// `many` right-hand sides' entries of one row; the compiler keeps them in as many registers as they need.
struct rows_side_by_side {
  using lanes = double __attribute__((vector_size(16)));
  static constexpr std::size_t parts = side_by_side / 2;
  std::array<lanes, parts> part;

  static rows_side_by_side load(const double* from) {
    rows_side_by_side r{};
    std::memcpy(r.part.data(), from, sizeof r.part);
    return r;
  }
  void store(double* to) const { std::memcpy(to, part.data(), sizeof part); }
  void add(double entry, const rows_side_by_side& x) {
    for (std::size_t i = 0; i < parts; ++i) part[i] += entry * x.part[i];
  }
  void subtract(double entry, const rows_side_by_side& x) {
    for (std::size_t i = 0; i < parts; ++i) part[i] -= entry * x.part[i];
  }
  void subtract(const rows_side_by_side& x) {
    for (std::size_t i = 0; i < parts; ++i) part[i] -= x.part[i];
  }
  void divide(double pivot) {
    for (std::size_t i = 0; i < parts; ++i) part[i] /= pivot;
  }
};

}  // namespace contct
