// A run in one picture.
#include "contct/write/run_svg.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "catch.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"
#include "support/well_formed.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

const std::string loaded_and_freed =
    std::string(good_problem) +
    "[[contact]]\nnode = 2\nsurface = \"above\"\nface = 0.001\nstiffness = 1e5\n"
    "[[step]]\npoint = [ { node = 3, w = 60.0 } ]\n";

}  // namespace

TEST_CASE("the picture is well-formed, whatever the title, and has a mark for every pair") {
  for (const std::string& text : {loaded_and_freed, std::string(good_plate)}) {
    const a_run r("title = \"<b> & \\\"x\\\" \\u0001\"\n" + text);
    const std::string svg = run_svg(r.finished());
    CHECK(why_not_well_formed(svg).empty());
    CHECK_THAT(svg, Contains("&lt;b&gt; &amp; &quot;x&quot; \xEF\xBF\xBD"));
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
