// Frames for ParaView, and the judge of their XML.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "catch.hpp"
#include "contct/write/pictures.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"
#include "support/well_formed.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// All numbers of an array of a grid.
std::vector<double> numbers(const std::string& vtu, const std::string& name) {
  const std::size_t at = vtu.find(" Name=\"" + name + "\"");
  REQUIRE(at != std::string::npos);
  const std::size_t from = vtu.find(">\n", at) + 2;
  std::istringstream text(vtu.substr(from, vtu.find('\n', from) - from));
  std::vector<double> all;
  for (double x = 0; text >> x;) all.push_back(x);
  return all;
}

/// What cells have by the points at which they are: sorted, so that grids can be compared whatever their
/// order.
std::vector<std::vector<double>> cells_in(const std::string& vtu) {
  const std::vector<double> at = numbers(vtu, "points");
  const std::vector<double> points_of_cells = numbers(vtu, "connectivity");
  const std::vector<double> ends = numbers(vtu, "offsets");
  std::vector<std::vector<double>> cells;
  for (std::size_t cell = 0; cell < ends.size(); ++cell) {
    std::vector<double> one;
    for (auto i = static_cast<std::size_t>(cell == 0 ? 0 : ends[cell - 1]);
         i < static_cast<std::size_t>(ends[cell]); ++i)
      for (int axis = 0; axis < 3; ++axis)
        one.push_back(at.at(3 * static_cast<std::size_t>(points_of_cells.at(i)) + axis));
    for (const char* name : {"types", "pair", "state", "surface", "direction", "face", "gap", "force"})
      one.push_back(numbers(vtu, name).at(cell));
    cells.push_back(one);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// The displacement at every point, once for points that are equal in all: of several pieces as of one.
std::set<std::vector<double>> points_in(const std::vector<std::string>& pieces) {
  std::set<std::vector<double>> all;
  for (const std::string& vtu : pieces) {
    const std::vector<double> at = numbers(vtu, "points");
    const std::vector<double> moved = numbers(vtu, "displacement");
    REQUIRE(at.size() == moved.size());
    for (std::size_t i = 0; i < at.size(); i += 3)
      all.insert({at[i], at[i + 1], at[i + 2], moved[i], moved[i + 1], moved[i + 2]});
  }
  return all;
}

/// A plate of 5 by 7 elements on a bed.
const std::string plate_on_bed =
    "[plate]\nsize = [5, 7]\nelements = [5, 7]\nD = 1\nnu = 0.3\n[[bed]]\nmodulus = 1\nface = 0\n"
    "[[step]]\nuniform = -1\npoint = [ { node = 15, w = -3 } ]\n";

}  // namespace

TEST_CASE("grids are well-formed, with as many points and cells as the structure and its pairs have") {
  for (const std::string& text : {loaded_and_freed, std::string(good_plate)}) {
    const a_run r(text);
    const std::string vtu = vtu_of_frame(r.what, r.kept.frames().back());
    CHECK(why_not_well_formed(vtu).empty());
    const auto cells = static_cast<std::size_t>(elements(r.what.geometry)) + r.what.pairs.size();
    CHECK_THAT(vtu, Contains("NumberOfPoints=\"" + std::to_string(nodes(r.what.geometry)) +
                             "\" NumberOfCells=\"" + std::to_string(cells) + "\""));
    for (const frame& f : r.kept.frames()) CHECK(why_not_well_formed(vtu_of_frame(r.what, f)).empty());
  }
}

TEST_CASE("a collection names its files in their order, relative to itself") {
  const std::string pvd = pvd_of_frames("a&b", 11);
  CHECK(why_not_well_formed(pvd).empty());
  CHECK_THAT(pvd, Contains("timestep=\"0\" part=\"0\" file=\"a&amp;b.000.vtu\""));
  CHECK_THAT(pvd, Contains("timestep=\"10\" part=\"0\" file=\"a&amp;b.010.vtu\""));
}

TEST_CASE("grids of structures from elsewhere: points where nodes are, edges, and pairs that have a node") {
  const a_run r(structure_problem("", "frame", {{"dof       = \"8.x\"", "dof = \"8.r\""}}));
  const std::string vtu = vtu_of_frame(r.what, r.kept.frames().back());
  CHECK(why_not_well_formed(vtu).empty());
  CHECK_THAT(vtu, Contains("NumberOfPoints=\"11\" NumberOfCells=\"12\""));
  CHECK_THAT(vtu, Contains("Name=\"rotation\" NumberOfComponents=\"3\""));
  CHECK_THAT(
      vtu,
      Contains("Name=\"direction\" NumberOfComponents=\"1\" format=\"ascii\">\n0 0 0 0 0 0 0 0 0 0 2 6\n"));
  const a_run solid(structure_problem("calculix/", "console", {{"dof       = \"49.3\"", "dof = \"55.1\""}}));
  const std::string bricks = vtu_of_frame(solid.what, solid.kept.frames().back());
  CHECK_THAT(bricks, Contains("NumberOfPoints=\"54\" NumberOfCells=\"114\"") && !Contains("rotation"));
}

TEST_CASE("points have the reactions of supports and a bed's pressure") {
  a_run r(good_problem);
  r.what.beds = {{4.0, {0.5}, 0}};
  const frame& f = r.kept.frames().back();
  const std::string vtu = vtu_of_frame(r.what, f);
  CHECK(why_not_well_formed(vtu).empty());
  const std::vector<double> at = reactions(r.what.geometry, r.what.steps[0], r.what.supports, f.displacement);
  CHECK_THAT(vtu, Contains(fmt::format(
                      "Name=\"reaction\" NumberOfComponents=\"2\" format=\"ascii\">\n{} {} 0 0 0 0\n", at[0],
                      at[1])));
  CHECK_THAT(vtu,
             Contains(fmt::format("Name=\"pressure\" NumberOfComponents=\"1\" format=\"ascii\">\n0 0 {}\n",
                                  reading_of(r.what, f, 0).force / 0.5)));
}

TEST_CASE(
    "a grid in pieces has every cell once and every point with its displacement, whatever their number") {
  for (const std::string& text : {plate_on_bed, loaded_and_freed, structure_problem("", "frame"),
                                  structure_problem("calculix/", "console")}) {
    const a_run r(text);
    const frame& f = r.kept.frames().back();
    const std::string whole = vtu_of_frame(r.what, f);
    const auto cells = cells_in(whole);
    for (const std::size_t count : {1, 2, 3, 9}) {
      INFO(count);
      const grid_pieces all = pieces_of_frame(r.what, f, count);
      std::vector<std::string> pieces;
      std::vector<std::vector<double>> found;
      for (std::size_t i = 0; i < count; ++i) {
        pieces.push_back(all.piece(i));
        CHECK(why_not_well_formed(pieces.back()).empty());
        const auto own = cells_in(pieces.back());
        found.insert(found.end(), own.begin(), own.end());
      }
      std::sort(found.begin(), found.end());
      CHECK(found == cells);
      CHECK(points_in(pieces) == points_in({whole}));
      if (count == 1) CHECK(pieces.front() == whole);
    }
  }
}

TEST_CASE("a plate is cut between rows of elements, evenly, and points between two pieces are in both") {
  const a_run r(plate_on_bed);
  const frame& f = r.kept.frames().back();
  const grid_pieces all = pieces_of_frame(r.what, f, 3);
  // 7 rows of 5 elements and 8 of 6 nodes, at each of which is a pair.
  CHECK_THAT(all.piece(0),
             Contains("NumberOfPoints=\"24\" NumberOfCells=\"" + std::to_string(15 + 24) + "\""));
  CHECK_THAT(all.piece(1),
             Contains("NumberOfPoints=\"18\" NumberOfCells=\"" + std::to_string(10 + 12) + "\""));
  CHECK_THAT(all.piece(2),
             Contains("NumberOfPoints=\"18\" NumberOfCells=\"" + std::to_string(10 + 12) + "\""));
  const grid_pieces many = pieces_of_frame(r.what, f, 9);
  CHECK_THAT(many.piece(8), Contains("NumberOfPoints=\"6\"") || Contains("NumberOfPoints=\"12\"") ||
                                Contains("NumberOfPoints=\"0\" NumberOfCells=\"0\""));
}

TEST_CASE("the file of the pieces declares their arrays and names them in order") {
  const a_run r(plate_on_bed);
  const grid_pieces all = pieces_of_frame(r.what, r.kept.frames().back(), 2);
  const std::string list = all.index("a&b");
  CHECK(why_not_well_formed(list).empty());
  CHECK_THAT(list, Contains("<VTKFile type=\"PUnstructuredGrid\"") &&
                       Contains("<Piece Source=\"a&amp;b_0.vtu\"/>\n    <Piece Source=\"a&amp;b_1.vtu\"/>") &&
                       Contains("<PPointData Vectors=\"displacement\" Scalars=\"w\">"));
  const std::string piece = all.piece(1);
  std::size_t declared = 0;
  for (std::size_t at = list.find("<PDataArray "); at != std::string::npos;
       at = list.find("<PDataArray ", at + 1)) {
    const std::size_t from = at + std::string("<PDataArray ").size();
    CHECK_THAT(piece, Contains("<DataArray " + list.substr(from, list.find("/>", from) - from) + " format"));
    ++declared;
  }
  CHECK(declared == 6 + 10 + 1);  // of points, of cells, and the points
  CHECK(name_of_piece("out", 12) == "out_12.vtu");
}

TEST_CASE("the judge of well-formed XML finds what is wrong") {
  CHECK(why_not_well_formed("<?xml version=\"1.0\"?>\n<a b=\"c\"><d/>e &amp; f</a>\n").empty());
  CHECK_THAT(why_not_well_formed("<a><b></a></b>"), Contains("</a>"));
  CHECK_THAT(why_not_well_formed("<a><b/>"), Contains("never closed"));
  CHECK_THAT(why_not_well_formed("<a b=c/>"), Contains("quote"));
  CHECK_THAT(why_not_well_formed("<a b=\"1\" b=\"2\"/>"), Contains("twice"));
  CHECK_THAT(why_not_well_formed("<a>x & y</a>"), Contains("&"));
  CHECK_THAT(why_not_well_formed("<a>x < y</a>"), Contains("<"));
  CHECK_THAT(why_not_well_formed("<a/><b/>"), Contains("second"));
  CHECK_THAT(why_not_well_formed(""), Contains("no element"));
}
