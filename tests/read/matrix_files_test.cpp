// Tests the readers of Matrix Market files, CalculiX's matrix and labels, and the places of a matrix's dofs.
// refused.txt lists their refusals.
#include "contct/read/matrix_files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catch.hpp"
#include "contct/linear/stiffness_matrix.hpp"
#include "read/small_matrix.hpp"
#include "support/rows.hpp"

using namespace contct;

namespace {

std::vector<std::vector<double>> full(const sparse_matrix& a) {
  std::vector<std::vector<double>> m(a.order, std::vector<double>(a.order));
  for (const matrix_entry& e : a.entries) m[e.row][e.column] = m[e.column][e.row] = e.value;
  return m;
}

const std::string header = "%%MatrixMarket matrix coordinate real symmetric\n";

using texts = std::vector<std::string>;

/// Returns a matrix with these labels and only these couplings.
assembled with_labels(texts labels, std::vector<matrix_entry> entries = {}) {
  assembled a;
  a.stiffness = {static_cast<int>(labels.size()), std::move(entries)};
  a.labels = std::move(labels);
  return a;
}

placed_nodes by_mesh(const std::string& text, texts labels = {"1.x"}) {
  return places_by_mesh(text, "job.inp", with_labels(std::move(labels)));
}

texts nodes_of(const std::vector<placed_node>& nodes) {
  texts all;
  for (const placed_node& n : nodes) all.push_back(fmt::format("{} {}", n.name, fmt::join(n.at, " ")));
  return all;
}

/// Returns the edges by the names of their nodes, each followed by the number of its elements if this is
/// not 1.
std::string edges_of(const placed_nodes& m) {
  texts all;
  for (const mesh_edge& e : m.edges)
    all.push_back(fmt::format("{}-{}{}", m.nodes[e.from].name, m.nodes[e.to].name,
                              e.elements == 1 ? "" : fmt::format("*{}", e.elements)));
  return fmt::format("{}", fmt::join(all, " "));
}

/// Returns the node and the direction of each dof.
texts dofs_of(const placed_nodes& m) {
  texts all;
  for (const placed_dof& d : m.dofs)
    all.push_back(d.node < 0 ? "none" : fmt::format("{}.{}", m.nodes[d.node].name, d.direction));
  return all;
}

/// Returns the text of `count` nodes.
std::string nodes_text(int count) {
  std::string text = "*NODE\n";
  for (int i = 1; i <= count; ++i) text += fmt::format("{},{},0,0\n", i, i);
  return text;
}

/// Returns an element of this type with the nodes 1, 2, ..
std::string element_text(const std::string& type, int nodes) {
  std::string text = "*ELEMENT, TYPE=" + type + "\n7";
  for (int i = 1; i <= nodes; ++i) text += fmt::format("{}{}", i == 15 ? ",\n" : ",", i);
  return text + "\n";
}

}  // namespace

TEST_CASE(
    "a Matrix Market file may have comments, blank lines, tabs, any letter case and any order of entries") {
  const std::vector<std::vector<double>> expected = {{2, -1, 0}, {-1, 2, -1}, {0, -1, 1}};
  CHECK(full(parse_symmetric(small_matrix, "K.mtx")) == expected);
  CHECK(full(parse_symmetric(
            "%%matrixmarket MATRIX Coordinate REAL Symmetric\r\n% made by hand\r\n\r\n%\r\n"
            "  3\t3   5\r\n\r\n3 3 +1.0\r\n3 2 -1.\r\n\r\n\t1 1 2e0\r\n2 2 20E-1\r\n2 1 -1\r\n",
            "K.mtx")) == expected);
  std::vector<double> sorted;  // by column and row
  for (const auto& e :
       parse_symmetric(header + "3 3 5\n3 3 9\n3 1 7\n1 1 5\n2 2 8\n2 1 6\n", "K.mtx").entries)
    sorted.push_back(e.value);
  CHECK(sorted == std::vector<double>{5, 6, 7, 8, 9});
}

TEST_CASE("load vectors in both formats, CalculiX's matrix and labels of dofs are read") {
  CHECK(parse_vector(small_vector, "f.mtx", 3) == std::vector<double>{1, 0, -2.5});
  CHECK(parse_vector(small_sparse_vector, "f.mtx", 3) == std::vector<double>{1, 0, -2.5});
  CHECK(parse_vector("%%MatrixMarket matrix coordinate real general\n3 1 0\n", "f.mtx", 3) ==
        std::vector<double>{0, 0, 0});
  const sparse_matrix job = parse_calculix_stiffness(small_job, "job.sti", 2);
  CHECK(full(job) == std::vector<std::vector<double>>{{4, 0}, {0, 1.5}});
  CHECK(job.entries.size() == 2);
  CHECK(parse_labels("5.1\n5.2 \r\n\n185.3\n", "job.dof") == std::vector<std::string>{"5.1", "5.2", "185.3"});
}

TEST_CASE("a Matrix Market file that is cut at any byte is refused") {
  for (const std::string text : {small_matrix, small_vector, small_sparse_vector}) {
    for (std::size_t length = 0; length < text.size(); ++length) {
      const std::string cut = text.substr(0, length);
      INFO(cut);
      CHECK(verdict([&] {
              text == small_matrix ? (void)parse_symmetric(cut, "K.mtx")
                                   : (void)parse_vector(cut, "f.mtx", 3);
            }) != "accepted");
    }
  }
}

TEST_CASE("a matrix of a grid with a million entries is read, and its band is as narrow as the grid allows") {
  constexpr int side = 600;  // springs along the lines of a square grid
  std::string entries;
  for (int at = 1; at <= side * side; ++at) {
    entries += fmt::format("{} {} 4.5\n", at, at);
    if (at % side != 0) entries += fmt::format("{} {} -1.0000000000000001e+00\n", at + 1, at);
    if (at + side <= side * side) entries += fmt::format("{} {} -1.0000000000000001e+00\n", at + side, at);
  }
  const sparse_matrix a =
      parse_symmetric(header + fmt::format("{0} {0} 1078800\n", side * side) + entries, "K.mtx");
  CHECK(a.entries.size() == 1078800);
  CHECK(subdiagonals_of(a, rows_for_small_band(a)) <= side);
}

TEST_CASE("a byte order mark at the start of a file is skipped, unless the file is a trace") {
  const scratch_folder folder;
  folder.write("K.dof", std::string("\xEF\xBB\xBF") + "5.1\n");
  CHECK(parse_labels(read_input(folder.at("K.dof")), "K.dof") == std::vector<std::string>{"5.1"});
  CHECK(read_input(folder.at("K.dof"), "trace").size() == 7);
}

TEST_CASE(
    "a matrix or vector file gives one warning for all numbers that are longer than the shortest decimal") {
  std::vector<std::string> warnings;
  const sparse_matrix m = parse_symmetric(
      header + "2 2 3\n2 2 2.10e0\n2 1 -0.10000000000000000555\n1 1 7.000000000000000000001\n", "K.mtx",
      &warnings);
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
  (void)parse_symmetric(header + "1 1 1\n1 1 " + "0." + std::string(1500, '3') + "\n", "K.mtx", &warnings);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].size() < 200);
  (void)parse_symmetric(header + "1 1 1\n1 1 2.500000000000000000000e+01\n", "K.mtx", &warnings);
  CHECK(warnings.size() == 1);
}

TEST_CASE(
    "a file of coordinates may have comments, blank lines, any node names, and two or three numbers a node") {
  CHECK(nodes_of(parse_coordinates(small_places, "K.xyz")) == texts{"a 0 0 0", "b 1.5 -0.002 0"});
  CHECK(nodes_of(parse_coordinates("node.7 +1 .5 5.\r\n12 0 0 -1E+2 # a long comment of many many texts\n",
                                   "K.xyz")) == texts{"node.7 1 0.5 5", "12 0 0 -100"});
}

TEST_CASE("in the label of a dof, the last dot separates the node from the direction") {
  const std::pair<const char*, int> directions[] = {
      {"x", 1},  {"y", 2}, {"z", 3}, {"1", 1}, {"3", 3}, {"r", 6}, {"rx", 4}, {"ry", 5},
      {"rz", 6}, {"4", 4}, {"6", 6}, {"7", 0}, {"", 0},  {"X", 0}, {"xy", 0}, {"01", 0}};
  for (const auto& [name, direction] : directions) {
    INFO(name);
    const assembled m = with_labels({"a.x", std::string("b.c.") + name});
    CHECK(dofs_of(places_by_coordinates("b.c 1 0\na 0 0\n", "K.xyz", m)) ==
          texts{"a.1", direction == 0 ? "none" : fmt::format("b.c.{}", direction)});
  }
  const placed_nodes unknown =
      places_by_coordinates("a 0 0\n", "K.xyz", with_labels({"1", "2", "a.q", ".x"}));
  CHECK_FALSE(unknown.known());
  CHECK(unknown.dofs.empty());
}

TEST_CASE(
    "notes give the number of dofs that are not drawn, because the node is unknown or the dof is a "
    "rotation") {
  const placed_nodes places = places_by_coordinates(
      "a 0 0\nb.c 1 0\n", "K.xyz", with_labels({"a.x", "b.c.y", "b.c.rz", "d.x", "a", "a.w", "a.1", "b.x"}));
  // The label a.1 means the same direction as a.x, which comes first, so dof 6 is not drawn.
  CHECK(dofs_of(places) == texts{"a.1", "b.c.2", "b.c.6", "none", "none", "none", "none", "none"});
  REQUIRE(places.notes.size() == 2);
  CHECK_THAT(places.notes[0], Contains("5 of 8 dofs") && Contains("as \"d.x\""));
  CHECK_THAT(places.notes[1], Contains("Rotations (1 of 8 dofs)"));
}

TEST_CASE("two nodes have one edge if the matrix couples them, unless it couples more than 3 n pairs") {
  const assembled chain =
      with_labels({"a.x", "a.y", "b.x", "b.r", "c.x", "odd"},
                  {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {4, 3, -2}, {2, 1, 1}, {4, 0, 0.0}, {5, 0, 1}});
  CHECK(edges_of(places_by_coordinates("a 0 0\nb 1 0\nc 2 0\n", "K.xyz", chain)) == "a-b b-c");
  // A full matrix couples 28 pairs of 8 nodes, of which 24 are allowed, and 21 pairs of 7 nodes.
  for (const int n : {7, 8}) {
    std::string text;
    texts labels;
    std::vector<matrix_entry> full;
    for (int i = 0; i < n; ++i) {
      text += fmt::format("{} {} 0\n", i, i);
      labels.push_back(fmt::format("{}.x", i));
      for (int j = 0; j <= i; ++j) full.push_back({i, j, 1.0});
    }
    const placed_nodes solid = places_by_coordinates(text, "K.xyz", with_labels(labels, full));
    CHECK(solid.edges.size() == (n == 7 ? 21U : 0U));
    REQUIRE(solid.notes.size() == (n == 7 ? 0U : 1U));
    if (n == 8) CHECK_THAT(solid.notes[0], Contains("28 pairs of its 8 nodes"));
  }
}

TEST_CASE("CalculiX's nodes are read in any letter case, and a missing coordinate is 0") {
  const placed_nodes m = by_mesh(
      "** a comment\n*HEADING\n1, 2, three\n * node , NSET = all\r\n1, 1.5 , -2.E-3,+.5\n\n2,1D1,,2d-1\n"
      "3\t,4\n*NODE FILE\nU\n*Node\n3,4.,0,0,\n*STEP\n5,5,5\n*END STEP",
      {"1.1", "2.1", "3.1"});
  CHECK(nodes_of(m.nodes) == texts{"1 1.5 -0.002 0.5", "2 10 0 0.2", "3 4 0 0"});
  CHECK(m.edges.empty());
  CHECK(m.notes.empty());
}

TEST_CASE(
    "a node without a dof and without an edge is omitted, and edges and dofs refer to the remaining nodes") {
  const placed_nodes m =
      by_mesh(nodes_text(7) + "*ELEMENT,TYPE=C3D4\n1,3,4,5,7\n", {"7.1", "x", "6.2", "7.2"});
  CHECK(m.nodes.size() == 5);
  CHECK(edges_of(m) == "3-4 3-5 3-7 4-5 4-7 5-7");
  CHECK(dofs_of(m) == texts{"7.1", "none", "6.2", "7.2"});
}

TEST_CASE(
    "each type of solid element has the edges between its corners, through the middle nodes if there are "
    "any") {
  // By CalculiX's manual, edges go from corner to middle node to corner: node 5 of C3D10 is between 1 and 2,
  // node 6 between 2 and 3, ..
  const std::tuple<const char*, int, const char*> shapes[] = {
      {"C3D4", 4, "1-2 1-3 1-4 2-3 2-4 3-4"},
      {"c3d6", 6, "1-2 1-3 1-4 2-3 2-5 3-6 4-5 4-6 5-6"},
      {"C3D8I", 8, "1-2 1-4 1-5 2-3 2-6 3-4 3-7 4-8 5-6 5-8 6-7 7-8"},
      {"C3D10T", 10, "1-5 1-7 1-8 2-5 2-6 2-9 3-6 3-7 3-10 4-8 4-9 4-10"},
      {"C3D15", 15, "1-7 1-9 1-13 2-7 2-8 2-14 3-8 3-9 3-15 4-10 4-12 4-13 5-10 5-11 5-14 6-11 6-12 6-15"},
      {"C3D20R", 20,
       "1-9 1-12 1-17 2-9 2-10 2-18 3-10 3-11 3-19 4-11 4-12 4-20 "
       "5-13 5-16 5-17 6-13 6-14 6-18 7-14 7-15 7-19 8-15 8-16 8-20"}};
  for (const auto& [type, nodes, edges] : shapes) {
    INFO(type);
    // CalculiX accepts nodes after the elements that use them.
    const placed_nodes m = by_mesh(element_text(type, nodes) + nodes_text(nodes));
    CHECK(edges_of(m) == edges);
    CHECK(m.notes.empty());
  }
}

TEST_CASE("an edge of several elements is listed once, and notes list elements that are not drawn") {
  const placed_nodes m = by_mesh(nodes_text(6) +
                                 "*ELEMENT,ELSET=A,TYPE=C3D4\n1,1,2,3,4\n2,2,3,4,\n** a comment\n5\n"
                                 "*ELEMENT,TYPE=C3D4,ELSET=B\n3,3,2,4,6\n");
  CHECK(edges_of(m) == "1-2 1-3 1-4 2-3*3 2-4*3 2-5 2-6 3-4*3 3-5 3-6 4-5 4-6");
  const placed_nodes not_drawn = by_mesh(nodes_text(3) +
                                         "*INCLUDE, INPUT=more.inp\n*ELEMENT, TYPE=B31\n1,1,2\n2,2,3\n"
                                         "*element,type=s8r\n3,1,2,3,1,2,\n3,1,2\n");
  CHECK(not_drawn.edges.empty());
  REQUIRE(not_drawn.notes.size() == 2);
  CHECK_THAT(not_drawn.notes[0], Contains("*INCLUDE in job.inp is not followed"));
  CHECK_THAT(not_drawn.notes[1], Contains("2 of type \"B31\", 1 of type \"S8R\""));
}

TEST_CASE("a CalculiX mesh of 59,200 bricks is read, and its edges are those of the grid of bricks") {
  constexpr int across = 41, along = 38;
  std::string bricks = "*ELEMENT,TYPE=C3D8\n";
  for (int a = 1; a <= across * across * (along - 1); ++a) {
    if (a % across == 0 || (a - 1) / across % across == across - 1) continue;
    bricks += std::to_string(a);
    for (const int layer : {0, across * across})
      for (const int corner : {0, 1, across + 1, across}) bricks += fmt::format(",{}", a + layer + corner);
    bricks += "\n";
  }
  const placed_nodes m = by_mesh(nodes_text(across * across * along) + bricks);
  CHECK(m.edges.size() == std::size_t{40} * 41 * 38 * 2 + std::size_t{41} * 41 * 37);
}
