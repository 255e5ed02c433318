// Pieces of SVG pictures.
#include "contct/write/svg_parts.hpp"

#include "catch.hpp"

using namespace contct::write::svg;

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
