#include "contct/read/model_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "contct/read/matrix_tables.hpp"

namespace contct::read {
namespace {

constexpr int most_elements = 2'000'000;
// Two bands of this size are held: 8 GB together.
constexpr std::int64_t most_band_entries = 500'000'000;
constexpr real_range poisson{-1.0, false, "a number greater than -1 and at most 0.5", 0.5};

/// The increasing coordinates of `what`.
std::vector<double> read_coordinates(const table_reader& t, const char* key, const char* what) {
  std::vector<double> x = t.reals(key, any_real, 2);
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > x[i - 1]) continue;
    const toml::node& entry = *t.array(key, "", 2).get(i);
    t.refuse(entry, indexed(key, i), found_words(entry),
             fmt::format("more than the {} before it, {}", what, x[i - 1]));
  }
  return x;
}

std::vector<double> even_coordinates(double length, int elements) {
  std::vector<double> x;
  x.reserve(elements + 1);
  for (int i = 0; i <= elements; ++i) x.push_back(length * i / elements);
  return x;
}

void read_stiffness(const table_reader& t, beam& b) {
  const std::size_t elements = b.elements();
  if (!t.required("EI", "a number greater than 0, or one for each element").is_array()) {
    b.EI.assign(elements, t.real("EI", positive_real));
    return;
  }
  b.EI = t.reals("EI", positive_real, 1);
  if (b.EI.size() != elements)
    t.refuse_key("EI", fmt::format("one number, or {}: one for each element", elements));
}

/// Finite numbers can still make a stiffness that is not.
void check_elements(const table_reader& t, const beam& b) {
  for (int e = 0; e < b.elements(); ++e) {
    const double h = b.length_of(e);
    const double EI = b.EI[e];
    const double largest = 12 * EI / h / h / h;
    const double smallest = EI / h;
    if (!std::isnormal(h) || !std::isnormal(largest) || !std::isnormal(smallest) ||
        !std::isfinite(largest * h) || !std::isfinite(12 * smallest)) {
      t.refuse(fmt::format("element {} of length {:g} and EI {:g}", e + 1, h, EI),
               "elements whose stiffness 12 EI / h^3 is within the range of double precision");
    }
  }
}

beam read_beam(const table_reader& t) {
  t.allow_only({"x", "length", "elements", "EI"});
  beam b;
  if (t.has("x")) {
    t.refuse_beside({"length", "elements"}, "x", "either x, or length and elements");
    b.x = read_coordinates(t, "x", "node");
  } else {
    const double length = t.real("length", positive_real);
    b.x = even_coordinates(length, t.integer("elements", 1, most_elements));
  }
  read_stiffness(t, b);
  check_elements(t, b);
  return b;
}

/// Refuse a grid that no machine could solve, before anything of its size is allocated.
void check_size(const table_reader& t, std::int64_t along_x, std::int64_t along_y) {
  constexpr double gigabyte = 1e9 / sizeof(double);
  const std::int64_t shorter = std::min(along_x, along_y);
  const std::int64_t longer = std::max(along_x, along_y);
  if (longer > most_elements || shorter * longer > most_elements) {
    t.refuse(fmt::format("{} x {} elements", along_x, along_y),
             fmt::format("at most {} elements", most_elements));
  }
  const std::int64_t entries = 3 * (shorter + 1) * (longer + 1) * (3 * (shorter + 2) + 3);
  if (entries > most_band_entries) {
    t.refuse(fmt::format("{} x {} elements, whose stiffness matrix takes {:.1f} GB", along_x, along_y,
                         static_cast<double>(entries) / gigabyte),
             fmt::format("at most {:.1f} GB: it grows with the square of the shorter side",
                         static_cast<double>(most_band_entries) / gigabyte));
  }
}

std::vector<double> read_size(const table_reader& t) {
  std::vector<double> size = t.reals("size", positive_real, 2);
  if (size.size() != 2) t.refuse_key("size", "two numbers: along x, along y");
  return size;
}

std::vector<int> read_counts(const table_reader& t) {
  const char* const allowed = "two whole numbers: elements along x, along y";
  const toml::array& array = t.array("elements", allowed, 2);
  if (array.size() != 2) t.refuse_key("elements", allowed);
  std::vector<int> counts;
  for (std::size_t i = 0; i < 2; ++i)
    counts.push_back(t.integer_of(*array.get(i), indexed("elements", i), 1, most_elements));
  return counts;
}

void read_grid(const table_reader& t, plate& p) {
  if (t.has("x") || t.has("y")) {
    t.refuse_beside({"size", "elements"}, "x or y", "either x and y, or size and elements");
    p.x = read_coordinates(t, "x", "line");
    p.y = read_coordinates(t, "y", "line");
    check_size(t, p.x.size() - 1, p.y.size() - 1);
    return;
  }
  const std::vector<double> size = read_size(t);
  const std::vector<int> counts = read_counts(t);
  check_size(t, counts[0], counts[1]);
  p.x = even_coordinates(size[0], counts[0]);
  p.y = even_coordinates(size[1], counts[1]);
}

void read_material(const table_reader& t, plate& p) {
  p.nu = t.real("nu", poisson);
  if (t.has("D")) {
    t.refuse_beside({"E", "thickness"}, "D", "either D, or E and thickness");
    p.D = t.real("D", positive_real);
    return;
  }
  const double E = t.real("E", positive_real);
  p.D = bending_stiffness(E, p.nu, t.real("thickness", positive_real));
  if (!std::isnormal(p.D)) {
    t.refuse(fmt::format("E, nu and thickness that make D = {:g}", p.D),
             "D = E t^3 / 12 (1 - nu^2) within the range of double precision");
  }
}

/// The same for plates: D b / a^3 along x and y, with the moments and twists that go with it.
void check_elements(const table_reader& t, const plate& p) {
  const auto sound = [&](double a, double b) {
    const double along = p.D * b / a / a / a;
    return std::isnormal(a) && std::isnormal(along) && std::isfinite(1000 * along) &&
           std::isfinite(1000 * along * a) && std::isnormal(p.D * b / a) &&
           std::isfinite(1000 * p.D * b / a) && std::isnormal(p.D / a / b);
  };
  for (int e = 0; e < p.elements(); ++e) {
    const double width = p.width_of(e);
    const double height = p.height_of(e);
    if (!sound(width, height) || !sound(height, width)) {
      t.refuse(fmt::format("element {}, {:g} by {:g}, and D {:g}", e + 1, width, height, p.D),
               "elements whose stiffness, as D b / a^3, is within the range of double precision");
    }
  }
}

plate read_plate(const table_reader& t) {
  t.allow_only({"x", "y", "size", "elements", "E", "nu", "thickness", "D"});
  plate p;
  read_grid(t, p);
  read_material(t, p);
  check_elements(t, p);
  return p;
}

}  // namespace

model read_model(const table_reader& top, const std::string& folder) {
  const char* const allowed = "exactly one of [beam], [plate], [matrix] and [calculix]";
  const char* kind = nullptr;
  for (const char* other : {"beam", "plate", "matrix", "calculix"}) {
    if (!top.has(other)) continue;
    if (kind != nullptr) top.refuse_key(other, fmt::format("this beside {}", kind), allowed);
    kind = other;
  }
  if (top.has("beam")) return {read_beam(top.table("beam"))};
  if (top.has("plate")) return {read_plate(top.table("plate"))};
  if (top.has("matrix")) return {read_matrix(top.table("matrix"), folder)};
  if (top.has("calculix")) return {read_calculix(top.table("calculix"), folder)};
  top.refuse("neither beam nor plate, matrix or calculix", allowed);
}

}  // namespace contct::read
