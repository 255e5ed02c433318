// The run as tables, grids and a picture.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catch.hpp"
#include "contct/outside/registry.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/markup.hpp"
#include "contct/write/run_csv.hpp"
#include "contct/write/run_svg.hpp"
#include "contct/write/run_vtu.hpp"
#include "read/bad_plates.hpp"
#include "support/a_run.hpp"
#include "support/scratch_folder.hpp"
#include "support/well_formed.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

using row = std::vector<std::string>;

/// The rows of a table by RFC 4180, quotes taken off.
std::vector<row> rows_of(const std::string& text) {
  std::vector<row> rows(1, row(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\r' && i + 1 < text.size() && text[i + 1] == '\n') {
      ++i;
      rows.emplace_back(1);
    } else {
      rows.back().back() += c;
    }
  }
  REQUIRE(rows.back() == row(1));  // the last line has its end, too
  rows.pop_back();
  return rows;
}

struct tables {
  std::vector<row> increments, pairs;
  std::vector<frame> frames;
};

/// Two runs of one problem: its tables, and its frames to compare with.
tables tables_of(const std::string& text) {
  const problem p = parse_problem(text, "pb.toml");
  const scratch_folder folder;
  output_file increments(folder.at("run.csv")), pairs(folder.at("run.pairs.csv"));
  auto leader = make_kernel("fortran");
  lockstep compared = make_lockstep(leader->facts(), std::vector<std::string>{"cpp"});
  run_csv csv(p, &compared, increments, &pairs);
  follow(p, structure_of(p), "refactor", *leader, {&compared, &csv});
  csv.finish();
  leader.reset();  // unit 26 is there only once
  return {rows_of(folder.read("run.csv")), rows_of(folder.read("run.pairs.csv")), a_run(text).kept.frames()};
}

double number(const std::string& field) {
  return std::strtod(field.c_str(), nullptr);
}

const std::string loaded_and_freed =
    std::string(good_problem) +
    "[[contact]]\nnode = 2\nsurface = \"above\"\nface = 0.001\nstiffness = 1e5\n"
    "[[step]]\npoint = [ { node = 3, w = 60.0 } ]\n";

}  // namespace

TEST_CASE("a field is quoted where a comma, a quote or a line end is in it") {
  CHECK(csv_field("plain words") == "plain words");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("say \"no\"") == "\"say \"\"no\"\"\"");
  CHECK(csv_field("two\nlines") == "\"two\nlines\"");
}

TEST_CASE("the table of increments has their numbers to the last digit, and their events") {
  const tables t = tables_of(loaded_and_freed);
  REQUIRE(t.increments.size() == t.frames.size());  // a heading, where the frames have the start
  CHECK(t.increments[0] == row{"step", "increment", "kind", "s", "share", "force", "events", "closed", "open",
                               "at_face", "smin", "kernels"});
  for (std::size_t i = 1; i < t.increments.size(); ++i) {
    const row& r = t.increments[i];
    INFO("row " << i);
    REQUIRE(r.size() == 12);
    CHECK(r[0] == std::to_string(t.frames[i].step));
    CHECK(r[1] == std::to_string(t.frames[i].number));
    CHECK(number(r[3]) == t.frames[i].s);
    CHECK(number(r[4]) == t.frames[i].fraction);
    CHECK(number(r[10]) == t.frames[i].s);
    CHECK(r[11] == "equal");
  }
  CHECK(t.increments[1][6] == "make 1");
  CHECK(number(t.increments[2][5]) == -60.0);
}

TEST_CASE("the table of pairs has each in every increment, as the frames have it") {
  const tables t = tables_of(loaded_and_freed);
  REQUIRE(t.pairs.size() == 1 + 2 * (t.frames.size() - 1));
  bool pressed = false;
  for (std::size_t i = 1; i < t.pairs.size(); ++i) {
    const row& r = t.pairs[i];
    const frame& f = t.frames[(i + 1) / 2];
    const std::size_t pair = (i + 1) % 2;
    INFO("row " << i);
    REQUIRE(r.size() == 10);
    CHECK(r[2] == std::to_string(pair + 1));
    CHECK(r[5] == (f.closed(pair) ? "contact" : "separated"));
    const double w = f.displacement[pair == 0 ? 4 : 2];
    // Exactly the state of a step's end; elsewhere the path's own D, which the frame's solution meets.
    if (f.step_end) CHECK(number(r[7]) == w);
    CHECK(number(r[7]) == Approx(w).margin(1e-14));
    pressed = pressed || number(r[9]) > 10;
  }
  CHECK(pressed);
}

TEST_CASE("a step that never moves has a row all the same") {
  const tables t = tables_of(with("fix = [\"w\", \"theta\"]", "fix = [\"w\"]"));
  REQUIRE(t.increments.size() == 2);
  CHECK(t.increments[1][2] == "end");
  CHECK(t.increments[1][3].empty());
  CHECK(t.increments[1][11].empty());
}

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
