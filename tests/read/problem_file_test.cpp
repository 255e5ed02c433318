#include "contct/read/problem_file.hpp"

#include "catch.hpp"
#include "contct/kernel/call.hpp"
#include "read/bad_inputs.hpp"
#include "read/good_problem.hpp"

using namespace contct;

namespace {

std::string message_of_text(const std::string& text) {
  return verdict([&] { (void)parse_problem(text, "pb.toml"); });
}

const beam& beam_of(const problem& p) {
  return std::get<beam>(p.geometry.kind);
}

}  // namespace

TEST_CASE("parse_problem accepts a correct problem") {
  const problem p = parse_problem(good_problem, "pb.toml");
  CHECK(beam_of(p).x == std::vector<double>{0, 1, 2});
  CHECK(beam_of(p).EI == std::vector<double>{1e4, 1e4});
  REQUIRE(p.supports.size() == 2);
  CHECK(p.supports[1].dof == 1);
  REQUIRE(p.pairs.size() == 1);
  CHECK(p.pairs[0].node == 2);
  CHECK(p.pairs[0].surface == face_below);
  CHECK_FALSE(p.pairs[0].closed);
  REQUIRE(p.steps.size() == 1);
  CHECK(p.steps[0].points[0].value == -60.0);
  CHECK(p.warnings.empty());
}

TEST_CASE("a bad input of any kind is refused with place, key, what was found and what is allowed") {
  const auto kinds = bad_inputs();
  REQUIRE(kinds.size() >= 120);
  for (const bad_input& kind : kinds) {
    const std::string message = message_of_text(kind.text);
    INFO(kind.what << "\n" << message);
    CHECK_THAT(message, Catch::Matchers::StartsWith("pb.toml:" + std::string(kind.place)));
    CHECK_THAT(message, Catch::Matchers::Contains(kind.key));
    CHECK_THAT(message, Catch::Matchers::Contains(kind.found));
    CHECK_THAT(message, Catch::Matchers::Contains(kind.allowed));
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("a pair with a face at 0 is in contact before any load, unless its state is given as separated") {
  const auto state = [](const std::string& lines) {
    return parse_problem(with("face = -0.004\n", lines), "pb.toml").pairs[0].closed;
  };
  CHECK(state("face = 0\n"));
  CHECK(state("face = 0.0\nstate = \"contact\"\n"));
  CHECK_FALSE(state("face = 0.0\nstate = \"separated\"\n"));
  CHECK_FALSE(state("face = -1e-12\n"));
}

TEST_CASE("a bed has a pair at each free node, with the stiffness modulus times tributary length") {
  const std::string head = "[beam]\nx = [0, 1, 3]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\"]\n";
  const std::string tail = "[[step]]\nuniform = -1\n";
  const problem whole = parse_problem(head + "[[bed]]\nmodulus = 4\nface = 0\n" + tail, "pb.toml");
  REQUIRE(whole.pairs.size() == 2);  // node 1 is fixed
  CHECK(whole.pairs[0].node == 1);
  CHECK(whole.pairs[0].stiffness == 6.0);
  CHECK(whole.pairs[1].stiffness == 4.0);
  CHECK(whole.pairs[0].closed);
  const problem part = parse_problem(
      head + "[[bed]]\nmodulus = 4\nsurface = \"above\"\nface = 0.5\nnodes = [3]\n" + tail, "pb.toml");
  REQUIRE(part.pairs.size() == 1);
  CHECK(part.pairs[0].stiffness == 4.0);
  CHECK(part.pairs[0].surface == face_above);
  CHECK_FALSE(part.pairs[0].closed);
}

TEST_CASE("pairs of contact tables come before pairs of bed tables, and both are in the order of the file") {
  const problem p =
      parse_problem(with("[[step]]",
                         "[[bed]]\nmodulus = 1\nface = 0\n[[contact]]\nnode = 2\nsurface = \"above\"\n"
                         "face = 1\nstiffness = 2\n[[step]]"),
                    "pb.toml");
  REQUIRE(p.pairs.size() == 4);
  CHECK(p.pairs[1].node == 1);
  CHECK(p.pairs[1].surface == face_above);
  CHECK(p.pairs[2].node == 1);
}

TEST_CASE(
    "distributed loads on the same elements are added, and a list of all elements is the same as no list") {
  const problem p = parse_problem(
      with("point = [ { node = 3, w = -60.0 } ]",
           "uniform = [ { value = -3, elements = [2] }, { value = -1 }, { polynomial = [1, 2], elements = "
           "\"2..2\" }, { value = -4, elements = \"all\" }, { value = 0.5, elements = [2, 1] } ]"),
      "pb.toml");
  const load& l = p.steps[0];
  REQUIRE(l.distributed.size() == 2);
  CHECK(l.distributed[0].elements == std::vector<int>{1});
  CHECK(l.distributed[0].polynomial == std::vector<double>{-2, 2});
  CHECK(l.distributed[1].elements.empty());
  CHECK(l.distributed[1].polynomial == std::vector<double>{-4.5});
}

TEST_CASE("a pair at a fixed dof is accepted, with a warning that the 1989 rule may change its status") {
  const problem p = parse_problem(with("node = 3\nsurface", "node = 1\nsurface"), "pb.toml");
  REQUIRE(p.warnings.size() == 1);
  CHECK_THAT(p.warnings[0], Catch::Matchers::StartsWith("pb.toml:7: contact[1]: node 1 is fixed in w"));
}

TEST_CASE("a binary file, a deeply nested file and an empty file are refused with a message") {
  for (const std::string& text : {std::string("\x7f"
                                              "ELF\x02\x01\x01\x00\x00\x00\x00",
                                              11),
                                  std::string(200000, '['), "x = " + std::string(100000, '['), std::string(),
                                  std::string("\xff\xfe"), std::string(1000, '\0'), [] {
                                    std::string dotted = "a";
                                    for (int i = 0; i < 300000; ++i) dotted += ".a";
                                    return dotted + " = 1\n";
                                  }()}) {
    CHECK(message_of_text(text) != "accepted");
  }
}

TEST_CASE("a plate is read with grid lines, a D from E, nu and thickness, and loads on every dof") {
  const problem p = parse_problem(good_plate, "pb.toml");
  const auto& it = std::get<plate>(p.geometry.kind);
  CHECK(it.x == std::vector<double>{0, 0.5, 1});
  CHECK(it.y == std::vector<double>{0, 1});
  CHECK(it.D == Approx(1.0).epsilon(1e-15));
  CHECK(it.nu == 0.3);
  REQUIRE(p.supports.size() == 6);
  CHECK(p.supports[5].node == 3);
  CHECK(p.supports[5].dof == 2);
  REQUIRE(p.pairs.size() == 1);
  CHECK(p.pairs[0].node == 5);
  REQUIRE(p.steps.size() == 1);
  const load& l = p.steps[0];
  REQUIRE(l.distributed.size() == 2);
  CHECK(l.distributed[1].elements == std::vector<int>{1});
  REQUIRE(l.points.size() == 3);
  CHECK(l.points[1].dof == 1);
  CHECK(l.points[2].node == 5);
  CHECK(l.points[2].dof == 2);
  CHECK(l.points[2].value == -0.5);
}

TEST_CASE("a plate may have a size and a D, springs on every dof, and any nu from -0.999 to 0.5") {
  const problem p = parse_problem(
      "[plate]\nsize = [3, 1]\nelements = [3, 2]\nD = 2\nnu = 0.5\n[[support]]\nnode = 12\n"
      "spring = { w = 1, wx = 2, wy = 3 }\n[[step]]\nuniform = 0\n",
      "pb.toml");
  const auto& it = std::get<plate>(p.geometry.kind);
  CHECK(it.x == std::vector<double>{0, 1, 2, 3});
  CHECK(it.y == std::vector<double>{0, 0.5, 1});
  CHECK(it.D == 2.0);
  REQUIRE(p.supports.size() == 3);
  CHECK(p.supports[2].spring == 3.0);
  CHECK(message_of_text(plate_with("0.3", "-0.999")) == "accepted");
  CHECK(message_of_text(plate_with("0.3", "0")) == "accepted");
}

TEST_CASE(
    "a bed under a plate has a pair at each free node, with the stiffness modulus times tributary area") {
  const std::string head =
      "[plate]\nx = [0, 1, 3]\ny = [0, 2]\nD = 1\nnu = 0\n[[support]]\nnode = 4\nfix = [\"w\"]\n"
      "[[support]]\nnode = 5\nfix = [\"wx\", \"wy\"]\n";
  const std::string tail = "[[step]]\nuniform = -1\n";
  const problem whole = parse_problem(head + "[[bed]]\nmodulus = 4\nface = 0\n" + tail, "pb.toml");
  REQUIRE(whole.pairs.size() == 5);  // node 4 is fixed, node 5 only in its slopes
  const std::vector<double> expected = {2, 6, 4, 6, 4};
  for (std::size_t i = 0; i < 5; ++i) CHECK(whole.pairs[i].stiffness == expected[i]);
  CHECK(whole.pairs[3].node == 4);
}

TEST_CASE("a polynomial face below 0 is accepted, even if its terms add up to a positive number in doubles") {
  const problem p = parse_problem(
      "[beam]\nx = [0, 1.1, 2.2]\nEI = 1e4\n[[support]]\nnodes = [1, 3]\nfix = [\"w\"]\n[[bed]]\nmodulus = "
      "1\n"
      "face = { polynomial = [-0.001, -1.21e30, 0, 1e30] }\n[[step]]\nuniform = -1\n",
      "far.toml");
  REQUIRE(p.pairs.size() == 1);
  CHECK(p.pairs[0].face == -0.001);
}

TEST_CASE("a file may have labels for the units of length and force, which are empty by default") {
  CHECK(parse_problem(good_problem, "pb.toml").units.length.empty());
  const problem p =
      parse_problem("[units]\nlength = \"m\"\nforce = \"kN\"\n" + std::string(good_problem), "pb.toml");
  CHECK(p.units.length == "m");
  CHECK(p.units.force == "kN");
}

TEST_CASE("a single fixed dof of a support may be given without brackets") {
  const problem p = parse_problem(with("[\"w\", \"theta\"]", "\"theta\""), "pb.toml");
  REQUIRE(p.supports.size() == 1);
  CHECK(p.supports[0].dof == 1);
}

TEST_CASE("one contact table makes a pair at each node that it lists, in the order of the list") {
  const auto pairs_of = [](const std::string& lines) {
    return parse_problem(with("node = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5.0e4\n",
                              "surface = \"below\"\n" + lines),
                         "pb.toml")
        .pairs;
  };
  const auto own = pairs_of("x = [2.0, 1.0]\nface = [-0.25, 0]\nstiffness = [3, 4]\n");
  REQUIRE(own.size() == 2);
  CHECK((own[0].node == 2 && own[0].face == -0.25 && own[0].stiffness == 3 && !own[0].closed));
  CHECK((own[1].node == 1 && own[1].face == 0 && own[1].stiffness == 4 && own[1].closed));
  const auto common = pairs_of("nodes = \"2..3\"\nface = 0\nstiffness = 7\nstate = \"separated\"\n");
  REQUIRE(common.size() == 2);
  for (const contact_pair& pair : common) CHECK((pair.face == 0 && pair.stiffness == 7 && !pair.closed));
}

TEST_CASE("the face of a bed is one number, one number for each node, or a polynomial in x") {
  const std::string head =
      "[beam]\nx = [0, 1, 3]\nEI = 1\n[[support]]\nnode = 1\nfix = \"w\"\n[[bed]]\nmodulus = 2\n";
  const auto bed_of = [&](const std::string& lines) {
    return parse_problem(head + lines + "[[step]]\nuniform = -1\n", "pb.toml");
  };
  const problem each = bed_of("face = [9, -0.5, 0]\n");  // the face of the fixed node is unused
  REQUIRE(each.pairs.size() == 2);
  CHECK((each.pairs[0].face == -0.5 && !each.pairs[0].closed));
  CHECK((each.pairs[1].face == 0 && each.pairs[1].closed));
  const problem curved = bed_of("face = { polynomial = [-1, 0, -2] }\n");
  CHECK((curved.pairs[0].face == -3 && curved.pairs[1].face == -19));
  CHECK(bed_of("face = [-4]\nx = 3\n").pairs.at(0).face == -4);
}

TEST_CASE("a bed that was read has its modulus, its first pair and the tributary length of each pair") {
  const problem p = parse_problem(
      "[beam]\nx = [0, 1, 3]\nEI = 1\n[[support]]\nnode = 1\nfix = \"w\"\n[[contact]]\nnode = 3\nsurface = "
      "\"above\"\nface = 1\nstiffness = 1\n[[bed]]\nmodulus = 4\nface = 0\n[[bed]]\nmodulus = 8\nface = "
      "-1\nnodes = [3]\n[[step]]\nuniform = -1\n",
      "pb.toml");
  REQUIRE(p.beds.size() == 2);
  CHECK(p.beds[0].modulus == 4);
  CHECK(p.beds[0].first_pair == 1);
  CHECK(p.beds[0].share == std::vector<double>{1.5, 1});
  CHECK(p.beds[1].first_pair == 3);
  CHECK(p.beds[1].share == std::vector<double>{1});
  CHECK(p.pairs[2].stiffness == 4);
}

TEST_CASE("for each bed whose mesh is too coarse there is one warning, which suggests an element_size") {
  const auto warnings_of = [](const std::string& mesh, const std::string& beds) {
    return parse_problem("[beam]\nlength = 8\n" + mesh + "\n" + beds + "[[step]]\nuniform = -1\n", "pb.toml")
        .warnings;
  };
  // Elements may be at most 1 long: half of (4 EI / modulus)^(1/4) = 2.
  const std::string bed = "[[bed]]\nmodulus = 1\nface = 0\n";
  CHECK(warnings_of("elements = 8\nEI = 4", bed).empty());
  const auto coarse =
      warnings_of("elements = 4\nEI = [1e3, 4, 3, 1e3]", bed + "state = \"separated\"\n" + bed);
  REQUIRE(coarse.size() == 2);
  CHECK_THAT(coarse[0], Catch::Matchers::StartsWith("pb.toml:5: bed[1]: the mesh is coarse"));
  CHECK_THAT(coarse[0], Catch::Matchers::Contains("nodes 3 and 4 are 2 apart; allowed: 0.93, half of (4 EI / "
                                                  "modulus)^(1/4); set element_size = 0.93 in [beam]"));
  CHECK_THAT(coarse[1], Catch::Matchers::Contains("bed[2]"));
  CHECK(warnings_of("element_size = 0.93\nEI = 3", bed).empty());
  // Only elements between two neighbouring nodes of the bed count.
  CHECK(warnings_of("elements = 4\nEI = 4", bed + "nodes = [1, 3]\n").empty());
  CHECK(warnings_of("elements = 4\nEI = 4", bed + "nodes = [1, 2]\n").size() == 1);
}
