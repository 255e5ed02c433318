#include "bench/peers/run_peers.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "bench/peers/certified_state.hpp"
#include "bench/problems.hpp"

namespace bench::peers {
namespace {

namespace files = std::filesystem;
using json = nlohmann::ordered_json;

struct method {
  const char* program;  ///< in the folder of the programs
  const char* name;     ///< as the program knows it
  const char* words;    ///< for people
};

constexpr method methods[] = {
    {"ours", "path", "contct: the whole path, engine auto"},
    {"ours", "path-certified", "contct: the same, with its certificate"},
    {"ours", "final", "contct: --final-only without a certificate"},
    {"ours", "final-certified", "contct: --final-only"},
    {"cholmod", "updown", "CHOLMOD: Newton, up/downdating"},
    {"cholmod", "factor", "CHOLMOD: Newton, a factor for each step"},
    {"siconos", "lemke", "Siconos: Lemke"},
    {"siconos", "newton-min-fb", "Siconos: NEWTON_MIN_FB"},
    {"siconos", "pgs", "Siconos: PGS"},
    {"petsc", "newton", "PETSc: semismooth Newton, CHOLMOD"},
    {"petsc", "rsls", "PETSc: VINEWTONRSLS, dense"},
    {"petsc", "ssls", "PETSc: VINEWTONSSLS, dense"},
    {"calculix", "newton", "CalculiX: its own Newton, NLGEOM"},
};

/// Where a program that is missing comes from.
std::string remedy_for(const std::string& program) {
  if (program == "siconos") return "tests/bench/peers/siconos.sh gets it";
  if (program == "petsc") return "Debian's libpetsc-real-dev and libopenmpi-dev";
  if (program == "calculix") return "Debian's calculix-ccx";
  return "Debian's libsuitesparse-dev";
}

/// A folder that is gone afterwards.
class scratch_folder {
 public:
  scratch_folder() {
    std::string name = (files::temp_directory_path() / "contct-peers-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
    path_ = name;
  }
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;
  ~scratch_folder() {
    std::error_code ignored;
    files::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  files::path path_;
};

/// The programs are built where their libraries are found, into a folder beside this one.
std::string path_of(const std::string& program) {
  return (files::read_symlink("/proc/self/exe").parent_path() / "peers" / program).string();
}

bool is_on_path(const char* program) {
  std::istringstream folders(std::getenv("PATH") != nullptr ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

bool is_found(const std::string& program) {
  if (program == "calculix" && !is_on_path("ccx")) return false;
  return files::exists(path_of(program));
}

/// Runs a program with a limit on its time, quietly. False where it fails.
bool run_program(const std::string& program, const std::vector<std::string>& arguments,
                 const std::string& log) {
  constexpr unsigned most_seconds = 900;
  std::vector<std::string> words = {path_of(program)};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> line;
  for (std::string& w : words) line.push_back(w.data());
  line.push_back(nullptr);
  (void)std::fflush(nullptr);  // the child would write it once more
  const pid_t child = fork();
  if (child == 0) {
    (void)alarm(most_seconds);
    (void)setenv("OMP_NUM_THREADS", "1", 1);
    if (std::freopen(log.c_str(), "w", stdout) != nullptr && dup2(1, 2) == 2)
      (void)execv(line[0], line.data());
    _exit(127);
  }
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// What a program said last.
std::string last_line_of(const std::string& path) {
  std::ifstream in(path);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) last = line;
  return last;
}

/// Writes the problem and the certified state to the folder. False where a program for that is not found.
bool prepare(const std::string& name, const std::string& folder) {
  const std::string log = folder + "/log";
  if (name.rfind("solid-", 0) == 0) {
    if (!is_found("calculix")) return false;
    if (!run_program("calculix", {"solid", folder, name.substr(6)}, log))
      throw std::runtime_error(name + ": " + last_line_of(log));
  } else {
    std::ofstream(folder + "/problem.toml") << bench::problem_text(name);
  }
  if (!run_program("ours", {"state", folder}, log)) throw std::runtime_error(name + ": " + last_line_of(log));
  return true;
}

/// Nothing where the program is not found, or failed.
json row_of(const std::string& name, const method& m, const std::string& folder, const certified_state& state,
            int rounds) {
  json row = {{"problem", name}, {"program", m.program}, {"method", m.name}, {"status", "not found"}};
  if (!is_found(m.program)) return row;
  const std::string log = folder + "/log";
  if (!run_program(m.program, {m.name, folder, std::to_string(rounds)}, log)) {
    row["status"] = "failed";
    row["words"] = last_line_of(log);
    return row;
  }
  const answer a = read_answer(folder);
  const verdict v = judge(state, a);
  row["status"] = a.found ? "found" : "gave up";
  row["ms"] = 1e3 * a.seconds;
  row["build_ms"] = 1e3 * a.build_seconds;
  row["steps"] = a.steps;
  row["digits"] = v.digits;
  row["wrong_statuses"] = v.statuses;
  row["values"] = v.values;
  row["peak_mib"] = static_cast<double>(a.peak_kib) / 1024;
  return row;
}

void print(const method& m, const json& row) {
  const std::string status = row["status"];
  if (!row.contains("ms")) {
    fmt::print("  {:<44} {}\n", m.words,
               status == "not found" ? "not found: " + remedy_for(m.program)
                                     : status + ": " + row["words"].get<std::string>());
    return;
  }
  const double build = row["build_ms"];
  fmt::print("  {:<44} {:>10.3f} ms{}  {:>4.1f} digits  {:>3} wrong statuses  {:>5.0f} MiB{}\n", m.words,
             row["ms"].get<double>(), build > 0.0 ? fmt::format(" + {:.1f} ms for the matrix", build) : "",
             row["digits"].get<double>(), row["wrong_statuses"].get<int>(), row["peak_mib"].get<double>(),
             status == "found" ? "" : "  (" + status + ")");
}

}  // namespace

std::vector<std::string> usual_problems() {
  return {"rail-50", "grid-50", "solid-4"};
}

std::vector<std::string> names() {
  std::vector<std::string> list;
  for (const method& m : methods)
    if (list.empty() || list.back() != m.program) list.emplace_back(m.program);
  return list;
}

json run(const std::vector<std::string>& programs, const std::vector<std::string>& problems, int rounds) {
  json rows = json::array();
  for (const std::string& name : problems) {
    const scratch_folder folder;
    if (!prepare(name, folder.path())) {
      fmt::print("{}: not found: CalculiX, which makes its matrix ({})\n", name, remedy_for("calculix"));
      rows.push_back({{"problem", name}, {"program", "calculix"}, {"status", "not found"}});
      continue;
    }
    const certified_state state = read_state(folder.path());
    fmt::print("{}: {} free dofs, {} pairs\n", name, state.u.size(), state.forces.size());
    for (const method& m : methods) {
      if (std::find(programs.begin(), programs.end(), m.program) == programs.end()) continue;
      rows.push_back(row_of(name, m, folder.path(), state, rounds));
      print(m, rows.back());
    }
  }
  return rows;
}

}  // namespace bench::peers
