// Tests the places of a matrix's dofs: files of coordinates, labels, edges between nodes, and CalculiX's
// input files.
#include <fmt/format.h>

#include "catch.hpp"
#include "contct/read/matrix_files.hpp"
#include "read/refusals.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

using place = std::array<double, 3>;

std::string of_coordinates(const std::string& text) {
  return verdict([&] { (void)parse_coordinates(text, "K.xyz"); });
}

/// Returns the edges by the names of their nodes, each followed by the number of its elements if this is
/// not 1.
std::string edges_of(const placed_nodes& m) {
  std::string text;
  for (const mesh_edge& e : m.edges)
    text += fmt::format("{}{}-{}{}", text.empty() ? "" : " ", m.nodes[e.from].name, m.nodes[e.to].name,
                        e.elements == 1 ? "" : fmt::format("*{}", e.elements));
  return text;
}

/// Returns a matrix with these labels and only these couplings.
assembled with_labels(std::vector<std::string> labels, std::vector<matrix_entry> entries = {}) {
  assembled a;
  a.stiffness = {static_cast<int>(labels.size()), std::move(entries)};
  a.labels = std::move(labels);
  return a;
}

placed_nodes by_mesh(const std::string& text, std::vector<std::string> labels = {"1.x"}) {
  return places_by_mesh(text, "job.inp", with_labels(std::move(labels)));
}

const std::string good_places = "# the frame\n\na 0 0 # foot\nb\t1.5 -2e-3\n";

}  // namespace

TEST_CASE(
    "a file of coordinates may have comments, blank lines, any node names, and two or three numbers a node") {
  const auto flat = parse_coordinates(good_places, "K.xyz");
  REQUIRE(flat.size() == 2);
  CHECK(flat[0].name == "a");
  CHECK(flat[1].at == place{1.5, -2e-3, 0});
  const auto solid =
      parse_coordinates("node.7 +1 .5 5.\r\n12 0 0 -1E+2 # a long comment of many many words\n", "K.xyz");
  REQUIRE(solid.size() == 2);
  CHECK(solid[0].name == "node.7");
  CHECK(solid[0].at == place{1, 0.5, 5});
  CHECK(solid[1].at == place{0, 0, -100});
}

TEST_CASE("a mistake in a file of coordinates is refused with line, what was found and what is allowed") {
  check_refusals(
      {
          {"", "K.xyz: ", "no node", "name x y"},
          {good_places + "c 1 # 2\n", "K.xyz:5", "a line of 7 bytes", "name x y"},
          {good_places + "c 1 2 3 4\n", "K.xyz:5", "a line of 9 bytes", "name x y"},
          {good_places + "c 1 2 3\n", "K.xyz:5", "3 coordinates for node \"c\"", "2, as in the lines before"},
          {good_places + "b 1 2\n", "K.xyz:5", "the node of line 4 a second time", "each node once"},
          {good_places + "c nan 2\n", "K.xyz:5", "\"nan\" for x", "finite"},
          {good_places + "c 1 2", "K.xyz:5", "a line of 5 bytes without a line end", "a line end"},
      },
      of_coordinates);
  CHECK(of_coordinates(good_places) == "accepted");
}

TEST_CASE("in the label of a dof, the last dot separates the node from the direction") {
  const std::vector<std::pair<std::string, int>> directions = {
      {"x", 1},  {"y", 2}, {"z", 3}, {"1", 1}, {"3", 3}, {"r", 6}, {"rx", 4}, {"ry", 5},
      {"rz", 6}, {"4", 4}, {"6", 6}, {"7", 0}, {"", 0},  {"X", 0}, {"xy", 0}, {"01", 0}};
  for (const auto& [name, direction] : directions) {
    INFO(name);
    const placed_nodes places =
        places_by_coordinates("b.c 1 0\na 0 0\n", "K.xyz", with_labels({"a.x", "b.c." + name}));
    CHECK(places.dofs.at(1).direction == direction);
    CHECK(places.dofs[1].node == (direction == 0 ? -1 : 0));
  }
}

TEST_CASE(
    "notes give the number of dofs that are not drawn, because the node is unknown or the dof is a "
    "rotation") {
  const placed_nodes places = places_by_coordinates(
      "a 0 0\nb.c 1 0\n", "K.xyz", with_labels({"a.x", "b.c.y", "b.c.rz", "d.x", "a", "a.w", "a.1", "b.x"}));
  CHECK(places.dofs[1].node == 1);
  // The label a.1 means the same direction as a.x, which comes first, so dof 6 is not drawn.
  for (std::size_t dof = 3; dof < 8; ++dof) CHECK(places.dofs[dof].node == -1);
  REQUIRE(places.notes.size() == 2);
  CHECK_THAT(places.notes[0], Contains("5 of 8 dofs") && Contains("as \"d.x\""));
  CHECK_THAT(places.notes[1], Contains("Rotations (1 of 8 dofs)"));
}

TEST_CASE("if no label of a dof names a node with coordinates, all coordinates are unknown") {
  const placed_nodes places = places_by_coordinates("a 0 0\n", "K.xyz", with_labels({"1", "2", "a.q", ".x"}));
  CHECK_FALSE(places.known());
  CHECK(places.dofs.empty());
}

TEST_CASE("two nodes have one edge if the matrix couples them by an entry that is not 0") {
  const assembled chain =
      with_labels({"a.x", "a.y", "b.x", "b.r", "c.x", "odd"},
                  {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {4, 3, -2}, {2, 1, 1}, {4, 0, 0.0}, {5, 0, 1}});
  CHECK(edges_of(places_by_coordinates("a 0 0\nb 1 0\nc 2 0\n", "K.xyz", chain)) == "a-b b-c");
}

TEST_CASE("no edges are drawn if a matrix of n nodes couples more than 3 n pairs of nodes") {
  // A full matrix couples 28 pairs of 8 nodes, of which 24 are allowed, and 21 pairs of 7 nodes.
  for (const int n : {7, 8}) {
    std::string text;
    std::vector<std::string> labels;
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

namespace {

std::string of_mesh(const std::string& text) {
  return verdict([&] { (void)by_mesh(text); });
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

TEST_CASE("CalculiX's nodes are read in any letter case, and a missing coordinate is 0") {
  const placed_nodes m = by_mesh(
      "** a comment\n*HEADING\n1, 2, three\n * node , NSET = all\r\n1, 1.5 , "
      "-2.E-3,+.5\n\n2,1D1,,2d-1\n3\t,4\n"
      "*NODE FILE\nU\n*Node\n3,4.,0,0,\n*STEP\n5,5,5\n*END STEP",
      {"1.1", "2.1", "3.1"});
  REQUIRE(m.nodes.size() == 3);
  CHECK(m.nodes[0].name == "1");
  CHECK(m.nodes[0].at == place{1.5, -2e-3, 0.5});
  CHECK(m.nodes[1].at == place{10, 0, 0.2});
  CHECK(m.nodes[2].at == place{4, 0, 0});
  CHECK(m.edges.empty());
  CHECK(m.notes.empty());
}

TEST_CASE(
    "a node without a dof and without an edge is omitted, and edges and dofs refer to the remaining nodes") {
  const placed_nodes m =
      by_mesh(nodes_text(7) + "*ELEMENT,TYPE=C3D4\n1,3,4,5,7\n", {"7.1", "x", "6.2", "7.2"});
  REQUIRE(m.nodes.size() == 5);
  CHECK(edges_of(m) == "3-4 3-5 3-7 4-5 4-7 5-7");
  CHECK(m.dofs[0].node == 4);
  CHECK(m.dofs[1].node == -1);
  CHECK(m.nodes[m.dofs[2].node].name == "6");
}

TEST_CASE(
    "each type of solid element has the edges between its corners, through the middle nodes if there are "
    "any") {
  struct shape {
    const char* type;
    int nodes;
    const char* edges;
  };
  // By CalculiX's manual, edges go from corner to middle node to corner: node 5 of C3D10 is between 1 and 2,
  // node 6 between 2 and 3, ..
  const shape shapes[] = {
      {"C3D4", 4, "1-2 1-3 1-4 2-3 2-4 3-4"},
      {"c3d6", 6, "1-2 1-3 1-4 2-3 2-5 3-6 4-5 4-6 5-6"},
      {"C3D8I", 8, "1-2 1-4 1-5 2-3 2-6 3-4 3-7 4-8 5-6 5-8 6-7 7-8"},
      {"C3D10T", 10, "1-5 1-7 1-8 2-5 2-6 2-9 3-6 3-7 3-10 4-8 4-9 4-10"},
      {"C3D15", 15, "1-7 1-9 1-13 2-7 2-8 2-14 3-8 3-9 3-15 4-10 4-12 4-13 5-10 5-11 5-14 6-11 6-12 6-15"},
      {"C3D20R", 20,
       "1-9 1-12 1-17 2-9 2-10 2-18 3-10 3-11 3-19 4-11 4-12 4-20 "
       "5-13 5-16 5-17 6-13 6-14 6-18 7-14 7-15 7-19 8-15 8-16 8-20"},
  };
  for (const shape& s : shapes) {
    INFO(s.type);
    // CalculiX accepts nodes after the elements that use them.
    const placed_nodes m = by_mesh(element_text(s.type, s.nodes) + nodes_text(s.nodes));
    CHECK(edges_of(m) == s.edges);
    CHECK(m.notes.empty());
  }
}

TEST_CASE("an edge of several elements is listed once, with the number of these elements") {
  const placed_nodes m = by_mesh(nodes_text(6) +
                                 "*ELEMENT,ELSET=A,TYPE=C3D4\n1,1,2,3,4\n2,2,3,4,\n** a comment\n5\n"
                                 "*ELEMENT,TYPE=C3D4,ELSET=B\n3,3,2,4,6\n");
  CHECK(edges_of(m) == "1-2 1-3 1-4 2-3*3 2-4*3 2-5 2-6 3-4*3 3-5 3-6 4-5 4-6");
}

TEST_CASE("notes give the number of elements in CalculiX's input file that are not drawn") {
  const placed_nodes m = by_mesh(nodes_text(3) +
                                 "*INCLUDE, INPUT=more.inp\n*ELEMENT, TYPE=B31\n1,1,2\n2,2,3\n"
                                 "*element,type=s8r\n3,1,2,3,1,2,\n3,1,2\n");
  CHECK(m.edges.empty());
  REQUIRE(m.notes.size() == 2);
  CHECK_THAT(m.notes[0], Contains("*INCLUDE in job.inp is not followed"));
  CHECK_THAT(m.notes[1], Contains("2 of type \"B31\", 1 of type \"S8R\""));
}

TEST_CASE("a mistake in CalculiX's input file is refused with line, what was found and what is allowed") {
  const std::string nodes = nodes_text(4);  // 5 lines
  check_refusals(
      {
          {nodes + "x,1,2,3\n", "job.inp:6", "\"x\" for the node's number", "a whole number from 1"},
          {nodes + "99999999999,1,2,3\n", "job.inp:6", "\"99999999999\"", "to 2147483647"},
          {nodes + "7\n", "job.inp:6", "\"7\"", "number, x, y, z"},
          {nodes + "7,1,nan,3\n", "job.inp:6", "\"nan\" for a coordinate", "finite"},
          {nodes + "4,9,9,9\n", "job.inp:6", "node 4 again, at another place", "one place"},
          {nodes + "7,1,2,3", "job.inp:6", "\"7,1,2,3\" without a line end", "a line end"},
          {nodes + std::string("7,1\0,2,3\n", 9), "job.inp:6", "a byte with the value 0", "a text file"},
          {nodes + "*ELEMENT\n1,1,2,3,4\n", "job.inp:6", "*ELEMENT without TYPE", "TYPE="},
          {nodes + "*ELEMENT, TYPE=C3D4\n1,1,2,3,9\n", "job.inp:7", "node 9 in an element", "*NODE defines"},
          {nodes + "*INCLUDE,INPUT=a\n*ELEMENT, TYPE=C3D4\n1,1,2,3,9\n", "job.inp:8", "node 9 in an element",
           "*INCLUDE is not followed"},
          {nodes + "*ELEMENT, TYPE=C3D4\n1,1,2,3\n*STEP\n", "job.inp:7", "an element with 3 nodes",
           "4 nodes for type C3D4"},
          {nodes + "*ELEMENT, TYPE=C3D4\n1,1,2,3,4,1\n", "job.inp:7", "\"1,1,2,3,4,1\"",
           "4 nodes for an element"},
          {nodes + "*ELEMENT, TYPE=C3D4\n1,1,,3,4\n", "job.inp:7", "\"\" for a node's number",
           "a whole number"},
      },
      of_mesh);
  CHECK(of_mesh(nodes) == "accepted");
}

TEST_CASE("a CalculiX mesh of 60,000 bricks is read, and its edges are those of the grid of bricks") {
  std::string text = "*NODE\n";
  constexpr int across = 41;
  constexpr int along = 38;
  for (int i = 0; i < across * across * along; ++i)
    text += fmt::format("{},{},{},{}\n", i + 1, i % across, i / across % across, i / across / across);
  text += "*ELEMENT,TYPE=C3D8\n";
  int bricks = 0;
  for (int k = 0; k + 1 < along; ++k) {
    for (int j = 0; j + 1 < across; ++j) {
      for (int i = 0; i + 1 < across; ++i) {
        const int a = (k * across + j) * across + i + 1;
        const int b = a + across * across;
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", ++bricks, a, a + 1, a + across + 1, a + across, b,
                            b + 1, b + across + 1, b + across);
      }
    }
  }
  const placed_nodes m = by_mesh(text);  // quadratic work would exceed the time limit
  CHECK(bricks == 59200);
  CHECK(m.edges.size() == std::size_t{40} * 41 * 38 * 2 + std::size_t{41} * 41 * 37);
}
