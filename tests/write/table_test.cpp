// The run as tables; what a whole one looks like on the terminal is tested on the program itself (tests/app).
#include "contct/write/table.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "catch.hpp"
#include "contct/outside/registry.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/write/pictures.hpp"
#include "contct/write/run_result.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/scratch_folder.hpp"
#include "support/structures.hpp"

using namespace contct::app;
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
  lockstep_on_path compared(leader->facts(), std::vector<std::string>{"cpp"});
  const linear_structure s = structure_of(p);
  frame_keeper states(s, loads_of(p, s), false);
  states.solve_each();
  run_csv csv(p, &compared, states, 1, increments, &pairs);
  follow(p, s, "refactor", *leader, {&compared, &states, &csv});
  csv.finish();
  leader.reset();  // unit 26 is there only once
  return {rows_of(folder.read("run.csv")), rows_of(folder.read("run.pairs.csv")), a_run(text).kept.frames()};
}

double number(const std::string& field) {
  return std::strtod(field.c_str(), nullptr);
}

}  // namespace

TEST_CASE("a path that is lost before any call has a table, with the state that was found without it") {
  // Nothing holds the corner's slope in doubles.
  const problem p = parse_problem(
      "[plate]\nsize = [2, 2]\nelements = [2, 2]\nnu = 0\nD = 1\n[[support]]\nnode = 8\nspring = { wy = 1 }\n"
      "[[contact]]\nnode = 9\nsurface = \"below\"\nface = -1\nstiffness = 1\n"
      "[[step]]\npoint = [ { node = 9, wy = 0.84375 } ]\n",
      "pb.toml");
  const scratch_folder folder;
  output_file increments(folder.at("run.csv")), pairs(folder.at("run.pairs.csv"));
  const auto leader = make_kernel("corrected");
  const linear_structure s = structure_of(p);
  frame_keeper states(s, loads_of(p, s), true);
  states.solve_each();
  run_csv csv(p, nullptr, states, 1, increments, &pairs);
  certifier judged(p, s);
  const path_end end = follow(p, s, "refactor", *leader, {&judged, &states, &csv}, {0, judged.ends()});
  csv.finish();
  CHECK(end.status == path_status::solved);
  const std::vector<row> rows = rows_of(folder.read("run.csv"));
  REQUIRE(rows.size() == 2);
  CHECK(rows[1][10].empty());  // smin
  CHECK(rows[1][2] == "rescue");
  CHECK(rows_of(folder.read("run.pairs.csv")).size() == 2);
}

TEST_CASE("the terminal's width comes from COLUMNS, within reason, and a pipe has no colour") {
  setenv("COLUMNS", "120", 1);
  CHECK(look_at_terminal().width == 120);
  setenv("COLUMNS", "7", 1);
  CHECK(look_at_terminal().width == 40);
  setenv("COLUMNS", "wide", 1);
  CHECK(look_at_terminal().width == 80);
  unsetenv("COLUMNS");
  CHECK(painted({80, false}, paint::bad, "DIFFER") == "DIFFER");
  CHECK(painted({80, true}, paint::bad, "DIFFER") != "DIFFER");
}

TEST_CASE("a share takes nine columns at most, and is 1 only when it is") {
  CHECK(share_words(1.0) == "1");
  CHECK(share_words(0.25) == "0.25");
  CHECK(share_words(0.0789473684210526) == "0.0789474");
  CHECK(share_words(0.9999999) == "0.9999999");
  CHECK(share_words(0.99999999) == "1-1e-08");
  CHECK(share_words(1 - 1e-16) == "1-1e-16");
  for (const double x : {1.0 / 3, 1e-300 / 3, 0.99999994, 0.99999996, 1 - 4e-12, 2.0 / 3e5}) {
    INFO(x);
    CHECK(share_words(x).size() <= 9);
    CHECK(share_words(x) != "1");
  }
}

TEST_CASE("items are joined while they fit, and a long one goes on in the next line, between words") {
  using lines = std::vector<std::string>;
  CHECK(wrap({"one", "two", "three"}, 8) == lines{"one; two", "three"});
  CHECK(wrap({"one two three four", "five"}, 9) == lines{"one two", "three", "four", "five"});
  CHECK(wrap({"unbreakable word"}, 5) == lines{"unbreakable", "word"});
  CHECK(wrap({}, 5).empty());
}

TEST_CASE("a field is quoted where a comma, a quote or a line end is in it") {
  CHECK(csv_field("plain words") == "plain words");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("say \"no\"") == "\"say \"\"no\"\"\"");
  CHECK(csv_field("two\nlines") == "\"two\nlines\"");
  CHECK(csv_field("a\x1b[31m") == "a\\x1b[31m");
}

TEST_CASE("no text cell begins as a formula does, nor where blanks stand before it") {
  for (const std::string formula : {"=1+1", "+1", "-2.x", "@SUM(1)", "\t=1", "\r=1", " =1", "\n=1", "\uff1d1",
                                    "\uff0b1", "\uff0d1", "\uff20x"}) {
    const std::string field = csv_field(formula);
    INFO(field);
    CHECK((field.starts_with("'") || field.starts_with("\"'")));
  }
  for (const std::string plain : {"", "185.3", "1-2", "a=b", "x+", "'=1"}) CHECK(csv_field(plain) == plain);
}

TEST_CASE("the table of increments has their numbers to the last digit, and their events") {
  const tables t = tables_of(loaded_and_freed);
  REQUIRE(t.increments.size() == t.frames.size());  // a heading, where the frames have the start
  CHECK(t.increments[0] == row{"step", "increment", "kind", "s", "share", "force", "events", "closed", "open",
                               "at_face", "smin", "kernels", "node", "w"});
  for (std::size_t i = 1; i < t.increments.size(); ++i) {
    const row& r = t.increments[i];
    INFO("row " << i);
    REQUIRE(r.size() == 14);
    CHECK(r[0] == std::to_string(t.frames[i].step));
    CHECK(r[1] == std::to_string(t.frames[i].number));
    CHECK(number(r[3]) == t.frames[i].s);
    CHECK(number(r[4]) == t.frames[i].fraction);
    CHECK(number(r[10]) == t.frames[i].s);
    CHECK(r[11] == "equal");
    CHECK(r[12] == "2");
    CHECK(number(r[13]) == t.frames[i].displacement[2]);
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

TEST_CASE("tables of structures from elsewhere name dofs by their labels, with coordinates or without") {
  for (const auto& text : {portal_frame(), frame_without_coordinates()}) {
    const problem p = parse_problem(text, "p.toml", reach::anywhere);
    const scratch_folder folder;
    output_file increments(folder.at("mesh.csv"));
    output_file pairs(folder.at("mesh.pairs.csv"));
    auto leader = make_kernel("cpp");
    const linear_structure s = structure_of(p);
    frame_keeper states(s, loads_of(p, s), false);
    states.solve_each();
    run_csv csv(p, nullptr, states, 0, increments, &pairs);
    follow(p, s, "refactor", *leader, {&states, &csv});
    csv.finish();
    const std::string table = folder.read("mesh.pairs.csv");
    CHECK_THAT(table, Contains("\r\n1,1,1,6.y,below,contact,") && Contains("\r\n3,3,2,8.x,above,separated,"));
  }
}

TEST_CASE("labels that are no plain words are quoted fields in tables") {
  const scratch_folder folder;
  const std::string matrix =
      folder.write("odd.mtx", "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 2\n");
  const std::string dofs = folder.write("odd.dof", "<b>,\"&.x\n");
  const a_run r("[matrix]\nstiffness = \"" + matrix + "\"\ndofs = \"" + dofs +
                "\"\n[[contact]]\ndof = '<b>,\"&.x'\nsurface = "
                "\"below\"\nface = 0\nstiffness = 1\n[[step]]\n"
                "point = [ { dof = '<b>,\"&.x', value = -1 } ]\n");
  CHECK(csv_field(place_name(r.what.geometry, 0)) == "\"<b>,\"\"&.x\"");
}

namespace {

/// What a table without kernels beside prints of a path.
std::string printed_rows(const std::string& text) {
  const problem p = parse_problem(text, "pb.toml");
  const linear_structure s = structure_of(p);
  certifier judged(p, s);
  const scratch_folder folder;
  (void)std::fflush(stdout);
  const int kept = dup(STDOUT_FILENO);
  std::FILE* const file = std::fopen(folder.at("out").c_str(), "w");
  dup2(fileno(file), STDOUT_FILENO);
  table rows(p, nullptr, judged, {100, false}, false);
  (void)follow(p, s, "refactor", *make_kernel("fortran"), {&judged, &rows});
  (void)std::fflush(stdout);
  dup2(kept, STDOUT_FILENO);
  close(kept);
  (void)std::fclose(file);
  return folder.read("out");
}

/// A beam of so many elements that lies on springs, pressed at its middle.
std::string lying_beam(int elements) {
  return "[beam]\nlength = 10.0\nelements = " + std::to_string(elements) +
         "\nEI = 1.0\n[[contact]]\nnodes = \"all\"\nsurface = \"below\"\nface = 0\nstiffness = 1e3\n"
         "[[step]]\npoint = [ { node = " +
         std::to_string(elements / 2 + 1) + ", w = -1.0 } ]\n";
}

}  // namespace

TEST_CASE("many pairs that open as the load begins to act share one row, and a few are named in theirs") {
  const std::string many = printed_rows(lying_beam(40));
  CHECK_THAT(many, Contains(" at first load"));
  const std::string few = printed_rows(lying_beam(3));
  CHECK_THAT(few, Contains("break 4: node 4 below") && !Contains(" at first load"));
}

TEST_CASE("the column of kernels is explained where there is one, and not where one kernel runs alone") {
  const auto legend_of = [](bool beside) {
    const a_run r(good_problem);
    table rows(r.what, beside ? &r.compared : nullptr, r.judged, {100, false}, false);
    rows.incremented({1, 1, 1.0, 1.0, {}});
    std::string all;
    for (const std::string& words : rows.legend()) all += words + "\n";
    return all;
  };
  CHECK_THAT(legend_of(true), Contains("kernels: whether their bits are equal"));
  CHECK_THAT(legend_of(false), !Contains("kernels:") && Contains("share:"));
}
