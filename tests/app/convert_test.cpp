// contct convert: a stiffness matrix from one format to the other and back.
#include <algorithm>
#include <filesystem>

#include "app/process.hpp"
#include "catch.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/petsc_matrix.hpp"
#include "read/small_matrix.hpp"
#include "support/petsc_bytes.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::string contents(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The same places and the same bits.
bool equal(const sparse_matrix& a, const sparse_matrix& b) {
  return a.order == b.order && std::equal(a.entries.begin(), a.entries.end(), b.entries.begin(),
                                          b.entries.end(), [](const matrix_entry& x, const matrix_entry& y) {
                                            return x.row == y.row && x.column == y.column &&
                                                   x.value == y.value;
                                          });
}

/// The stiffness matrices of reference/, as Matrix Market files.
std::vector<std::string> reference_matrices(const scratch_folder& dir) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / "reference")) {
    const std::string text = entry.path().extension() == ".mtx" ? contents(entry.path()) : "";
    if (text.starts_with("%%MatrixMarket matrix coordinate real symmetric"))
      files.push_back(entry.path().string());
    if (entry.path().extension() != ".sti") continue;
    // The upper triangle, as CalculiX writes it.
    fs::path labels = entry.path();
    const std::string names = contents(labels.replace_extension(".dof"));
    const auto rows = std::to_string(std::count(names.begin(), names.end(), '\n'));
    std::istringstream lines(contents(entry.path()));
    std::string row, column, value, out;
    int count = 0;
    for (; lines >> row >> column >> value; ++count) out += column + " " + row + " " + value + "\n";
    files.push_back(dir.write("of-calculix.mtx", "%%MatrixMarket matrix coordinate real symmetric\n" + rows +
                                                     " " + rows + " " + std::to_string(count) + "\n" + out));
  }
  return files;
}

}  // namespace

TEST_CASE("every matrix of reference/ comes back from PETSc's binary to the bit, and again") {
  const scratch_folder dir;
  const std::vector<std::string> files = reference_matrices(dir);
  REQUIRE(files.size() >= 2);
  for (const std::string& file : files) {
    INFO(file);
    const sparse_matrix read = parse_symmetric(contents(file), file);
    REQUIRE(read.entries.size() > 50);
    CHECK(contct_program(dir.path(), {"convert", file, "K.petsc"}).exit == 0);
    CHECK(equal(parse_petsc_matrix(dir.read("K.petsc"), "K.petsc"), read));
    CHECK(contct_program(dir.path(), {"convert", "K.petsc", "K.mtx"}).exit == 0);
    CHECK(equal(parse_symmetric(dir.read("K.mtx"), "K.mtx"), read));
    CHECK(contct_program(dir.path(), {"convert", "K.mtx", "again.petsc"}).exit == 0);
    CHECK(dir.read("again.petsc") == dir.read("K.petsc"));
  }
}

TEST_CASE("convert tells the direction by the first bytes and says what it has written") {
  const scratch_folder dir;
  dir.write("K.bin", small_matrix);
  const finished there = contct_program(dir.path(), {"convert", "K.bin", "K.txt"});
  CHECK(there.exit == 0);
  CHECK(there.out == "K.txt: PETSc's binary, 3 rows, 7 entries of both triangles\n");
  CHECK(dir.read("K.txt") == petsc_bytes({{{0, 2}, {1, -1}}, {{0, -1}, {1, 2}, {2, -1}}, {{1, -1}, {2, 1}}}));
  const finished back = contct_program(dir.path(), {"convert", "K.txt", "K.mtx"});
  CHECK(back.out == "K.mtx: Matrix Market, 3 rows, 5 entries of the lower triangle\n");
  CHECK(dir.read("K.mtx") == small_matrix);
  CHECK(contct_program(dir.path(), {"convert", "K.txt", "K.mtx", "--quiet"}).out.empty());
}

TEST_CASE("convert reads standard input and writes to standard output") {
  const scratch_folder dir;
  process_options piped;
  piped.input = small_matrix;
  const finished there = contct_program(dir.path(), {"convert", "-", "-"}, piped);
  CHECK(there.exit == 0);
  piped.input = there.out;
  CHECK(contct_program(dir.path(), {"convert", "-", "-"}, piped).out == small_matrix);
  CHECK(dir.files().empty());
}

TEST_CASE("numbers come back as the shortest decimals, and a diagonal of 0 stays") {
  const scratch_folder dir;
  dir.write("K.petsc", petsc_bytes({{{0, 0.1 + 0.2}, {2, -1e-300}}, {{1, 0}}, {{0, -1e-300}, {2, 5e22}}}));
  CHECK(contct_program(dir.path(), {"convert", "K.petsc", "K.mtx"}).exit == 0);
  CHECK(dir.read("K.mtx") ==
        "%%MatrixMarket matrix coordinate real symmetric\n3 3 4\n1 1 0.30000000000000004\n3 1 -1e-300\n2 2 "
        "0\n3 3 "
        "5e+22\n");
  CHECK(contct_program(dir.path(), {"convert", "K.mtx", "again"}).exit == 0);
  CHECK(dir.read("again") == dir.read("K.petsc"));
}

TEST_CASE("what convert cannot read ends with 2, one message that names the place, and no file") {
  const scratch_folder dir;
  dir.write("K.mtx", small_matrix);
  dir.write("bad.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 2\n2 2 nan\n");
  dir.write("lower.petsc", petsc_bytes({{{0, 2}}, {{0, -1}, {1, 2}}}));
  dir.write("cut.petsc", petsc_bytes({{{0, 2}}, {{1, 2}}}).substr(0, 47));
  dir.write("empty", "");
  dir.write("kept.petsc", "what was there");
  const std::vector<std::string> before = dir.files();
  const auto refused = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> line = {"convert"};
    line.insert(line.end(), arguments.begin(), arguments.end());
    const finished f = contct_program(dir.path(), line);
    INFO(f.out << f.err);
    CHECK(f.exit == 2);
    CHECK(f.out.empty());
    CHECK(dir.files() == before);
    return f.err;
  };
  CHECK_THAT(refused({"bad.mtx", "out"}),
             Contains("bad.mtx:4: found \"nan\" for an entry; allowed: a finite"));
  CHECK_THAT(refused({"bad.mtx", "kept.petsc"}), Contains("bad.mtx:4"));
  CHECK(dir.read("kept.petsc") == "what was there");
  CHECK_THAT(
      refused({"lower.petsc", "out"}),
      Contains("lower.petsc: byte 44: found -1 in row 2 and column 1, and no entry in row 1 and column 2; "
               "allowed: both triangles"));
  CHECK_THAT(refused({"cut.petsc", "out"}), Contains("cut.petsc: found 47 bytes; allowed: 48, which 2 rows"));
  CHECK_THAT(refused({"empty", "out"}), Contains("empty: found no header; allowed: %%MatrixMarket matrix"));
  CHECK_THAT(refused({"none.mtx", "out"}), Contains("none.mtx: cannot be read"));
  CHECK_THAT(refused({".", "out"}), Contains("found a directory; allowed: a stiffness matrix"));
  CHECK_THAT(refused({"K.mtx", "no-such-folder/out"}), Contains("no-such-folder/out: cannot be written"));
  CHECK_THAT(refused({"K.mtx", "K.mtx"}), Contains("found the file of INPUT; allowed: a file of its own"));
  CHECK_THAT(refused({"K.mtx", ""}), Contains("OUTPUT: found no name; allowed: a file"));
  CHECK_THAT(refused({"K.mtx"}), Contains("OUTPUT is required"));
  CHECK_THAT(refused({}), Contains("INPUT is required"));
  CHECK_THAT(refused({"K.mtx", "out", "more"}), Contains("more"));
  CHECK_THAT(refused({"K.mtx", "out", "--quite"}), Contains("(did you mean \"--quiet\"?)"));
}

TEST_CASE(
    "a problem with PETSc's binary has the result of the one with the Matrix Market file, and the exact "
    "one") {
  const scratch_folder dir;
  for (const char* name : {"frame.toml", "frame.mtx", "frame.dof", "frame.xyz", "wind.mtx"})
    dir.write(name, contents(root / "reference/structures" / name));
  CHECK(contct_program(dir.path(), {"convert", "frame.mtx", "frame.petsc"}).exit == 0);
  CHECK(contct_program(dir.path(), {"convert", "frame.petsc", "frame.mtx"}).exit == 0);  // shortest decimals
  std::string text = dir.read("frame.toml");
  const std::string name = "\"frame.mtx\"";
  text.replace(text.find(name), name.size(), "\"frame.petsc\"");
  dir.write("of-petsc.toml", text);
  for (const char* command : {"run", "exact"}) {
    for (const char* file : {"frame", "of-petsc"}) {
      const finished f = contct_program(dir.path(), {command, std::string(file) + ".toml", "--quiet",
                                                     "--json", std::string(file) + ".json"});
      INFO(f.err);
      CHECK(f.exit == 0);
    }
    CHECK(dir.read("of-petsc.json").size() > 1000);
    CHECK(dir.read("of-petsc.json") == dir.read("frame.json"));
  }
}
