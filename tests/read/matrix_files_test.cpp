// Tests the readers of Matrix Market files and CalculiX's matrix: accepted files, and refusals with their
// positions.
#include "contct/read/matrix_files.hpp"

#include <fmt/format.h>

#include <sstream>

#include "catch.hpp"
#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/text/input_text.hpp"
#include "read/refusals.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;

namespace {

const std::string header = "%%MatrixMarket matrix coordinate real symmetric\n";
const std::string good_matrix = header + "3 3 5\n1 1 4\n2 1 -1\n2 2 4.5\n3 2 -2e-1\n3 3 1\n";
const std::string good_vector = "%%MatrixMarket matrix array real general\n3 1\n1\n0\n-2.5\n";
const std::string sparse_vector = "%%MatrixMarket matrix coordinate real general\n3 1 2\n3 1 -2.5\n1 1 1\n";
const std::string good_job = "1 1  4.0000000000000e+00\n1 2  0.0000000000000e+00\n2 2  1.5e+00\n";

std::string replaced(std::string text, const std::string& piece, const std::string& mistake) {
  return text.replace(text.find(piece), piece.size(), mistake);
}

std::string of_matrix(const std::string& text) {
  return verdict([&] { (void)parse_symmetric(text, "K.mtx"); });
}
std::string of_vector(const std::string& text) {
  return verdict([&] { (void)parse_vector(text, "f.mtx", 3); });
}
std::string of_job(const std::string& text) {
  return verdict([&] { (void)parse_calculix_stiffness(text, "job.sti", 2); });
}

std::vector<std::vector<double>> full(const sparse_matrix& a) {
  std::vector<std::vector<double>> m(a.order, std::vector<double>(a.order));
  for (const matrix_entry& e : a.entries) {
    m[e.row][e.column] = e.value;
    m[e.column][e.row] = e.value;
  }
  return m;
}

/// Returns the matrix file of a square grid of springs with a grounded corner.
std::string grid_text(int side) {
  std::string text;
  int entries = 0;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const int at = j * side + i + 1;
      text += fmt::format("{} {} 4.5\n", at, at);
      ++entries;
      for (const int next : {i + 1 < side ? at + 1 : 0, j + 1 < side ? at + side : 0}) {
        if (next == 0) continue;
        text += fmt::format("{} {} -1.0000000000000001e+00\n", next, at);
        ++entries;
      }
    }
  }
  return header + fmt::format("{} {} {}\n", side * side, side * side, entries) + text;
}

}  // namespace

TEST_CASE(
    "a Matrix Market file may have comments, blank lines, tabs, any letter case and any order of entries") {
  const std::vector<std::vector<double>> expected = {{4, -1, 0}, {-1, 4.5, -0.2}, {0, -0.2, 1}};
  CHECK(full(parse_symmetric(good_matrix, "K.mtx")) == expected);
  CHECK(full(parse_symmetric(
            "%%matrixmarket MATRIX Coordinate REAL Symmetric\r\n% made by hand\r\n\r\n%\r\n"
            "  3\t3   5\r\n\r\n3 3 +1.0\r\n3 2 -.2\r\n\r\n\t1 1 4e0\r\n2 2 45E-1\r\n2 1 -1\r\n",
            "K.mtx")) == expected);
}

TEST_CASE("a load vector is read in the Matrix Market formats array and coordinate") {
  CHECK(parse_vector(good_vector, "f.mtx", 3) == std::vector<double>{1, 0, -2.5});
  CHECK(parse_vector(sparse_vector, "f.mtx", 3) == std::vector<double>{1, 0, -2.5});
  CHECK(parse_vector("%%MatrixMarket matrix coordinate real general\n3 1 0\n", "f.mtx", 3) ==
        std::vector<double>{0, 0, 0});
}

TEST_CASE("the upper triangle of CalculiX's matrix is read, and entries of 0 are omitted") {
  CHECK(full(parse_calculix_stiffness(good_job, "job.sti", 2)) ==
        std::vector<std::vector<double>>{{4, 0}, {0, 1.5}});
  CHECK(parse_calculix_stiffness(good_job, "job.sti", 2).entries.size() == 2);
}

TEST_CASE("a mistake in a Matrix Market matrix is refused with line, what was found and what is allowed") {
  check_refusals(
      {
          {"", "K.mtx", "no header", "%%MatrixMarket matrix coordinate real symmetric"},
          {"\n" + good_matrix, "K.mtx:2", "no header", "symmetric"},
          {"3 3 1\n1 1 1\n", "K.mtx:1", "\"3 3 1\"", "%%MatrixMarket matrix"},
          {replaced(good_matrix, "symmetric", "general"), "K.mtx:1",
           "\"%%MatrixMarket matrix coordinate real gener",
           "real symmetric. Python writes it by scipy.io.mmwrite(FILE, scipy.sparse.coo_matrix(A)"},
          {replaced(good_matrix, "%%MatrixMarket", "%MatrixMarkt"), "K.mtx:1",
           "\"%MatrixMarkt matrix coordinate real symmetric\"",
           "%%MatrixMarket matrix coordinate real symmetric"},
          {replaced(good_matrix, "%%MatrixMarket", "MATRIXMARKET"), "K.mtx:1", "\"MATRIXMARKET matrix",
           "%%Mat"},
          {replaced(good_matrix, header, "root:$6$secret:19000:0:99999:7:::\n"), "K.mtx:1",
           "a line of 33 bytes", "%%MatrixMarket"},
          {replaced(good_matrix, "real", "complex"), "K.mtx:1", "\"", "real symmetric"},
          {replaced(good_matrix, "coordinate", "array"), "K.mtx:1", "\"", "coordinate"},
          {header, "K.mtx:1", "the end of the file", "rows, columns"},
          {replaced(good_matrix, "3 3 5", "3 3"), "K.mtx:2", "\"3 3\"", "rows, columns and the number"},
          {replaced(good_matrix, "3 3 5", "3 4 5"), "K.mtx:2", "3 rows and 4 columns", "square"},
          {replaced(good_matrix, "3 3 5", "0 0 5"), "K.mtx:2", "\"0\" for the rows", "from 1 to"},
          {replaced(good_matrix, "3 3 5", "99999999999 99999999999 5"), "K.mtx:2", "\"99999999999\"",
           "to 2147483646"},
          {replaced(good_matrix, "3 3 5", "2147483646 2147483646 5"), "K.mtx",
           "2147483646 rows and 5 entries", "on the diagonal of every row"},
          {replaced(good_matrix, "3 3 5", "3 3 2147483646"), "K.mtx:7",
           "the end of the file after 5 of 2147483646", "line 2"},
          {replaced(good_matrix, "3 3 5", "3 3 4"), "K.mtx:7", "more than 4 entries", "4, as line 2"},
          {replaced(good_matrix, "3 3 5\n", "3 3 5\n% forces in N\n"), "K.mtx:3", "a comment",
           "comments between the header and the size"},
          {good_matrix.substr(0, good_matrix.size() - 1), "K.mtx:7", "\"3 3 1\" without a line end",
           "a line end"},
          {replaced(good_matrix, "2 1 -1", "1 2 -1"), "K.mtx:4", "row 1 and column 2, above",
           "lower triangle"},
          {replaced(good_matrix, "2 1 -1", "4 1 -1"), "K.mtx:4", "\"4\" for the row", "from 1 to 3"},
          {replaced(good_matrix, "2 1 -1", "2 x -1"), "K.mtx:4", "\"x\" for the column", "from 1 to 3"},
          {replaced(good_matrix, "2 1 -1", "2 1 nan"), "K.mtx:4", "\"nan\" for an entry", "finite"},
          {replaced(good_matrix, "2 1 -1", "2 1 1.0D+00"), "K.mtx:4", "\"1.0D+00\"", "such as 1.5 or -2e-3"},
          {replaced(good_matrix, "2 1 -1", "2 1"), "K.mtx:4", "\"2 1\"", "row, column and value"},
          {replaced(good_matrix, "2 1 -1", "2 1 -1\x1b[31m" + std::string(5000, 'x')), "K.mtx:4",
           "a word of 5007 bytes for an entry", "finite"},
          {replaced(good_matrix, "3 2 -2e-1", "2 1 7"), "K.mtx:6",
           "row 2 and column 1 a second time, after line 4", "each row and column once"},
          {replaced(good_matrix, "2 2 4.5", "2 2 -4.5"), "K.mtx:5", "-4.5 on the diagonal of row 2",
           "positive semidefinite"},
          {replaced(good_matrix, "2 2 4.5", "2 2 0"), "K.mtx:4", "-1 in row 2, whose diagonal entry is 0",
           "positive semidefinite"},
          {header + "2 2 1\n1 1 1\n", "K.mtx", "2 rows and 1 entries", "on the diagonal"},
      },
      of_matrix);
}

TEST_CASE("entries of a matrix file are sorted by column and row, whatever their order in the file") {
  const sparse_matrix a = parse_symmetric(header + "3 3 5\n3 3 9\n3 1 7\n1 1 5\n2 2 8\n2 1 6\n", "K.mtx");
  std::vector<double> values;
  for (const matrix_entry& e : a.entries) values.push_back(e.value);
  CHECK(values == std::vector<double>{5, 6, 7, 8, 9});
}

TEST_CASE("a mistake in a load vector is refused with line, what was found and what is allowed") {
  check_refusals(
      {
          {"", "f.mtx", "no header", "array (or coordinate) real general"},
          {replaced(good_vector, "general", "symmetric"), "f.mtx:1", "\"", "real general"},
          {replaced(good_vector, "3 1", "4 1"), "f.mtx:2", "4 rows", "3, as in the matrix"},
          {replaced(good_vector, "3 1", "3 2"), "f.mtx:2", "\"2\" for the columns", "from 1 to 1"},
          {replaced(good_vector, "-2.5\n", ""), "f.mtx:4", "the end of the file after 2 of 3", "line 2"},
          {good_vector + "7\n", "f.mtx:6", "more than 3 numbers", "3, as line 2"},
          {replaced(good_vector, "-2.5", "1 2"), "f.mtx:5", "\"1 2\"", "one number a line"},
          {replaced(sparse_vector, "3 1 2", "3 1 4"), "f.mtx:2", "\"4\" for the number of entries",
           "from 0 to 3"},
          {replaced(sparse_vector, "1 1 1", "3 1 1"), "f.mtx:4", "row 3 a second time, after line 3",
           "each row once"},
          {replaced(sparse_vector, "1 1 1", "1 2 1"), "f.mtx:4", "\"2\" for the column", "from 1 to 1"},
          {sparse_vector + "2 1 1\n", "f.mtx:5", "more than 2 entries", "2, as line 2"},
      },
      of_vector);
}

TEST_CASE("a mistake in CalculiX's matrix is refused with line, what was found and what is allowed") {
  check_refusals(
      {
          {"", "job.sti", "2 rows and 0 entries", "on the diagonal"},
          {replaced(good_job, "1 2", "2 1"), "job.sti:2", "row 2 and column 1, below", "upper triangle"},
          {replaced(good_job, "1 2", "1 3"), "job.sti:2", "\"3\" for the column", "from 1 to 2"},
          {replaced(good_job, "1.5e+00", "-1.5"), "job.sti:3", "-1.5 on the diagonal", "semidefinite"},
          {good_job + "1 2 3\n", "job.sti:4", "row 2 and column 1 a second time, after line 2", "once"},
      },
      of_job);
}

TEST_CASE("a Matrix Market file that is cut at any byte is refused") {
  for (const std::string& text : {good_matrix, good_vector, sparse_vector}) {
    for (std::size_t length = 0; length < text.size(); ++length) {
      const std::string cut = text.substr(0, length);
      INFO(cut);
      CHECK((text == good_matrix ? of_matrix(cut) : of_vector(cut)) != "accepted");
    }
  }
}

TEST_CASE("a matrix of a grid with a million entries is read, and its band is as narrow as the grid allows") {
  const std::string text = grid_text(600);
  const sparse_matrix a = parse_symmetric(text, "K.mtx");  // quadratic work would exceed the time limit
  const std::vector<int> rows = rows_for_small_band(a);
  CHECK(a.entries.size() == 1078800);
  CHECK(subdiagonals_of(a, rows) <= 600);
}

namespace {

std::string of_labels(const std::string& text) {
  return verdict([&] { (void)parse_labels(text, "K.dof"); });
}

}  // namespace

TEST_CASE("a file of dof labels has one label a line, and blank lines and surrounding blanks are ignored") {
  CHECK(parse_labels("5.1\n5.2 \r\n\n185.3\n", "job.dof") == std::vector<std::string>{"5.1", "5.2", "185.3"});
}

TEST_CASE("a byte order mark at the start of a file is skipped, unless the file is a trace") {
  const scratch_folder folder;
  folder.write("K.dof",
               "\xEF\xBB\xBF"
               "5.1\n");
  folder.write("K.mtx", "\xEF\xBB\xBF" + good_matrix);
  CHECK(parse_labels(read_input(folder.at("K.dof")), "K.dof") == std::vector<std::string>{"5.1"});
  CHECK(parse_symmetric(read_input(folder.at("K.mtx")), "K.mtx").order == 3);
  CHECK(read_input(folder.at("K.dof"), "trace").size() == 7);
}

TEST_CASE("a mistake in a file of dof labels is refused with line, what was found and what is allowed") {
  check_refusals(
      {
          {"", "K.dof", "no label", "one label a line"},
          {"\n \n", "K.dof", "no label", "one label a line"},
          {"5.1\n5.2\n5.1\n", "K.dof:3", "the label of line 1 a second time", "each label once"},
          {"tip\nend\nend\n", "K.dof:3", "the label of line 2 a second time", "each label once"},
          {"5.1\n5 2\n", "K.dof:2", "\"5 2\"", "one label a line"},
          {std::string(101, 'n') + "\n", "K.dof:1", "a word of 101 bytes", "at most 100 bytes"},
      },
      of_labels);
}

TEST_CASE(
    "a matrix or vector file gives one warning for all numbers that are longer than the shortest decimal") {
  std::vector<std::string> warnings;
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  const sparse_matrix m =
      parse_symmetric(head + "2 2 3\n2 2 2.10e0\n2 1 -0.10000000000000000555\n1 1 7.000000000000000000001\n",
                      "K.mtx", &warnings);
  REQUIRE(m.entries.size() == 3);
  CHECK(m.entries[1].value == -0.1);
  (void)parse_calculix_stiffness("1 1 1.0D0\n1 2 0.0\n2 2 3.00000000000000000001D-1\n", "j.sti", 2,
                                 &warnings);
  (void)parse_vector("%%MatrixMarket matrix array real general\n2 1\n0.5\n0.30000000000000000001\n", "f.mtx",
                     2, &warnings);
  (void)parse_vector(
      "%%MatrixMarket matrix coordinate real general\n3 1 2\n3 1 1\n1 1 0.30000000000000000001\n", "g.mtx", 3,
      &warnings);
  const std::string used = "; the shortest decimal of its double, ";
  CHECK(warnings == std::vector<std::string>{
                        "K.mtx:4: found -0.10000000000000000555" + used +
                            "-0.1, is used everywhere (the first of 2 such numbers)",
                        "j.sti:3: found 3.00000000000000000001D-1" + used + "0.3, is used everywhere",
                        "f.mtx:4: found 0.30000000000000000001" + used + "0.3, is used everywhere",
                        "g.mtx:4: found 0.30000000000000000001" + used + "0.3, is used everywhere"});
  warnings.clear();
  (void)parse_symmetric(head + "1 1 1\n1 1 " + "0." + std::string(1500, '3') + "\n", "K.mtx", &warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].size() < 200);
  (void)parse_symmetric(head + "1 1 1\n1 1 2.500000000000000000000e+01\n", "K.mtx", &warnings);
  CHECK(warnings.size() == 1);
}
