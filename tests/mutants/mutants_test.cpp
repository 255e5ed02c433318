// The mutants' definitions, the page made of them, and the program that judges them.
#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "catch.hpp"
#include "listing/child.hpp"
#include "mutants/build.hpp"
#include "mutants/page.hpp"

using namespace contct_test;

namespace {

std::vector<mutant> mutants() {
  return read_mutants(CONTCT_MUTANTS);
}

bool occurs(const std::string& part, const std::string& text) {
  return text.find(part) != std::string::npos;
}

/// The program on a file of definitions that is at fault.
child_end judge_of(const std::string& definitions) {
  const scratch_folder folder;
  return run_child({CONTCT_MUTANTS_PROGRAM, "--definitions", CONTCT_FAULTY "/" + definitions, "--jobs", "1",
                    "--calls", "200"},
                   folder.path());
}

/// The rows of the page, without the heads of its tables.
std::vector<std::string> rows_of_page() {
  std::vector<std::string> rows;
  std::istringstream stream(file_text(CONTCT_MUTANTS_PAGE));
  for (std::string line; std::getline(stream, line);)
    if (line.substr(0, 4) == "| f-" || line.substr(0, 4) == "| c-") rows.push_back(line);
  return rows;
}

}  // namespace

TEST_CASE("at least 35 mutants a language, every class of fault, and a canary in every file") {
  std::map<bool, int> of_language;
  std::map<bool, int> equivalents;
  std::set<std::string> classes;
  std::set<std::string> files_with_canary;
  for (const mutant& m : mutants()) {
    of_language[is_fortran(m)] += m.equivalent.empty() ? 1 : 0;
    equivalents[is_fortran(m)] += m.equivalent.empty() ? 0 : 1;
    classes.insert(m.fault);
    if (m.fault == "canary" && m.equivalent.empty()) files_with_canary.insert(m.file);
  }
  CHECK(of_language[true] >= 35);
  CHECK(of_language[false] >= 35);
  CHECK(equivalents[true] >= 1);
  CHECK(equivalents[false] >= 1);
  CHECK(classes == std::set<std::string>(fault_classes.begin(), fault_classes.end()));
  CHECK(files_with_canary == std::set<std::string>(mutable_files.begin(), mutable_files.end()));
}

TEST_CASE("every mutation applies to the sources as they are, and no two are the same") {
  std::set<std::string> sources;
  for (const mutant& m : mutants()) {
    INFO(m.id);
    CHECK(sources.insert(m.file + mutated_source(m)).second);
  }
}

TEST_CASE("the kill matrix is that of the committed definitions, a row a mutant, and no verdict is missing") {
  std::vector<mutant> all = mutants();
  std::stable_partition(all.begin(), all.end(), is_fortran);
  const std::vector<std::string> rows = rows_of_page();
  REQUIRE(rows.size() == all.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    INFO(all[i].id);
    CHECK(rows[i].substr(0, row_beginning(all[i]).size()) == row_beginning(all[i]));
    if (!all[i].equivalent.empty()) {
      CHECK(rows[i] == equivalent_row(all[i]));
    } else {
      const std::string verdict = rows[i].substr(std::min(rows[i].size(), row_beginning(all[i]).size()));
      CHECK((occurs(", call ", verdict) || occurs(", crashes", verdict) || occurs(", hangs", verdict) ||
             occurs(", ends", verdict)));
    }
  }
}

TEST_CASE("a mutant that survives fails the run") {
  const child_end end = judge_of("survivor.toml");
  CHECK(end.status == 1);
  CHECK(occurs("f-no-op: survives", end.err));
}

TEST_CASE("an equivalent mutant that is noticed fails the run") {
  const child_end end = judge_of("false-proof.toml");
  CHECK(end.status == 1);
  CHECK(occurs("f-proved-wrongly: is said to be equivalent, but trace ", end.err));
}

TEST_CASE("a mutation whose text is not there, is there twice, or is in a comment never existed: an error") {
  for (const auto& [file, words] :
       {std::pair("text-does-not-occur.toml", "does not occur: EPSMUL/1.E-3/"),
        std::pair("text-occurs-twice.toml", "occurs more than once: NODE = ID(I)"),
        std::pair("text-in-a-comment.toml", "in a comment: number of contact pairs")}) {
    const child_end end = judge_of(file);
    CHECK(end.status == 2);
    CHECK(occurs(words, end.err));
  }
}

TEST_CASE("a mutant that does not compile is an error and no kill") {
  for (const std::string file : {"does-not-compile.toml", "cut-at-column-72.toml"}) {
    const child_end end = judge_of(file);
    CHECK(end.status == 2);
    CHECK(occurs("the mutant does not compile or link", end.err));
    CHECK(occurs("0 killed by the golden set, 0 by random calls alone", end.out));
  }
}

TEST_CASE("a mutant that crashes or hangs is killed, and it is said how") {
  const child_end crash = judge_of("crash.toml");
  CHECK(crash.status == 0);
  CHECK(occurs("c-crash: killed by trace full-load, crashes (signal ", crash.out));
  const child_end hang = judge_of("hang.toml");
  CHECK(hang.status == 0);
  CHECK(occurs("f-hang: killed by trace full-load, hangs", hang.out));
}

TEST_CASE("definitions with a key, a file or a class that is none are refused") {
  const scratch_folder folder;
  const std::filesystem::path file = folder.path() / "some.toml";
  const auto refused = [&](const std::string& text) {
    std::ofstream(file) << "[[mutant]]\nid = 'f-x'\nfind = 'a'\nreplace = 'b'\n" << text;
    try {
      (void)read_mutants(file);
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  CHECK(refused("file = 'fortran/contct.f'\nfault = 'sign'").empty());
  CHECK(occurs("unknown key finds", refused("finds = 'a'")));
  CHECK(occurs("file: found \"contct.f\"; allowed: fortran/contct.f,", refused("file = 'contct.f'")));
  CHECK(occurs("fault: found \"slip\"; allowed: canary,",
               refused("file = 'fortran/contct.f'\nfault = 'slip'")));
  CHECK(occurs("an empty proof is none",
               refused("file = 'fortran/contct.f'\nfault = 'sign'\nequivalent = ''")));
  CHECK(occurs("a second one of this id",
               refused("file = 'fortran/contct.f'\nfault = 'sign'\n[[mutant]]\nid = 'f-x'\nfind = 'a'\n"
                       "replace = 'c'\nfile = 'fortran/contct.f'\nfault = 'sign'")));
}
