// PETSc's binary file of a matrix, right or wrong: made byte by byte, by nothing that the program has.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace contct::app {

/// Entries of one row: column, from 0, and value.
using petsc_row = std::vector<std::pair<int, double>>;

inline void put_petsc(std::string& bytes, std::uint64_t number, int size) {
  for (int byte = size - 1; byte >= 0; --byte) bytes += static_cast<char>(number >> (8 * byte));
}

/// 4 bytes at `at` replaced.
inline std::string with_int(std::string bytes, std::size_t at, int number) {
  std::string four;
  put_petsc(four, static_cast<std::uint32_t>(number), 4);
  return bytes.replace(at, 4, four);
}

inline std::string petsc_bytes(const std::vector<petsc_row>& rows) {
  std::size_t count = 0;
  for (const petsc_row& row : rows) count += row.size();
  std::string bytes;
  for (const std::size_t number : {std::size_t{1211216}, rows.size(), rows.size(), count})
    put_petsc(bytes, number, 4);
  for (const petsc_row& row : rows) put_petsc(bytes, row.size(), 4);
  for (const petsc_row& row : rows)
    for (const auto& entry : row) put_petsc(bytes, static_cast<std::uint32_t>(entry.first), 4);
  for (const petsc_row& row : rows) {
    for (const auto& entry : row) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &entry.second, sizeof bits);
      put_petsc(bytes, bits, 8);
    }
  }
  return bytes;
}

}  // namespace contct::app
