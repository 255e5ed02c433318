#include "contct/exact/demand.hpp"

#include <algorithm>

#include "contct/text/memory.hpp"

namespace contct::exact {
namespace {

void put_structure(const beam& b, demand& d) {
  d.band = 3;
  d.entries = std::int64_t{16} * b.elements();
}

void put_structure(const plate& p, demand& d) {
  const std::int64_t shorter = std::min(p.columns(), p.rows());
  d.band = 3 * (shorter + 1) + 2;
  d.entries = std::int64_t{27} * p.dofs();
}

void put_structure(const assembled& a, demand& d) {
  d.band = subdiagonals_of(a.stiffness, a.rows);
  d.entries = 2 * static_cast<std::int64_t>(a.stiffness.entries.size());
}

constexpr std::int64_t bits_of_double = std::int64_t{17} * 4;  // its shortest decimal has 17 digits at most

// A rational is two numbers of 16 bytes and their bits; a row that grows may have as much room again as it
// needs.
constexpr std::int64_t bytes_of_rational = 32;
constexpr std::int64_t bytes_of_entry = 48 + bytes_of_rational + 32;

}  // namespace

std::int64_t demand::bytes_of_equations() const {
  return entries * bytes_of_entry + dofs * (band + 1) * static_cast<std::int64_t>(sizeof(std::uint64_t));
}

std::int64_t demand::bytes_of_vectors(std::int64_t bits_each) const {
  return vectors * dofs * (bytes_of_rational + bits_each / 4);  // of numerator and denominator
}

std::size_t demand::bits_within(std::int64_t bytes, std::size_t most) const {
  const std::int64_t each = (bytes - bytes_of_equations()) / std::max<std::int64_t>(1, vectors * dofs);
  const std::int64_t left = std::max<std::int64_t>(0, each - bytes_of_rational);
  return std::min(most, static_cast<std::size_t>(left) * 4);
}

std::string demand::words() const {
  return std::to_string(dofs) + " dofs by a half bandwidth of " + std::to_string(band) + ", " +
         std::to_string(entries) + " entries and " + std::to_string(vectors) + " vectors of numbers of " +
         std::to_string(bits) + " bits, which take " + bytes_words(bytes());
}

demand demand_of(const problem& p) {
  // The path's own: displacements, loads, responses, the digits of a solution and what is left of it.
  constexpr std::int64_t of_path = 12;
  demand d;
  d.dofs = dofs(p.geometry);
  std::visit([&d](const auto& kind) { put_structure(kind, d); }, p.geometry.kind);
  d.vectors = of_path + 3 * static_cast<std::int64_t>(p.steps.size());
  d.bits = bits_of_double;
  return d;
}

}  // namespace contct::exact
