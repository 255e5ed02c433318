// contct fuzz: what it says of kernels that agree, and of plug-ins with a fault.
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
namespace fs = std::filesystem;

namespace {

/// The plug-in of tests/outside/plugins/variant.c with a fault.
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

std::string output_of(const std::string& command, int& exit) {
  std::FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string out;
  std::array<char, 4096> block{};
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), pipe)) out.append(block.data(), n);
  exit = pclose(pipe);
  return out;
}

}  // namespace

TEST_CASE("fortran and cpp are equal to the bit, and the run says how much it compared") {
  const scratch_folder dir;
  for (const char* kernels : {"fortran,cpp", "fortran-r4,cpp-r4"}) {
    const finished f =
        fuzz(dir, {"--kernels", kernels, "--calls", "30000", "--json", "f.json", "--junit", "f.xml"});
    INFO(f.out << f.err);
    CHECK(f.exit == 0);
    CHECK_THAT(f.out, Contains("to the bit"));
    const nlohmann::json j = json_of(dir, "f.json");
    CHECK(j.at("calls") >= 30000);
    CHECK(j.at("problems") == 60);
    CHECK(j.at("values_compared") > 500'000);
    CHECK(j.at("mismatches") == 0);
    CHECK(j.at("seed") == 1989);
    CHECK(j.at("branches").size() == 16);
    for (const auto& [name, count] : j.at("branches").items()) CHECK(count > 1000);
    for (const char* kind : {"make", "break", "stationary"}) CHECK(j.at("events").at(kind) > 1000);
    CHECK_THAT(dir.read("f.xml"), Contains("failures=\"0\""));
  }
}

TEST_CASE("a right kernel in C, called as a plug-in, is CONTCT") {
  const scratch_folder dir;
  const finished f = fuzz(dir, {"--kernels", "fortran," + variant("right"), "--calls", "20000"});
  INFO(f.out << f.err);
  CHECK(f.exit == 0);
}

TEST_CASE("the printed line runs the same once more") {
  const scratch_folder dir;
  const std::string kernels = "fortran," + variant("less_equal");
  const finished a = fuzz(dir, {"--kernels", kernels, "--calls", "8000", "--seed", "77", "--shard", "2/3"});
  CHECK_THAT(a.out, Contains("--calls 8000 --problems 16 --seed 77 --shard 2/3"));
  const finished b = fuzz(
      dir, {"--kernels", kernels, "--calls", "8000", "--problems", "16", "--seed", "77", "--shard", "2/3"});
  CHECK(a.err == b.err);
  CHECK(a.exit == 1);
}

TEST_CASE("an EPSMUL compared by less-or-equal is found, read as a tie, and shrunk to two pairs") {
  const scratch_folder dir;
  const finished f = fuzz(dir, {"--kernels", "fortran," + variant("less_equal"), "--calls", "20000", "--out",
                                "found", "--json", "f.json"});
  INFO(f.out << f.err);
  CHECK(f.exit == 1);
  CHECK_THAT(f.out, Contains("certificate"));
  CHECK(fs::exists(dir.path() / "found/plugin-libvariant-less-equal-so-seed1989.trace"));
  CHECK_THAT(f.err, Contains("IF (DIFF.LT.EPSMUL) was false, exactly on the threshold: a tie"));
  CHECK_THAT(f.err, Contains("shrunk to 1 call(s), 2 pair(s)"));
  const nlohmann::json its = json_of(dir, "f.json").at("followers").at(0);
  CHECK(its.at("rung") == "certificate");
  CHECK(its.at("mismatches") > 0);

  // The three files: a trace that tells the two apart, a main program that runs, a test that compiles.
  std::string stem;
  for (const auto& entry : fs::directory_iterator(dir.path() / "found"))
    if (entry.path().extension() == ".f")
      stem = entry.path().string().substr(0, entry.path().string().size() - 2);
  REQUIRE_FALSE(stem.empty());
  CHECK(contct_program(dir.path(), {"replay", stem + ".trace", "--kernel", "fortran,cpp"}).exit == 0);
  CHECK(contct_program(dir.path(), {"replay", stem + ".trace", "--kernel", variant("less_equal")}).exit == 1);
  int exit = 0;
  const std::string main =
      output_of(std::string(CONTCT_FORTRAN) + " -std=legacy -fdefault-real-8 -fno-range-check " +
                    "-ffp-contract=off " + stem + ".f " + CONTCT_ROOT + "/fortran/contct.f -o " + stem +
                    " && cd " + (dir.path() / "found").string() + " && " + stem,
                exit);
  INFO(main);
  CHECK(exit == 0);
  CHECK_THAT(main, Contains("SMIN") && Contains("-1"));
  output_of(
      std::string(CONTCT_CXX) + " -std=c++20 -fsyntax-only -I" + CONTCT_ROOT + "/cpp " + stem + "_test.cpp",
      exit);
  CHECK(exit == 0);
}

TEST_CASE("a reassociated quotient is found in the last place, and its ULPs are counted") {
  const scratch_folder dir;
  const finished f =
      fuzz(dir, {"--kernels", "fortran," + variant("reassociated"), "--calls", "4000", "--problems", "0"});
  CHECK(f.exit == 1);
  CHECK_THAT(f.err, Contains("(1 ULP)"));
}

TEST_CASE("a kernel that remembers the call before is shrunk to two calls") {
  const scratch_folder dir;
  const finished f =
      fuzz(dir, {"--kernels", "fortran," + variant("remembers"), "--calls", "4000", "--problems", "0"});
  INFO(f.err);
  CHECK(f.exit == 1);
  CHECK_THAT(f.err, Contains("shrunk to 2 call(s)"));
}

TEST_CASE("a plug-in that aborts now and then is a verdict, not the end of the run") {
  const scratch_folder dir;
  const finished f = fuzz(dir, {"--kernels", "fortran," + variant("crashes"), "--calls", "4000", "--problems",
                                "0", "--json", "f.json"});
  INFO(f.err);
  CHECK(f.exit == 1);
  CHECK_THAT(f.err, Contains("gave no answer: it was ended by signal 6"));
  CHECK(json_of(dir, "f.json").at("followers").at(0).at("rung") == "none");
  CHECK(json_of(dir, "f.json").at("calls") == 4000);
}

TEST_CASE("a plug-in that leads and aborts ends the run with the status of kernels that disagree") {
  const scratch_folder dir;
  const finished f = fuzz(dir, {"--kernels", variant("crashes") + ",fortran", "--calls", "4000"});
  CHECK(f.exit == 1);
  CHECK_THAT(f.err, Contains("the leading kernel gave no answer: it was ended by signal 6"));
}

TEST_CASE("shards are added up again, and a missing or doubled one is refused") {
  const scratch_folder dir;
  for (const char* shard : {"1", "2", "3"}) {
    CHECK(fuzz(dir, {"--calls", "9000", "--problems", "9", "--shard", std::string(shard) + "/3", "--json",
                     std::string(shard) + ".json"})
              .exit == 0);
  }
  CHECK(fuzz(dir, {"--calls", "9000", "--problems", "9", "--json", "all.json"}).exit == 0);
  CHECK(fuzz(dir, {"--merge", "1.json", "2.json", "3.json", "--json", "merged.json"}).exit == 0);
  nlohmann::json merged = json_of(dir, "merged.json");
  nlohmann::json all = json_of(dir, "all.json");
  for (const char* key : {"calls", "problems", "events", "branches", "mismatches"})
    CHECK(merged.at(key) == all.at(key));
  CHECK_THAT(fuzz(dir, {"--merge", "1.json", "3.json"}).err, Contains("found 2 of 3 shards (1, 3)"));
  CHECK_THAT(fuzz(dir, {"--merge", "1.json", "1.json", "3.json"}).err, Contains("found shard 1 once more"));
  CHECK_THAT(fuzz(dir, {"--merge", "1.json", "all.json"}).err, Contains("found another run"));
  dir.write("not.json", "{}");
  CHECK_THAT(fuzz(dir, {"--merge", "not.json"}).err, Contains("not.json: found no fuzz result"));
}

TEST_CASE("a run that is killed goes on from its checkpoint, and ends as one that was not") {
  const scratch_folder dir;
  const std::string faulty = variant("less_equal");
  const std::vector<std::string> run = {
      "--kernels", "cpp,fortran," + faulty, "--calls", "60000", "--problems", "40", "--shard", "2/2"};
  const auto with = [&run](std::vector<std::string> more) {
    more.insert(more.begin(), run.begin(), run.end());
    return more;
  };
  const finished whole = fuzz(dir, with({"--json", "whole.json", "--out", "whole"}));
  CHECK(whole.exit == 1);
  // Killed as soon as there is a checkpoint, and again a little later, until nobody kills it any more.
  std::string command = std::string(CONTCT_PROGRAM) + " fuzz";
  for (const std::string& word :
       with({"--checkpoint", "c.json", "--resume", "--json", "part.json", "--out", "part"}))
    command += " '" + word + "'";
  for (int wanted = 0, reached = 0; wanted < 2; ++wanted) {
    const std::string kill_it =
        "cd '" + dir.path().string() + "' && { " + command +
        " >/dev/null 2>&1 & } ; p=$!; while kill -0 $p 2>/dev/null && ! grep -q up_to c.json "
        "2>/dev/null; do sleep 0.01; done; kill -KILL $p; wait $p";
    int exit = 0;
    (void)output_of(kill_it, exit);
    const int now = json_of(dir, "c.json").at("calls_up_to");
    CHECK(now >= reached);
    reached = now;
    CHECK(reached > 0);
  }
  CHECK(
      fuzz(dir, with({"--checkpoint", "c.json", "--resume", "--json", "part.json", "--out", "part"})).exit ==
      1);
  nlohmann::json expected = json_of(dir, "whole.json");
  nlohmann::json found = json_of(dir, "part.json");
  for (nlohmann::json* j : {&expected, &found}) j->erase("seconds");
  CHECK(expected == found);
  CHECK(found.at("followers").at(1).at("mismatches") > 0);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(dir.path() / "whole")) {
    const fs::path name = entry.path().filename();
    CHECK(dir.read("whole" / name) == dir.read("part" / name));
    ++files;
  }
  CHECK(files == 3);
  // Once more: all is done, and the result is the same.
  CHECK(fuzz(dir, with({"--checkpoint", "c.json", "--resume", "--json", "again.json"})).exit == 1);
  CHECK(json_of(dir, "again.json").at("values_compared") == expected.at("values_compared"));

  CHECK_THAT(fuzz(dir, with({"--checkpoint", "c.json"})).err,
             Contains("which exists; allowed: with --resume"));
  CHECK_THAT(fuzz(dir, with({"--checkpoint", "c.json", "--resume", "--seed", "3"})).err,
             Contains("c.json: found the checkpoint of another run"));
  CHECK_THAT(fuzz(dir, {"--resume"}).err, Contains("--resume: found no --checkpoint"));
  CHECK_THAT(fuzz(dir, {"--merge", "whole.json", "--checkpoint", "d.json"}).err,
             Contains("found beside --merge"));
}

namespace {

/// What a run prints and writes, without its duration.
std::vector<std::string> all_of(const scratch_folder& dir, const finished& f, const std::string& folder) {
  nlohmann::json j = json_of(dir, (folder + "/f.json").c_str());
  j.erase("seconds");
  std::vector<std::string> all = {std::regex_replace(f.out, std::regex(R"(, [\d.]+ s\b)"), ""), f.err,
                                  j.dump()};
  for (const auto& entry : fs::directory_iterator(dir.path() / folder))
    if (entry.path().filename() != "f.json") all.push_back(dir.read(folder / entry.path().filename()));
  std::sort(all.begin() + 3, all.end());
  return all;
}

}  // namespace

TEST_CASE("one job and three give the same bytes: counts, the first mismatch and what it is shrunk to") {
  const scratch_folder dir;
  for (const char* kernels : {"fortran,cpp", "cpp,fortran,PLUGIN"}) {
    std::string chosen = kernels;
    if (const auto at = chosen.find("PLUGIN"); at != std::string::npos)
      chosen.replace(at, 6, variant("less_equal"));
    std::vector<std::string> expected;
    for (const char* jobs : {"1", "3"}) {
      const std::string folder = std::string("jobs") + jobs;
      fs::remove_all(dir.path() / folder);
      fs::create_directory(dir.path() / folder);
      finished f = fuzz(dir, {"--kernels", chosen, "--calls", "60000", "--problems", "70", "--jobs", jobs,
                              "--json", folder + "/f.json", "--out", folder});
      f.err = std::regex_replace(f.err, std::regex(folder), "FOLDER");
      CHECK(f.exit == (chosen == kernels ? 0 : 1));
      std::vector<std::string> found = all_of(dir, f, folder);
      CHECK(found.size() == (chosen == kernels ? 3 : 6));
      if (expected.empty()) expected = found;
      CHECK(found == expected);
    }
  }
}

TEST_CASE("a run of three jobs goes on from the checkpoint of one job, and ends as one job does") {
  const scratch_folder dir;
  const auto run = [&dir](std::vector<std::string> more) {
    const std::vector<std::string> all = {"--calls", "100000", "--problems", "50", "--shard", "1/2"};
    more.insert(more.begin(), all.begin(), all.end());
    return fuzz(dir, more).exit;
  };
  CHECK(run({"--jobs", "1", "--checkpoint", "c.json", "--json", "whole.json"}) == 0);
  CHECK(run({"--jobs", "3", "--checkpoint", "d.json", "--json", "three.json"}) == 0);
  nlohmann::json one = json_of(dir, "c.json");
  nlohmann::json three = json_of(dir, "d.json");
  for (nlohmann::json* j : {&one, &three}) j->at("result").erase("seconds");
  CHECK(one == three);
  CHECK(run({"--jobs", "3", "--checkpoint", "c.json", "--resume", "--json", "again.json"}) == 0);
  nlohmann::json whole = json_of(dir, "whole.json");
  for (const char* name : {"three.json", "again.json"}) {
    nlohmann::json its = json_of(dir, name);
    its["seconds"] = whole["seconds"];
    CHECK(its == whole);
  }
}

TEST_CASE("a worker that is killed ends the run with one message, exit 2 and no file") {
  const scratch_folder dir;
  int exit = 0;
  const std::string said =
      output_of("cd '" + dir.path().string() + "' && { " + std::string(CONTCT_PROGRAM) +
                    " fuzz --calls 1000000000 --jobs 2 --json f.json --junit f.xml 2>&1 & } ; p=$!; "
                    "while c=$(cat /proc/$p/task/$p/children) && [ -z \"$c\" ]; do sleep 0.01; done; "
                    "kill -KILL ${c%% *}; wait $p",
                exit);
  CHECK(WEXITSTATUS(exit) == 2);
  CHECK_THAT(said, StartsWith("contct: a worker process was ended by signal 9 (Killed)"));
  CHECK(std::count(said.begin(), said.end(), '\n') == 1);
  CHECK(dir.files().empty());
}

TEST_CASE("a hunt that finds too little to compare fails") {
  const scratch_folder dir;
  CHECK(fuzz(dir, {"--calls", "0"}).exit == 2);
  CHECK(fuzz(dir, {"--kernels", "fortran"}).exit == 2);
  CHECK(fuzz(dir, {"--shard", "3/2"}).exit == 2);
  CHECK(fuzz(dir, {"--jobs", "0"}).exit == 2);
  CHECK(fuzz(dir, {"--shard", "1/2x"}).exit == 2);
  // Shard 5 of 9 has no call when there are four.
  const finished f = fuzz(dir, {"--calls", "4", "--problems", "0", "--shard", "5/9"});
  CHECK(f.exit == 2);
  CHECK_THAT(f.err, Contains("nothing was compared"));
}
