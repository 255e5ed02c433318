// Tests `contct fuzz` with kernels that agree and with plug-ins that have a fault.
#include <nlohmann/json.hpp>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// Returns the name of the plug-in tests/kernel/plugins/variant.c with this fault.
std::string variant(const char* fault) {
  return "plugin:" + std::string(CONTCT_PLUGINS) + "/libvariant_" + fault + ".so";
}

finished fuzz(const scratch_folder& dir, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "fuzz");
  return contct_program(dir.path(), arguments);
}

nlohmann::json json_of(const scratch_folder& dir, const char* name) {
  return nlohmann::json::parse(dir.read(name));
}

}  // namespace

TEST_CASE(
    "contct fuzz finds the kernels fortran and cpp equal to the bit, and counts the values that it "
    "compared") {
  const scratch_folder dir;
  for (const char* kernels : {"fortran,cpp", "fortran-r4,cpp-r4"}) {
    const finished f =
        fuzz(dir, {"--kernels", kernels, "--calls", "30000", "--json", "f.json", "--junit", "f.xml"});
    INFO(f.out << f.err);
    CHECK(f.exit == 0);
    CHECK_THAT(f.out, Contains("to the bit") && Contains("ISEP from -2 to 2, ISURF 1 or -1"));
    const nlohmann::json j = json_of(dir, "f.json");
    CHECK(j.at("calls") >= 30000);
    CHECK(j.at("problems") == 60);
    CHECK(j.at("values_compared") > 500'000);
    CHECK(j.at("mismatches") == 0);
    CHECK(j.at("seed") == 1989);
    CHECK(j.at("asked").at("calls") == 30000);
    CHECK(j.at("shard").at("of") == 1);
    CHECK(j.at("branches").size() == 16);
    for (const auto& [name, count] : j.at("branches").items()) CHECK(count > 1000);
    for (const char* kind : {"make", "break", "stationary"}) CHECK(j.at("events").at(kind) > 1000);
    CHECK_THAT(dir.read("f.xml"), Contains("failures=\"0\""));
  }
}

TEST_CASE("contct fuzz prints a command that repeats the run") {
  const scratch_folder dir;
  const std::string kernels = "fortran," + variant("less_equal");
  const finished a = fuzz(dir, {"--kernels", kernels, "--calls", "8000", "--seed", "77", "--shard", "2/3"});
  CHECK_THAT(a.out, Contains("--calls 8000 --problems 16 --seed 77 --shard 2/3"));
  const finished b = fuzz(
      dir, {"--kernels", kernels, "--calls", "8000", "--problems", "16", "--seed", "77", "--shard", "2/3"});
  CHECK(a.err == b.err);
  CHECK(a.exit == 1);
}

TEST_CASE(
    "contct fuzz finds a kernel with <= EPSMUL instead of <, reports a tie, and shrinks the case to two "
    "pairs") {
  const scratch_folder dir;
  const finished f = fuzz(dir, {"--kernels", "fortran," + variant("less_equal"), "--calls", "20000", "--out",
                                "found", "--json", "f.json"});
  INFO(f.out << f.err);
  CHECK(f.exit == 1);
  CHECK_THAT(f.out, Contains("certificate"));
  CHECK_THAT(f.err, Contains("IF (DIFF.LT.EPSMUL) was false, exactly on the threshold: a tie"));
  CHECK_THAT(f.err, Contains("reduced to 1 call, 2 pairs"));
  CHECK_THAT(f.err, Contains("known fault: A DIFF of exactly EPSMUL is not toggled: DIFF < EPSMUL, not <=."));
  const nlohmann::json its = json_of(dir, "f.json").at("followers").at(0);
  CHECK(its.at("rung") == "certificate");
  CHECK(its.at("mismatches") > 0);

  const std::string trace = "found/plugin-libvariant-less-equal-so-seed1989.trace";
  CHECK(contct_program(dir.path(), {"replay", trace, "--kernel", "fortran,cpp"}).exit == 0);
  CHECK(contct_program(dir.path(), {"replay", trace, "--kernel", variant("less_equal")}).exit == 1);
}

TEST_CASE(
    "if the second kernel is a plug-in that sometimes aborts, contct fuzz fails but makes all its calls") {
  const scratch_folder dir;
  const finished f = fuzz(dir, {"--kernels", "fortran," + variant("crashes"), "--calls", "4000", "--problems",
                                "0", "--json", "f.json"});
  INFO(f.err);
  CHECK(f.exit == 1);
  CHECK_THAT(f.err, Contains("gave no answer: it was ended by signal 6"));
  CHECK(json_of(dir, "f.json").at("followers").at(0).at("rung") == "none");
  CHECK(json_of(dir, "f.json").at("calls") == 4000);
}

TEST_CASE("if the first kernel is a plug-in that aborts, contct fuzz ends with exit status 1") {
  const scratch_folder dir;
  const finished f = fuzz(dir, {"--kernels", variant("crashes") + ",fortran", "--calls", "4000"});
  CHECK(f.exit == 1);
  CHECK_THAT(f.err, Contains("the leading kernel gave no answer: it was ended by signal 6"));
}

TEST_CASE("contct fuzz has exit status 2 if it compares nothing") {
  const scratch_folder dir;
  CHECK(fuzz(dir, {"--calls", "0"}).exit == 2);
  CHECK(fuzz(dir, {"--kernels", "fortran"}).exit == 2);
  CHECK(fuzz(dir, {"--shard", "3/2"}).exit == 2);
  CHECK(fuzz(dir, {"--shard", "1/2x"}).exit == 2);
  // Of four calls, shard 5 of 9 gets none.
  const finished f = fuzz(dir, {"--calls", "4", "--problems", "0", "--shard", "5/9"});
  CHECK(f.exit == 2);
  CHECK_THAT(f.err, Contains("nothing was compared"));
}
