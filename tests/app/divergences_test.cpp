// Tests the numbers that reference/DIVERGENCES.md gives for its problem files.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using json = nlohmann::json;

namespace {

std::string file_text(const char* name) {
  std::ostringstream text;
  text << std::ifstream(root / "reference" / name).rdbuf();
  return text.str();
}

/// Returns the page's text from a heading to the next heading.
std::string section(const std::string& heading) {
  const std::string page = file_text("DIVERGENCES.md");
  const std::size_t from = page.find("\n### " + heading);
  REQUIRE(from != std::string::npos);
  return page.substr(from, page.find("\n#", from + 5) - from);
}

/// Checks that the section contains this number, and that the measured value rounds to it.
void says(const std::string& text, const std::string& number, double measured) {
  INFO(number << " is said, " << measured << " measured, in" << text);
  CHECK(text.find(number) != std::string::npos);
  const std::size_t exponent = number.find('e');
  const std::size_t point = number.find('.');
  const std::string digits = number.substr(0, exponent);
  double unit = exponent == std::string::npos ? 1.0 : std::pow(10.0, std::stoi(number.substr(exponent + 1)));
  if (point != std::string::npos) unit *= std::pow(10.0, -static_cast<double>(digits.size() - point - 1));
  CHECK(std::abs(std::strtod(number.c_str(), nullptr) - measured) <= 0.51 * unit);
}

/// Runs a problem of reference/problems/divergences with one kernel.
json run(const std::string& file, const char* kernel, int exit) {
  const scratch_folder dir;
  const std::string problem = (root / "reference/problems/divergences" / file).string();
  const finished f =
      contct_program(dir.path(), {"run", problem, "--kernels", kernel, "--strict", "--json", "out.json"});
  INFO(f.out << f.err);
  CHECK(f.exit == exit);
  return json::parse(dir.read("out.json"));
}

constexpr int right = 0, uncertified = 3, path_ended = 5;

double w(const json& result, std::size_t step, std::size_t node) {
  return result["steps"][step - 1]["w"][node - 1];
}
bool exact(const json& result, std::size_t step) {
  return result["steps"][step - 1]["certificate"]["exact"];
}
const json& pair_of(const json& result, std::size_t step, std::size_t pair) {
  return result["steps"][step - 1]["pairs"][pair - 1];
}

}  // namespace

TEST_CASE(
    "DIVERGENCES.md, way 1: at a near tie a pair is toggled too early, and the error remains after "
    "unloading") {
  const std::string text = section("1. ");
  const json wrong = run("near-tie.toml", "fortran", uncertified);
  const json truth = run("near-tie.toml", "corrected", right);
  CHECK(wrong["steps"][0]["increments"][0]["events"].size() == 2);
  CHECK_FALSE(exact(wrong, 1));
  CHECK_FALSE(exact(wrong, 2));
  says(text, "1.3333e-4", w(wrong, 2, 3));
  says(text, "0.0", w(truth, 2, 3));
  says(text, "4.8e-6", w(wrong, 1, 3) - w(truth, 1, 3));
  says(text, "3 %", 100 * w(wrong, 2, 3) / -w(truth, 1, 3));
}

TEST_CASE(
    "DIVERGENCES.md, way 2: in a small unit of length, a separated pair makes contact before anything has "
    "moved") {
  const std::string text = section("2. ");
  const json wrong = run("small-unit.toml", "fortran", uncertified);
  const json truth = run("small-unit.toml", "corrected", right);
  CHECK(pair_of(wrong, 1, 1)["state"] == "contact");
  CHECK(pair_of(truth, 1, 1)["state"] == "separated");
  CHECK_FALSE(exact(wrong, 1));
  says(text, "-1.1163e-11", w(wrong, 2, 3));
  says(text, "-4.8372e-11", w(truth, 2, 3));
}

TEST_CASE(
    "DIVERGENCES.md, way 2: a pair compressed by less than EPSGAP separates at unloading but keeps its "
    "force") {
  const std::string text = section("2. ");
  const json wrong = run("stiff-stop.toml", "fortran", uncertified);
  const json truth = run("stiff-stop.toml", "corrected", right);
  CHECK(exact(wrong, 1));
  CHECK_FALSE(exact(wrong, 2));
  says(text, "+0.0040", w(wrong, 2, 3));
  says(text, "-0.0040", w(truth, 2, 3));
  says(text, "4.5e-11", -0.004 - w(truth, 1, 3));
}

TEST_CASE(
    "DIVERGENCES.md, way 3: in single precision, a pressed pair counts as a pair that only touches its "
    "face") {
  const std::string text = section("3. ");
  const json wrong = run("single-precision.toml", "fortran-r4", uncertified);
  const json in_8_bytes = run("single-precision.toml", "fortran", right);
  const json truth = run("single-precision.toml", "corrected", right);
  CHECK(pair_of(wrong, 2, 1)["state"] == "separated");
  CHECK(pair_of(truth, 2, 1)["state"] == "contact");
  CHECK(wrong["steps"][1]["increments"][0]["fraction"].get<double>() < 1e-9);
  says(text, "+4.000000", w(wrong, 2, 3));
  says(text, "-4.000000", w(in_8_bytes, 2, 3));
  says(text, "4.5e-8", -4.0 - w(truth, 1, 3));
}

TEST_CASE(
    "DIVERGENCES.md, way 4: an event exactly at full load happens in the next step, but displacements are "
    "right") {
  const std::string text = section("4. ");
  for (const char* kernel : {"fortran", "corrected"}) {
    const json result = run("event-at-full-load.toml", kernel, right);
    CHECK(pair_of(result, 1, 1)["state"] == "separated");
    says(text, "-0.004", w(result, 1, 3));
    CHECK(pair_of(result, 2, 1)["state"] == "contact");
    CHECK(result["steps"][1]["increments"][0]["fraction"].get<double>() < 1e-9);
    CHECK(exact(result, 1));
  }
}

TEST_CASE("DIVERGENCES.md, way 6: an event near full load also toggles a second pair, which has no event") {
  const std::string text = section("6. ");
  const json wrong = run("mark-toggled.toml", "fortran", uncertified);
  const json truth = run("mark-toggled.toml", "corrected", right);
  says(text, "0.998", wrong["steps"][0]["increments"][0]["fraction"]);
  CHECK(wrong["steps"][0]["increments"][0]["events"].size() == 2);
  CHECK(truth["steps"][0]["increments"][0]["events"].size() == 1);
  CHECK(pair_of(wrong, 1, 1)["state"] == "contact");
  says(text, "-5e4", pair_of(wrong, 1, 1)["force"]);
  CHECK(w(wrong, 1, 3) == Approx(w(truth, 1, 3)).epsilon(1e-9));
}

TEST_CASE("DIVERGENCES.md, way 7: wrong contact forces end the path of a beam that has an equilibrium") {
  const std::string text = section("7. ");
  const json wrong = run("locked-in-forces.toml", "fortran", path_ended);
  const json truth = run("locked-in-forces.toml", "corrected", right);
  CHECK(wrong["end"]["step"] == 3);
  says(text, "0.99907", wrong["end"]["fraction"]);
  says(text, "2.27", w(wrong, 3, 13));
  CHECK_FALSE(exact(wrong, 2));
  for (std::size_t node = 1; node <= 13; ++node) CHECK(std::abs(w(truth, 3, node)) < 1e-9);
}

TEST_CASE("DIVERGENCES.md, way 8: the 1989 rule makes no progress, although an equilibrium exists") {
  const std::string text = section("8. ");
  const json wrong = run("standstill.toml", "fortran", path_ended);
  const json truth = run("standstill.toml", "corrected", right);
  CHECK(wrong["end"]["fraction"].get<double>() < 1e-9);
  CHECK(wrong["steps"][0]["increments"].size() == 2);
  CHECK(pair_of(truth, 1, 1)["force"].get<double>() == Approx(1.5));
  CHECK(pair_of(truth, 1, 2)["force"].get<double>() == Approx(1.5));
  says(text, "1.5", pair_of(truth, 1, 1)["force"]);
}

TEST_CASE(
    "DIVERGENCES.md names every problem file of reference/problems/divergences, and no file that does not "
    "exist") {
  const std::string page = file_text("DIVERGENCES.md");
  const std::string folder = "problems/divergences/";
  std::set<std::string> named;
  for (std::size_t at = page.find(folder); at != std::string::npos; at = page.find(folder, at + 1)) {
    const std::size_t end = page.find(".toml", at);
    if (end != std::string::npos && end < at + 60)
      named.insert(page.substr(at + folder.size(), end + 5 - at - folder.size()));
  }
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(root / "reference" / folder))
    there.insert(entry.path().filename().string());
  CHECK(named == there);
  CHECK(there.size() == 8);
}
