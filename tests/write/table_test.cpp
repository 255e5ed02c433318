// Tests the tables of a run. tests/app tests whole runs of the program.
#include <fmt/format.h>

#include <cstdlib>

#include "catch.hpp"
#include "contct/session/step_results.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/words.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

using row = std::vector<std::string>;

/// Returns the rows of a table by RFC 4180, without quotes.
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
  REQUIRE(rows.back() == row(1));  // the last line has a line end
  rows.pop_back();
  return rows;
}

struct tables {
  std::vector<row> increments, pairs;
  std::vector<structure_state> states;  // expected states
};

/// Returns the tables, with the deflection of the second node.
tables tables_of(const a_run& r) {
  std::string increments;
  std::string pairs;
  output_file to(&increments);
  output_file of_pairs(&pairs);
  write_csv(r.result, 1, to, &of_pairs);
  return {rows_of(increments), rows_of(pairs), pictures_of(r.result)};
}

double number(const std::string& field) {
  return std::strtod(field.c_str(), nullptr);
}

}  // namespace

TEST_CASE("if a path is lost before any call, the CSV table has the state of the reference solution") {
  // The stiffness of the slope at the corner is 0 in doubles.
  const a_run r(
      "[plate]\nsize = [2, 2]\nelements = [2, 2]\nnu = 0\nD = 1\n[[support]]\nnode = 8\nspring = { wy = 1 }\n"
      "[[contact]]\nnode = 9\nsurface = \"below\"\nface = -1\nstiffness = 1\n"
      "[[step]]\npoint = [ { node = 9, wy = 0.84375 } ]\n",
      "corrected");
  CHECK(r.result.end.status == path_status::solved);
  const tables t = tables_of(r);
  REQUIRE(t.increments.size() == 2);
  CHECK(t.increments[1][10].empty());  // smin
  CHECK(t.increments[1][2] == "rescue");
  CHECK(t.pairs.size() == 2);
}

TEST_CASE("a share of the step takes at most nine characters, and is printed as 1 only if it is exactly 1") {
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

TEST_CASE("a CSV field is quoted if it has a comma, a quote or a line end") {
  CHECK(csv_field("plain words") == "plain words");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("say \"no\"") == "\"say \"\"no\"\"\"");
  CHECK(csv_field("two\nlines") == "\"two\nlines\"");
  CHECK(csv_field("a\x1b[31m") == "a\\x1b[31m");
}

TEST_CASE("no text field of a CSV file begins like a formula of a spreadsheet, even after leading blanks") {
  for (const std::string formula : {"=1+1", "+1", "-2.x", "@SUM(1)", "\t=1", "\r=1", " =1", "\n=1", "\uff1d1",
                                    "\uff0b1", "\uff0d1", "\uff20x"}) {
    const std::string field = csv_field(formula);
    INFO(field);
    CHECK((field.starts_with("'") || field.starts_with("\"'")));
  }
  for (const std::string plain : {"", "185.3", "1-2", "a=b", "x+", "'=1"}) CHECK(csv_field(plain) == plain);
}

TEST_CASE("the CSV table of increments has the numbers of the states to the last digit, and the events") {
  const tables t = tables_of(a_run(loaded_and_freed));
  // The table has a heading row, and the states include the start.
  REQUIRE(t.increments.size() == t.states.size());
  CHECK(t.increments[0] == row{"step", "increment", "kind", "s", "share", "force", "events", "closed", "open",
                               "at_face", "smin", "kernels", "node", "w", "name"});
  for (std::size_t i = 1; i < t.increments.size(); ++i) {
    const row& r = t.increments[i];
    INFO("row " << i);
    REQUIRE(r.size() == 15);
    CHECK(r[0] == std::to_string(t.states[i].step));
    CHECK(r[1] == std::to_string(t.states[i].number));
    CHECK(number(r[3]) == number(r[10]));
    CHECK(number(r[4]) == t.states[i].fraction);
    CHECK(r[11] == "equal");
    CHECK(r[12] == "2");
    CHECK(number(r[13]) == t.states[i].displacement[2]);
  }
  CHECK(t.increments[1][6] == "make 1");
  CHECK(number(t.increments[2][5]) == -60.0);
}

TEST_CASE(
    "the CSV table of pairs has a row for each pair in each increment, with the numbers of the states") {
  const tables t = tables_of(a_run(loaded_and_freed));
  REQUIRE(t.pairs.size() == 1 + 2 * (t.states.size() - 1));
  bool pressed = false;
  for (std::size_t i = 1; i < t.pairs.size(); ++i) {
    const row& r = t.pairs[i];
    const structure_state& f = t.states[(i + 1) / 2];
    const std::size_t pair = (i + 1) % 2;
    INFO("row " << i);
    REQUIRE(r.size() == 11);
    CHECK(r[2] == std::to_string(pair + 1));
    CHECK(r[5] == (f.closed(pair) ? "contact" : "separated"));
    const double w = f.displacement[pair == 0 ? 4 : 2];
    // Within a step the table has D of the path, which equals the separately solved state.
    CHECK(number(r[7]) == Approx(w).margin(1e-14));
    pressed = pressed || number(r[9]) > 10;
  }
  CHECK(pressed);
}

TEST_CASE("a step without movement has a row in the CSV table of increments") {
  const tables t = tables_of(a_run(with("fix = [\"w\", \"theta\"]", "fix = [\"w\"]")));
  REQUIRE(t.increments.size() == 2);
  CHECK(t.increments[1][2] == "end");
  CHECK(t.increments[1][3].empty());
  CHECK(t.increments[1][11].empty());
}

TEST_CASE("the CSV table of pairs of a matrix names dofs by labels, with or without coordinates") {
  for (const auto& text : {portal_frame(), frame_without_coordinates()}) {
    std::string increments;
    std::string pairs;
    output_file to(&increments);
    output_file of_pairs(&pairs);
    write_csv(a_run(text, "cpp").result, 0, to, &of_pairs);
    CHECK_THAT(pairs, Contains("\r\n1,1,1,6.y,below,contact,") && Contains("\r\n3,3,2,8.x,above,separated,"));
  }
}

namespace {

/// Returns a beam with this number of elements on springs, pressed at its middle.
std::string lying_beam(int elements) {
  return "[beam]\nlength = 10.0\nelements = " + std::to_string(elements) +
         "\nEI = 1.0\n[[contact]]\nnodes = \"all\"\nsurface = \"below\"\nface = 0\nstiffness = 1e3\n"
         "[[step]]\npoint = [ { node = " +
         std::to_string(elements / 2 + 1) + ", w = -1.0 } ]\n";
}

run_table rows_for(const std::string& text, const std::string& leads = "fortran") {
  return table_of(a_run(text, leads).result, {100, false}, false);
}

}  // namespace

TEST_CASE(
    "many pairs that separate at the start of the load have one printed row in common, and a few have one "
    "row each") {
  CHECK_THAT(rows_for(lying_beam(40)).text, Contains(" at first load"));
  CHECK_THAT(rows_for(lying_beam(3)).text, Contains("break 4: node 4 below") && !Contains(" at first load"));
}

TEST_CASE("if several kernels run, the legend of the printed table explains the column of kernels") {
  const auto legend_of = [](const std::string& leads) {
    std::string all;
    for (const std::string& words : rows_for(good_problem, leads).legend) all += words + "\n";
    return all;
  };
  CHECK_THAT(legend_of("fortran"), Contains("kernels: whether their bits are equal"));
  CHECK_THAT(legend_of("cpp"), !Contains("kernels:") && Contains("share:"));
}

TEST_CASE(
    "In the printed table, the largest values have units, and are not aligned if the terminal is narrow") {
  const a_run r("[units]\nlength = \"m\"\nforce = \"kN\"\n" + std::string(good_problem));
  CHECK_THAT(table_of(r.result, {100, false}, false).text,
             Contains("moment        -36.2791 kN m     node 1, x = 0\n"));
  CHECK_THAT(table_of(r.result, {44, false}, false).text, Contains("moment -36.2791 kN m, node 1, x = 0\n"));
}

TEST_CASE("The printed table gives the new position of each face that moved, below the end of the step") {
  const std::string text =
      table_of(
          a_run("[beam]\nlength = 2\nelements = 2\nEI = 1e4\n[[support]]\nnode = 1\nfix = [\"w\", "
                "\"theta\"]\n[[contact]]\nnodes = [2, 3]\nsurface = \"below\"\nface = -1\nstiffness = 1e5\n"
                "[[step]]\nuniform = -1\n[[step]]\nmove = [ { node = 3, w = 0.25 } ]\n")
              .result,
          {80, false}, false)
          .text;
  const std::string line = "moved face    -0.75             pair 2, node 3 below\n";
  CHECK_THAT(text, Contains(line));
  CHECK(text.find("moved face") == text.find(line));
  CHECK(text.find("   2.1  ") < text.find(line));
}

TEST_CASE("The detailed printed tables have every pair, reaction and end of an element, within 80 columns") {
  const std::string text = table_of(a_run(good_problem).result, {80, false}, true).text;
  CHECK_THAT(text, Contains("       1          3  below    contact                 0       41.86047 2\n"));
  CHECK_THAT(text, Contains("               node  dof                       reaction x\n"));
  CHECK_THAT(text, Contains("w                         18.13953"));
  CHECK_THAT(text, Contains("theta                     36.27907"));
  CHECK_THAT(text, Contains("       2  x                      1              2\n          shear"));
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    CHECK(end - at <= 80);
}

TEST_CASE("a value is printed as 0, without a place, only if it is 0, however large earlier values were") {
  const std::string text =
      rows_for(std::string(propped_cantilever) + "[[step]]\nuniform = -8e-15\n[[step]]\nuniform = 0\n",
               "corrected")
          .text;
  CHECK_THAT(text, Contains("        moment        -4e-15            node 1, x = 0\n") &&
                       Contains("        reaction      1e-14             node 1\n") &&
                       Contains("        moment        0\n") && Contains("        reaction      0\n"));
}

TEST_CASE("the printed table has the reactions of both signs with their supports, also of all combinations") {
  CHECK_THAT(rows_for(loaded_span).text, Contains("        reaction      75                node 7\n"
                                                  "        and           -7.5              node 13\n"));
  std::string cases = loaded_span +
                      "[[combination]]\nname = \"A\"\nterms = { G = 1 }\n"
                      "[[combination]]\nname = \"B\"\nterms = { G = 2 }\n";
  cases.replace(cases.find("[[step]]"), 8, "[[case]]\nname = \"G\"");
  CHECK_THAT(rows_for(cases).text,
             Contains("least reaction    -15                 node 13, x = 12        B\n") &&
                 Contains("largest reaction  150                 node 7, x = 6          B\n"));
  cases += "[[contact]]\nx = 3\nsurface = \"below\"\nface = 0\nstiffness = 1e5\n";
  CHECK_THAT(rows_for(cases).text, Contains(" pair 1, node 4, x = 3"));
}

TEST_CASE(
    "the statuses and counts of pairs are the same in the table, in JSON and in CSV, however a step ends") {
  const std::string one_pair =
      "[beam]\nlength = 1\nelements = 1\nEI = 1\n[[support]]\nnode = 1\nfix = \"w\"\n[[contact]]\nnode = 2\n"
      "surface = \"below\"\nface = 0\nstiffness = 10\n[[step]]\npoint = [ { node = 2, w = -1 } ]\n";
  const std::string lifted = one_pair + "[[step]]\npoint = [ { node = 2, w = 1 } ]\n";
  const std::string two_pairs =
      "[beam]\nx = [0, 1, 2]\nEI = 100\n[[contact]]\nnodes = [1, 3]\nsurface = \"below\"\nface = 0\n"
      "stiffness = 10\n[[step]]\nuniform = -1\n[[step]]\npoint = [ { node = 3, w = 1 } ]\n";
  const std::pair<std::string, std::string> examples[] = {
      {one_pair, "1 of 1"}, {lifted, "0 of 1"}, {two_pairs, "1 of 2"}, {loaded_and_freed, "1 of 2"}};
  int compared = 0;
  for (const auto& [text, count] : examples) {
    for (const std::string leads : {"fortran", "corrected"}) {
      const a_run r(text, leads);
      CAPTURE(text, leads);
      const std::string printed = table_of(r.result, {100, false}, false).text;
      const std::size_t last = printed.rfind("   end  ");
      CHECK(printed.substr(last + 8, count.size()) == count);
      const tables t = tables_of(r);
      const auto pairs = static_cast<std::ptrdiff_t>(r.what.pairs.size());
      std::ptrdiff_t in_csv = 0;
      for (auto of = t.pairs.end() - pairs; of != t.pairs.end(); ++of)
        in_csv += (*of)[5] == "contact" ? 1 : 0;
      CHECK(fmt::format("{} of {}", in_csv, pairs) == count);
      const structure_state& end = r.result.record.steps.back().end;
      CHECK(fmt::format("{} of {}", end.pairs_in_contact(), pairs) == count);
      ++compared;
    }
  }
  CHECK(compared == 8);
}

TEST_CASE(
    "more than 12 combinations are printed as one row each with a name, and then their largest values") {
  const std::string train =
      "[beam]\nlength = 24\nelements = 24\nEI = 1e4\n[[support]]\nx = [0, 24]\nfix = \"w\"\n"
      "[[train]]\nname = \"HL-93\"\naxles = [ { at = 0, w = -10 } ]\nfrom = 0\nto = 24\nby = ";
  const std::string many = table_of(a_run(train + "1\n").result, terminal{}, false).text;
  CHECK_THAT(many, Contains("\nHL-93 at 7      1        0  moment 49.5833"));  // 10 * 7 * 17 / 24
  CHECK_THAT(many, !Contains("incr  share"));
  CHECK_THAT(
      many,
      Contains("largest moment    60                  node 13, x = 12        HL-93 at 12\n"));  // P L / 4
  const std::string few = table_of(a_run(train + "8\n").result, terminal{}, false).text;
  CHECK_THAT(few, Contains("   2.1  1"));
  CHECK_THAT(few, Contains("end  HL-93 at 8;"));
}

TEST_CASE("the last column of the CSV table of increments has the name of the step") {
  std::string text;
  output_file out(&text);
  write_csv(a_run("[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
                  "[[step]]\nname = \"dead, live\"\npoint = [ { node = 2, w = 3 } ]\n")
                .result,
            1, out, nullptr);
  CHECK(rows_of(text).at(0).back() == "name");
  CHECK(rows_of(text).at(1).back() == "dead, live");
}

TEST_CASE(
    "for more than six steps, a table of extremes is printed for each quantity, with one row for each step") {
  std::string text = propped_cantilever;
  for (int step = 2; step <= 7; ++step) text += "[[step]]\nuniform = -" + std::to_string(8 * step) + "\n";
  const std::string shown = rows_for(text).text;
  CHECK_THAT(shown, !Contains("sums"));
  // 9 q L^2 / 128 and q L^2 / 8, q = 56
  CHECK_THAT(shown,
             Contains("\nmoment           least  at                             largest  at\n") &&
                 Contains("step 7             -28  node 1, x = 0                    15.75  x = 1.25\n"));
}

TEST_CASE("in the printed table of a matrix, a value has a unit if its dof is known to be a length") {
  const a_run r(portal_frame() + "[units]\nlength = \"m\"\nforce = \"N\"\n", "cpp");
  const std::string shown = table_of(r.result, {100, false}, false).text;
  CHECK_THAT(shown, Contains("-0.00123118 m     dof 6.y") &&
                        Contains("11558.9 N         pair 1, dof 6.y below\n") &&
                        Contains("4220.57 N         dof 1.y\n"));
  problem p = parse_problem(frame_without_coordinates(), "frame.toml", reach::anywhere);
  p.units = {"m", "N"};
  CHECK(unit_words(p, "force", 0).empty());
  CHECK(unit_words(p, "w", p.pairs[0].node) == " m");
  problem placed = parse_problem(portal_frame(), "frame.toml", reach::anywhere);
  placed.units = {"m", "N"};
  CHECK(unit_words(placed, "force", 2) == " N m");  // 1.r
  CHECK(unit_words(placed, "w", 2).empty());
}

TEST_CASE("the printed sums of forces have units, and are 0 if they are only rounding") {
  // The reactions of the second step, up to 0.45 kN, cancel.
  const a_run r(read_problem(CONTCT_REFERENCE "/problems/pp06-plate-over-settling-line.toml"), "corrected");
  const std::string shown = table_of(r.result, {100, false}, false).text;
  CHECK_THAT(shown, Contains("sums          loads 0 kN, reactions -4.16988 kN, contact 4.16988 kN\n") &&
                        Contains("sums          loads 0 kN, reactions 0 kN, contact 0 kN\n"));
}
