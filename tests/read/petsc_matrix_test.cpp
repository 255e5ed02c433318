// PETSc's binary of a matrix: what is read, and what is refused where.
#include "contct/read/petsc_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/numeric/random.hpp"
#include "contct/read/matrix_files.hpp"
#include "read/refusals.hpp"
#include "support/petsc_bytes.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

const std::vector<petsc_row> good_rows = {
    {{0, 4}, {1, -1}}, {{0, -1}, {1, 4.5}, {2, -0.2}}, {{1, -0.2}, {2, 1}}};
const std::string good_petsc = petsc_bytes(good_rows);
// Where things stand in it.
constexpr std::size_t at_lengths = 16, at_columns = 28;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

std::string of_bytes(const std::string& bytes) {
  return verdict([&] { (void)parse_petsc_matrix(bytes, "K.petsc"); });
}

/// The good matrix with one entry replaced or, where `column` is -1, taken away.
std::string with(std::size_t row, std::size_t entry, int column, double value) {
  std::vector<petsc_row> rows = good_rows;
  if (column < 0)
    rows[row].erase(rows[row].begin() + static_cast<std::ptrdiff_t>(entry));
  else
    rows[row][entry] = {column, value};
  return petsc_bytes(rows);
}

/// Row, column and value of each entry, in order.
using listed = std::vector<std::tuple<int, int, double>>;
listed entries_in(const sparse_matrix& a) {
  listed all;
  for (const matrix_entry& e : a.entries) all.emplace_back(e.row, e.column, e.value);
  return all;
}

}  // namespace

TEST_CASE(
    "PETSc's binary is read as the Matrix Market file of the same matrix, and no last digit is in doubt") {
  const std::string text =
      "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 4\n2 1 -1\n2 2 4.5\n3 2 -0.2\n3 3 1\n";
  std::vector<std::string> warnings = {};
  const sparse_matrix a = parse_stiffness(good_petsc, "K", &warnings);
  CHECK(a.order == 3);
  CHECK(entries_in(a) == entries_in(parse_stiffness(text, "K")));
  CHECK(a.last_digits.empty());
  CHECK(a.half_unit(3) == 0.0);
  CHECK(warnings.empty());
  CHECK_FALSE(parse_stiffness(text, "K").last_digits.empty());
}

TEST_CASE("a file is PETSc's by its first four bytes") {
  CHECK(is_petsc_matrix(good_petsc));
  CHECK(is_petsc_matrix(good_petsc.substr(0, 4)));
  CHECK_FALSE(is_petsc_matrix(good_petsc.substr(0, 3)));
  CHECK(
      is_petsc_matrix(std::string(4, '\0') + good_petsc));  // with 64-bit integers, which are refused as such
  CHECK_FALSE(is_petsc_matrix(std::string(4, '\0') + good_petsc.substr(0, 3)));
  CHECK_FALSE(is_petsc_matrix(""));
  CHECK_FALSE(is_petsc_matrix("%%MatrixMarket"));
  CHECK_FALSE(is_petsc_matrix(with_int(good_petsc, 0, 1211214)));  // a vector
  CHECK(verdict([] { (void)parse_stiffness(with_int(good_petsc, 0, 1211214), "K"); }) ==
        "K: found a binary file that begins with 00127b4e; allowed: a Matrix Market file, or PETSc's binary "
        "of a "
        "matrix, which begins with 00127b50");
  CHECK_THAT(verdict([] { (void)parse_stiffness("3 3 1\n", "K"); }), Contains("%%MatrixMarket matrix"));
}

TEST_CASE("columns come in any order, and zeros are left out, whether the other triangle has them or not") {
  const listed expected = entries_in(parse_petsc_matrix(good_petsc, "K"));
  CHECK(entries_in(parse_petsc_matrix(
            petsc_bytes({{{1, -1}, {0, 4}}, {{2, -0.2}, {0, -1}, {1, 4.5}}, {{2, 1}, {1, -0.2}}}), "K")) ==
        expected);
  for (const double zero : {0.0, -0.0}) {
    CHECK(entries_in(parse_petsc_matrix(
              petsc_bytes({{{0, 4}, {1, -1}, {2, zero}}, good_rows[1], good_rows[2]}), "K")) == expected);
    CHECK(entries_in(parse_petsc_matrix(
              petsc_bytes({good_rows[0], good_rows[1], {{0, zero}, {1, -0.2}, {2, 1}}}), "K")) == expected);
    CHECK(entries_in(parse_petsc_matrix(
              petsc_bytes({{{0, 4}, {1, -1}, {2, 0.0}}, good_rows[1], {{0, zero}, {1, -0.2}, {2, 1}}}),
              "K")) == expected);
  }
  CHECK(parse_petsc_matrix(petsc_bytes({{{0, 2}}, {{1, 0}}}), "K").entries.size() ==
        1);  // a dof without stiffness
}

TEST_CASE("doubles come as they are, to the bit") {
  const double least = std::numeric_limits<double>::denorm_min();
  const double most = std::numeric_limits<double>::max();
  const sparse_matrix a =
      parse_petsc_matrix(petsc_bytes({{{0, most}, {1, -least}}, {{0, -least}, {1, 0.1 + 0.2}}}), "K");
  CHECK(entries_in(a) == listed{{0, 0, most}, {1, 0, -least}, {1, 1, 0.1 + 0.2}});
}

TEST_CASE("every mistake in PETSc's binary is refused with its byte, what was found and what is allowed") {
  std::string dense = with_int(good_petsc, 12, -1);
  std::string of_64_bits = std::string(4, '\0') + good_petsc;
  check_refusals(
      {
          {good_petsc.substr(0, 4), "K.petsc:", "4 bytes", "16 or more"},
          {of_64_bits, "K.petsc:", "PETSc's binary with 64-bit integers", "32-bit integers"},
          {with_int(good_petsc, 4, 0), "K.petsc: byte 4:", "0 rows", "1 to 2147483646"},
          {with_int(good_petsc, 4, -3), "K.petsc: byte 4:", "-3 rows", "1 to"},
          {with_int(good_petsc, 8, 4), "K.petsc: byte 8:", "3 rows and 4 columns", "square"},
          {dense, "K.petsc: byte 12:", "a dense matrix", "MATAIJ"},
          {with_int(good_petsc, 12, 2), "K.petsc: byte 12:", "3 rows and 2 entries", "diagonal of every row"},
          {with_int(good_petsc, 12, -7), "K.petsc: byte 12:", "3 rows and -7 entries", "diagonal"},
          {with_int(good_petsc, 12, 2147483647), "K.petsc: byte 12:", "3 rows and 2147483647 entries",
           "2147483646"},
          {with_int(good_petsc, 12, 2147483646), "K.petsc:", "112 bytes",
           "25769803780, which 3 rows and 2147483646 entries"},
          {with_int(with_int(with_int(good_petsc, 4, 2147483646), 8, 2147483646), 12, 2147483646),
           "K.petsc:", "112 bytes", "34359738352, which"},
          {good_petsc + '\0', "K.petsc:", "113 bytes", "112, which 3 rows and 7 entries take"},
          {good_petsc.substr(0, 111), "K.petsc:", "111 bytes", "112, which"},
          {with_int(good_petsc, at_lengths, 0), "K.petsc: byte 16:", "0 entries in row 1", "1 to 3"},
          {with_int(good_petsc, at_lengths, -1), "K.petsc: byte 16:", "-1 entries in row 1", "1 to 3"},
          {with_int(good_petsc, at_lengths, 4), "K.petsc: byte 16:", "4 entries in row 1", "1 to 3"},
          {with_int(with_int(good_petsc, at_lengths, 3), at_lengths + 8, 3),
           "K.petsc: byte 24:", "3 entries in row 3", "1 of 7 entries left"},
          {with_int(good_petsc, at_lengths, 1), "K.petsc: byte 12:", "7 entries, and rows that have 6",
           "as many"},
          {with_int(good_petsc, at_columns + 8, 3), "K.petsc: byte 36:", "column 4 in row 2",
           "1 to 3, in the file from 0"},
          {with_int(good_petsc, at_columns + 8, -1), "K.petsc: byte 36:", "column 0 in row 2", "1 to 3"},
          {with_int(good_petsc, at_columns + 8, 2147483647),
           "K.petsc: byte 36:", "column 2147483648 in row 2", "1 to 3"},
          {with(1, 2, 0, -0.2), "K.petsc: byte 44:",
           "the place of row 2 and column 1 again, which byte 36 has", "each place once"},
          {with(0, 1, 0, -1), "K.petsc: byte 32:", "the place of row 1 and column 1 again, which byte 28 has",
           "once"},
          {with(1, 0, 0, not_a_number), "K.petsc: byte 72:", "nan in row 2 and column 1", "finite"},
          {with(1, 0, 0, -infinite), "K.petsc: byte 72:", "-inf in row 2 and column 1", "finite"},
          {with(1, 0, 0, std::nextafter(-1.0, 0.0)), "K.petsc: byte 72:",
           "-0.9999999999999999 in row 2 and column 1, and -1 in row 1 and column 2", "equal to the bit"},
          {with(1, 0, 0, 0.0), "K.petsc: byte 72:", "0 in row 2 and column 1, and -1 in row 1", "symmetric"},
          {with(1, 0, -1, 0.0), "K.petsc: byte",
           "-1 in row 1 and column 2, and no entry in row 2 and column 1",
           "both triangles, equal to the bit: PETSc stores all entries of a matrix (MATAIJ)"},
          {with(0, 1, -1, 0.0), "K.petsc: byte",
           "-1 in row 2 and column 1, and no entry in row 1 and column 2", "both triangles"},
          {petsc_bytes({{{0, 4}}, {{0, -1}, {1, 4.5}}, {{1, -0.2}, {2, 1}}}), "K.petsc: byte",
           "-1 in row 2 and column 1, and no entry", "both triangles"},
          {petsc_bytes({{{0, 4}, {1, -1}}, {{1, 4.5}, {2, -0.2}}, {{2, 1}}}), "K.petsc: byte",
           "-1 in row 1 and column 2, and no entry", "both triangles"},
          {with(1, 1, 1, -4.5), "K.petsc: byte 80:", "-4.5 on the diagonal of row 2",
           "positive semidefinite"},
          {with(1, 1, 1, 0.0), "K.petsc: byte 72:", "-1 in row 2, which has 0 on its diagonal",
           "positive semidefinite"},
          {with(1, 1, -1, 0.0), "K.petsc:", "no entry on the diagonal of row 2",
           "on the diagonal of every row"},
      },
      of_bytes);
}

TEST_CASE("cut anywhere or longer by a byte, PETSc's binary is refused") {
  for (std::size_t length = 0; length < good_petsc.size(); ++length)
    CHECK(of_bytes(good_petsc.substr(0, length)) != "accepted");
  for (const char more : {'\0', ' ', '\n'}) CHECK(of_bytes(good_petsc + more) != "accepted");
  CHECK(of_bytes(good_petsc) == "accepted");
}

TEST_CASE("PETSc's binary with any byte changed is refused, or read as a symmetric matrix with that change") {
  random_numbers random(20261123);
  int accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::string bytes = good_petsc;
    for (int change = random.whole(1, 2); change > 0; --change)
      bytes[random.whole(0, 111)] = static_cast<char>(random.whole(0, 255));
    sparse_matrix a;
    const std::string message = verdict([&] { a = parse_petsc_matrix(bytes, "K.petsc"); });
    CHECK((message == "accepted" || message.find("; allowed: ") != std::string::npos));
    if (message != "accepted") continue;
    ++accepted;
    bool sound = a.order == 3;
    for (const matrix_entry& e : a.entries)
      sound &= 0 <= e.column && e.column <= e.row && e.row < 3 && std::isfinite(e.value) && e.value != 0.0;
    CHECK(sound);
  }
  CHECK(accepted > 100);
}

TEST_CASE("a million entries of PETSc's binary are read in their order") {
  constexpr int side = 450;
  std::vector<petsc_row> rows(std::size_t{side} * side);
  const auto couple = [&rows](int a, int b) {
    rows[a].emplace_back(b, -1.0);
    rows[b].emplace_back(a, -1.0);
  };
  for (int at = 0; at < side * side; ++at) {
    rows[at].emplace_back(at, 4.5);
    if (at % side + 1 < side) couple(at, at + 1);
    if (at + side < side * side) couple(at, at + side);
  }
  const sparse_matrix a =
      parse_petsc_matrix(petsc_bytes(rows), "K.petsc");  // quadratic work would take too long
  CHECK(a.entries.size() == 606600);
  CHECK(std::is_sorted(a.entries.begin(), a.entries.end(), [](const matrix_entry& x, const matrix_entry& y) {
    return std::pair(x.column, x.row) < std::pair(y.column, y.row);
  }));
}
