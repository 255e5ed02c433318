// A run in one picture, structures in it, and the pieces of SVG.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/write/pictures.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "read/small_matrix.hpp"
#include "support/a_run.hpp"
#include "support/scratch_folder.hpp"
#include "support/structures.hpp"
#include "support/well_formed.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;
using namespace contct::write::svg;

namespace {

/// The first numbers in `text` from `at` on.
std::vector<double> numbers_from(const std::string& text, std::size_t at, std::size_t count) {
  std::vector<double> numbers;
  while (numbers.size() < count && (at = text.find_first_of("-.0123456789", at)) != std::string::npos) {
    std::size_t length = 0;
    numbers.push_back(std::stod(text.substr(at, 30), &length));
    at += length;
  }
  REQUIRE(numbers.size() == count);
  return numbers;
}

}  // namespace

TEST_CASE("the picture is well-formed, whatever the title, and has a mark for every pair") {
  for (const std::string& text : {loaded_and_freed, std::string(good_plate)}) {
    const a_run r("title = \"<b> & \\\"x\\\" \\u0001\"\n" + text);
    const std::string svg = run_svg(r.finished());
    CHECK(why_not_well_formed(svg).empty());
    CHECK_THAT(svg, Contains("&lt;b&gt; &amp; &quot;x&quot; \\x01"));
    for (std::size_t i = 0; i < r.what.pairs.size(); ++i)
      CHECK_THAT(svg, Contains("<title>pair " + std::to_string(i + 1) + ", "));
    CHECK_THAT(svg, !Contains("nan"));
    CHECK_THAT(svg, !Contains("inf"));
  }
}

TEST_CASE("a picture of what never moved, without pairs, has no number that is none") {
  const std::string still =
      "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[step]]\nuniform = 0\n";
  const std::string svg = run_svg(a_run(still).finished());
  CHECK(why_not_well_formed(svg).empty());
  CHECK_THAT(svg, !Contains("nan"));
  CHECK_THAT(svg, !Contains("inf"));
}

TEST_CASE("load over deflection stands below the beam: the start top right, the full load bottom left") {
  const a_run r(good_problem);
  const std::string svg = run_svg(r.finished());
  const double tip = r.kept.frames().back().displacement[4];
  // The beam's lowest point is 50 times its deflection, at 390 to a unit, below its axis at y = 130.
  const double below_beam = 130.0 - 50 * 390 * tip + 44 + 30;
  const double top = below_beam + 20 + 44;
  const double touching = 110.0 + 730 * (-0.004 - tip) / -tip;  // of 110 to 840
  CHECK_THAT(svg, Contains(fmt::format("y=\"{:.1f}\" class=\"strong\">Sum of the loads", top - 28)));
  CHECK_THAT(svg, Contains(fmt::format(
                      "<circle cx=\"840.00\" cy=\"{:.2f}\" r=\"4\" class=\"stop\"><title>0.0<", top)));
  CHECK_THAT(svg, Contains(fmt::format(
                      "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"4\" class=\"make\"><title>1.1<", touching,
                      top + 60)));  // a quarter of the load
  CHECK_THAT(svg, Contains(fmt::format(
                      "<circle cx=\"110.00\" cy=\"{:.2f}\" r=\"4\" class=\"stop\"><title>1.2<", top + 240)));
  CHECK_THAT(svg, Contains(fmt::format("d=\"M840.00 {:.2f}L{:.2f} {:.2f}L110.00 {:.2f}\" class=\"track\"",
                                       top, touching, top + 60, top + 240)));
  CHECK_THAT(svg, Contains(fmt::format("height=\"{:.0f}\"", top + 240 + 48)));
}

TEST_CASE("a beam's axis, supports, faces and pairs stand where they are, deflections downwards") {
  const a_run r(good_problem);
  const std::string svg = run_svg(r.finished());
  // 2 long from x = 60 to 840; deflections 50 times as large, at 390 to a unit; the axis at y = 130.
  CHECK_THAT(svg, Contains("d=\"M60.0 130.0L840.0 130.0\" class=\"undeformed\""));
  CHECK_THAT(svg, Contains("deflection × 50<"));
  const double tip = 130 - 50 * 390 * r.kept.frames().back().displacement[4];
  CHECK(tip > 200);
  CHECK_THAT(svg, Contains("<path d=\"M60.00 130.00C") &&
                      Contains(fmt::format(" 840.00 {:.2f}\" class=\"beam\"", tip)));
  CHECK_THAT(svg, Contains("d=\"M60.0 132.0l8 13h-16z\" class=\"support\""));     // w: a triangle below
  CHECK_THAT(svg, Contains("d=\"M60.0 117.0L60.0 143.0\" class=\"clamp\""));      // theta
  CHECK_THAT(svg, Contains("d=\"M826.0 208.0L854.0 208.0\" class=\"surface\""));  // 0.004 * 50 * 390 below
  CHECK_THAT(svg, Contains("d=\"M829.0 208.0L832.0 214.0\" class=\"hatch\""));    // on the face's far side
  CHECK_THAT(
      svg, Contains(fmt::format(
               "<rect x=\"835.0\" y=\"{:.1f}\" width=\"10.0\" height=\"10.0\" class=\"closed\">", tip - 5)));
  CHECK_THAT(svg,
             Contains(fmt::format("d=\"M60.0 {0:.1f}L60.0 {1:.1f}\" class=\"thin\"", tip + 44, tip + 49)));
}

TEST_CASE("a face above is hatched upwards") {
  std::string text = with("below", "above");
  text.replace(text.find("-0.004"), 6, "0.004");
  text.replace(text.find("-60.0"), 5, "60.0");
  const std::string svg = run_svg(a_run(text).finished());
  const std::vector<double> hatch = numbers_from(svg, svg.rfind("d=\"", svg.find("class=\"hatch\"")), 4);
  CHECK(hatch[2] == hatch[0] - 3);
  CHECK(hatch[3] == hatch[1] - 6);
}

TEST_CASE("a plate is drawn with y upwards: a cell, a pair, the legend and the axis in their places") {
  const a_run r(good_plate);
  const std::string svg = run_svg(r.finished());
  // 1 by 1 at 430 to a unit, its upper left corner at (60, 110); two cells, each in 16 by 16 parts of one
  // colour.
  for (const char* corner : {"x=\"60.00\" y=\"110.00\"", "x=\"476.56\" y=\"110.00\"",
                             "x=\"60.00\" y=\"513.12\"", "x=\"476.56\" y=\"513.12\""})
    CHECK_THAT(svg, Contains(fmt::format("<rect {} width=\"13.44\" height=\"26.88\" fill=", corner)));
  CHECK_THAT(svg, Contains("M60.0 540.0L60.0 545.0"));
  // The largest deflection is the lightest and on top.
  CHECK_THAT(
      svg,
      Contains("<rect x=\"530.0\" y=\"110.0\" width=\"20.0\" height=\"20.0\" fill=\"rgb(250,244,228)\"/>"));
  CHECK_THAT(
      svg, Contains("<rect x=\"530.0\" y=\"310.0\" width=\"20.0\" height=\"20.0\" fill=\"rgb(22,52,98)\"/>"));
  CHECK_THAT(
      svg,
      Contains(
          "<rect x=\"484.0\" y=\"104.0\" width=\"12.0\" height=\"12.0\" class=\"closed\">"));  // at (1, 1)
}

TEST_CASE("a pair's mark is a ring, a square or a diamond around its point, with its numbers") {
  const a_run r(good_problem);
  const auto mark = [&](std::size_t frame) {
    return mark_of_pair(r.what, r.kept.frames()[frame], 0, {100, 200}, 5);
  };
  CHECK_THAT(mark(0), Contains("<circle cx=\"100.0\" cy=\"200.0\" r=\"5.0\" class=\"open\">"));
  CHECK_THAT(mark(0), Contains("<title>pair 1, node 3, face below at -0.004, separated: gap 0.004</title>"));
  CHECK_THAT(mark(1), Contains("M100.0 193.5l6.5 6.5l-6.5 6.5l-6.5 -6.5z\" class=\"face\"") &&
                          Contains("at its face"));
  CHECK_THAT(mark(2),
             Contains("<rect x=\"95.0\" y=\"195.0\" width=\"10.0\" height=\"10.0\" class=\"closed\">"));
  CHECK_THAT(mark(2), Contains("in contact: force 41.8605</title>"));
}

TEST_CASE(
    "the picture of a structure from elsewhere is well-formed, with a mark for every pair, or with a table") {
  for (const std::string& text :
       {portal_frame(), structure_problem("calculix/", "console"), frame_without_coordinates()}) {
    const a_run r(text);
    const std::string svg = run_svg(r.finished());
    CHECK(why_not_well_formed(svg).empty());
    CHECK_THAT(svg, !Contains("nan") && !Contains("inf"));
    const auto& a = std::get<assembled>(r.what.geometry.kind);
    for (std::size_t i = 0; i < r.what.pairs.size(); ++i) {
      const std::string label = a.label_of(r.what.pairs[i].node);
      CHECK_THAT(svg, Contains(a.places.known() ? fmt::format("<title>pair {}, dof {}, face", i + 1, label)
                                                : fmt::format(">{}</text>", label)));
    }
    CHECK((svg.find("class=\"member\"") != std::string::npos) == a.places.known());
    CHECK((svg.find("no coordinates are known") == std::string::npos) == a.places.known());
  }
}

TEST_CASE("the frame's picture has its corner where it is, and is drawn where it was when it came back") {
  const a_run r(portal_frame());
  const std::string svg = run_svg(r.finished());
  // Unloaded at the end: both paths are the same, and 4 m are wider than 3 m are high.
  const auto path_of = [&svg](const std::string& kind) {
    const std::size_t to = svg.find("\" class=\"" + kind + "\"/>");
    const std::size_t from = svg.rfind("d=\"", to) + 3;
    return svg.substr(from, to - from);
  };
  CHECK(path_of("member") == path_of("was"));
  const std::vector<double> column = numbers_from(path_of("was"), 0, 4);
  CHECK(column[0] == column[2]);      // the left column
  CHECK(column[1] > column[3] + 50);  // goes up
  CHECK_THAT(svg, Contains("displacement × 200<"));
}

TEST_CASE("the frame stands in the middle of the page, its supports below its feet") {
  const std::string svg = run_svg(a_run(portal_frame()).finished());
  // The feet, 4 m apart: clamped, each with a triangle left of it (x), one below it (y) and a square.
  const std::size_t foot = svg.find("<path d=\"M", svg.find("class=\"support\""));
  const std::vector<double> triangle = numbers_from(svg, foot, 6);
  CHECK(triangle[3] == Approx(triangle[1] + 12));
  CHECK(triangle[5] == Approx(triangle[1] + 12));
  const std::size_t last = svg.rfind("d=\"M", svg.rfind("class=\"support\""));
  const double right = numbers_from(svg, last, 1)[0];
  CHECK((triangle[0] + right + 4.5) / 2 == Approx(450.0).margin(0.11));
}

TEST_CASE("without coordinates pairs are rows of a table, 22 apart, below the dof that moves most") {
  const std::string svg = run_svg(a_run(frame_without_coordinates()).finished());
  CHECK_THAT(svg, Contains("<text x=\"60.0\" y=\"126.0\" class=\"quiet\">pair</text>"));
  CHECK_THAT(svg, Contains("<text x=\"130.0\" y=\"148.0\" class=\"plain\">6.y</text>"));
  CHECK_THAT(svg, Contains("<text x=\"60.0\" y=\"170.0\" class=\"plain\">1</text>"));
  CHECK_THAT(svg, Contains("<text x=\"130.0\" y=\"192.0\" class=\"plain\">8.x</text>"));
}

TEST_CASE("a scale goes through its origin, and a span is never empty") {
  const scale X{2.0, 10.0, 60.0};
  CHECK(X(2.0) == 60.0);
  CHECK(X(3.0) == 70.0);
  span_of s;
  s.take(4.0);
  CHECK(s.range() == 1.0);
  s.take(1.0);
  CHECK(s.least == 1.0);
  CHECK(s.most == 4.0);
  CHECK(s.range() == 3.0);
}

TEST_CASE("ticks are 1, 2 or 5 times a power of ten apart, and within their span") {
  CHECK(round_down(0.099) == Approx(0.05));
  CHECK(round_down(20.0) == Approx(20.0));
  CHECK(round_down(1.9) == Approx(1.0));
  const std::vector<double> t = ticks(-1.0, 1.1, 5);
  CHECK(t == std::vector<double>{-1.0, -0.5, 0.0, 0.5, 1.0});
}

TEST_CASE("a span that doubles do not hold has no ticks") {
  CHECK(ticks(-1.0, std::numeric_limits<double>::infinity(), 8).empty());
  CHECK(ticks(0.0, std::numeric_limits<double>::denorm_min(), 8).empty());
  CHECK_FALSE(ticks(-1e308, 5e307, 8).empty());
}

TEST_CASE("words are escaped, markup is not, and an empty path is none") {
  CHECK(text_at(1, 2.25, "quiet", "a < b") == "<text x=\"1.0\" y=\"2.2\" class=\"quiet\">a &lt; b</text>\n");
  CHECK(text_markup(1, 2, "fill=\"red\"", "10<tspan>2</tspan>") ==
        "<text x=\"1.0\" y=\"2.0\" fill=\"red\">10<tspan>2</tspan></text>\n");
  CHECK(title("\"&\"") == "<title>&quot;&amp;&quot;</title>");
  CHECK(path("", "thin").empty());
  CHECK(line(0, 1, 2, 3, "thin") == "<path d=\"M0.0 1.0L2.0 3.0\" class=\"thin\"/>\n");
  CHECK(circle(1, 2, 3, "id=\"x\"") == "<circle cx=\"1.0\" cy=\"2.0\" r=\"3.0\" id=\"x\"/>\n");
  CHECK(rectangle(1, 2, 3, 4, "id=\"x\"", title("t")) ==
        "<rect x=\"1.0\" y=\"2.0\" width=\"3.0\" height=\"4.0\" id=\"x\"><title>t</title></rect>\n");
}

TEST_CASE("an axis has a tick below its place and the number below the tick") {
  const std::string axis = axis_below({0.0, 100.0, 60.0}, 0.0, 1.0, 300.0);
  CHECK(axis.find("M60.0 300.0L60.0 305.0") != std::string::npos);
  CHECK(axis.find("<text x=\"160.0\" y=\"320.0\" class=\"quiet middle\">1</text>") != std::string::npos);
}

TEST_CASE("the picture of a loaded beam of one element follows its exact line") {
  const a_run r(
      "[beam]\nx = [0, 2]\nEI = 1.0\n[[support]]\nnodes = [1, 2]\nfix = [\"w\", \"theta\"]\n"
      "[[step]]\nuniform = -1.0\n");
  const std::string svg = run_svg(r.finished());
  // Both nodes are clamped, so all of its deflection is between them: a curve in several pieces.
  const std::size_t at = svg.rfind("<path", svg.find("class=\"beam\""));
  const std::string curve = svg.substr(at, svg.find("/>", at) - at);
  CHECK(std::count(curve.begin(), curve.end(), 'C') == 8);
}

TEST_CASE("The picture of a plate has maps of its moments and of a bed's pressure, and rings for reactions") {
  const a_run on_bed(
      "[units]\nlength = \"m\"\nforce = \"kN\"\n[plate]\nsize = [2, 1]\nelements = [4, 2]\nD = 5\nnu = 0.3\n"
      "[[support]]\nat = [0, 0]\nfix = \"w\"\n[[bed]]\nmodulus = 100\nface = 0\n[[step]]\npoint = [ { at = "
      "[2, 1], w = "
      "-3 } ]\n");
  const std::string svg = run_svg(on_bed.finished());
  CHECK(why_not_well_formed(svg).empty());
  for (const char* name :
       {">mx kN m/m<", ">my kN m/m<", ">mxy kN m/m<", ">pressure of the bed kN/m²<", "rings: reactions"})
    CHECK_THAT(svg, Contains(name));
  CHECK_THAT(svg, Contains("class=\"reaction\""));
  // Two beside each other: the first of them on the left.
  const auto left_of = [&svg](const char* name) {
    return numbers_from(svg, svg.rfind("<text x=\"", svg.find(name)), 1)[0];
  };
  CHECK(left_of(">mx kN m/m<") < 300.0);
  CHECK(left_of(">my kN m/m<") > 400.0);
  const a_run beam(loaded_and_freed);
  CHECK_THAT(run_svg(beam.finished()), !Contains("reaction\""));
}

TEST_CASE(
    "a face of a frame stands as far beside its node as the gap is, magnified as the frame's displacements "
    "are") {
  const a_run r(portal_frame());
  const std::string svg = run_svg(r.finished());
  // The left column, 3 m high: no higher than the page has room.
  const std::size_t was = svg.find("\" class=\"was\"/>");
  const std::vector<double> column = numbers_from(svg, svg.rfind("d=\"", was), 12);
  const double metre = (column[1] - column[11]) / 3;
  CHECK(metre > 60.0);
  CHECK(3 * metre < 400.0);
  const auto center_of_face = [&](std::size_t at) {
    const std::vector<double> ends =
        numbers_from(svg, svg.rfind("d=\"", svg.rfind("class=\"surface\"", at)), 4);
    return std::pair((ends[0] + ends[2]) / 2, (ends[1] + ends[3]) / 2);
  };
  const auto node_of = [&](const std::string& pair) {
    const std::size_t mark = svg.rfind("<circle", svg.find("<title>" + pair));
    REQUIRE(mark != std::string::npos);
    return std::pair(mark, numbers_from(svg, mark, 2));
  };
  // Unloaded at the end: a face 0.001 below dof 6.y, and one 0.0005 beyond dof 8.x, 200 times as far.
  const auto [below, at_6] = node_of("pair 1, dof 6.y, face below at -0.001, separated: gap 0.001<");
  CHECK(center_of_face(below).first == Approx(at_6[0]).margin(0.11));
  CHECK(center_of_face(below).second == Approx(at_6[1] + 200 * 0.001 * metre).margin(0.3));
  const auto [beyond, at_8] = node_of("pair 2, dof 8.x, face above at 0.0005, separated: gap 0.0005<");
  CHECK(center_of_face(beyond).first == Approx(at_8[0] + 200 * 0.0005 * metre).margin(0.3));
  CHECK(center_of_face(beyond).second == Approx(at_8[1]).margin(0.11));
}

TEST_CASE(
    "faces of a body that is seen from above are as far from their nodes as they are drawn foreshortened") {
  const a_run r(structure_problem("calculix/", "console"));
  const std::string svg = run_svg(r.finished());
  std::vector<double> pixels_of_gap;
  for (std::size_t i = 0; i < r.what.pairs.size(); ++i) {
    const std::size_t title = svg.find(fmt::format("<title>pair {}, ", i + 1));
    const std::size_t mark = svg.rfind("<circle", title);
    const std::vector<double> node = numbers_from(svg, mark, 2);
    const std::vector<double> face =
        numbers_from(svg, svg.rfind("d=\"", svg.rfind("class=\"surface\"", mark)), 4);
    const std::vector<double> gap = numbers_from(svg, svg.find("gap ", title), 1);
    pixels_of_gap.push_back((face[1] - node[1]) / gap[0]);
  }
  // An upright edge of the body, on the page and in space.
  const auto& places = std::get<assembled>(r.what.geometry.kind).places;
  const mesh_edge& edge = places.edges.front();
  double length = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    length += std::abs(places.nodes[edge.to].at[axis] - places.nodes[edge.from].at[axis]);
  const std::vector<double> drawn = numbers_from(svg, svg.rfind("d=\"", svg.find("\" class=\"was\"")), 4);
  REQUIRE(drawn[0] == drawn[2]);
  const double unit = std::abs(drawn[3] - drawn[1]) / length;
  for (const double of_gap : pixels_of_gap) CHECK(of_gap == Approx(50 * unit).epsilon(0.05));
}

TEST_CASE("a structure that is high or wide is drawn as large as the page has room, and no larger") {
  for (const bool wide : {false, true}) {
    const scratch_folder folder;
    std::ofstream(folder.at("K.mtx")) << small_matrix;
    std::ofstream(folder.at("K.dof")) << "a.x\nb.x\nc.x\n";
    std::ofstream(folder.at("K.xyz")) << (wide ? "a 0 0\nb 50 0\nc 100 0\n" : "a 0 0\nb 0 50\nc 0 100\n");
    const a_run r("[matrix]\nstiffness = \"" + folder.at("K.mtx") + "\"\ndofs = \"" + folder.at("K.dof") +
                  "\"\ncoordinates = \"" + folder.at("K.xyz") +
                  "\"\n[[step]]\npoint = [ { dof = \"b.x\", value = 0.0 } ]\n");
    const std::string svg = run_svg(r.finished());
    const std::vector<double> half = numbers_from(svg, svg.rfind("d=\"", svg.find("\" class=\"was\"/>")), 4);
    const double length = std::hypot(half[2] - half[0], half[3] - half[1]);
    CAPTURE(wide, length);
    CHECK(length > 100.0);
    CHECK(length < (wide ? 450.0 : 250.0));
  }
}

TEST_CASE("a plate whose deflections are further apart than doubles go is drawn without colours") {
  const a_run falls(
      "[plate]\nsize = [2, 1]\nelements = [4, 2]\nnu = 0.3\nD = 1\n"
      "[[contact]]\nnodes = [1, 11]\nsurface = \"below\"\nface = -1.5e308\nstiffness = 1\n"
      "[[contact]]\nnodes = [5, 15]\nsurface = \"above\"\nface = 1.5e308\nstiffness = 1\n"
      "[[step]]\npoint = [ { at = [2, 1], w = 1 }, { at = [0, 0], w = -1 } ]\n",
      {}, {}, "corrected");
  const std::string svg = run_svg(falls.finished());
  CHECK(why_not_well_formed(svg).empty());
  CHECK_THAT(svg, Contains("from above: the pairs"));
  CHECK_THAT(svg, !Contains("nan"));
}
