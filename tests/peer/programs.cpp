#include "peer/programs.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace contct::app::peer {
namespace {

int shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || text.str().empty()) throw std::runtime_error(path + " cannot be read, or is empty");
  return text.str();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(path + " cannot be written");
}

nlohmann::json run_contct(const places& p, const std::string& problem) {
  const std::string json = p.work + "/contct.json";
  const int exit =
      shell(fmt::format("'{}' run '{}' --strict --kernels fortran,cpp --json '{}' >'{}/contct.log' 2>&1",
                        p.contct, problem, json, p.work));
  if (exit != 0)
    throw std::runtime_error(
        fmt::format("contct run {}: exit {}\n{}", problem, exit, read_text(p.work + "/contct.log")));
  nlohmann::json result = nlohmann::json::parse(read_text(json));
  if (result["lockstep"]["calls"] == 0 || result["lockstep"]["mismatches"] != 0)
    throw std::runtime_error("contct run " + problem + ": the kernels were not compared, or differ");
  return result;
}

void run_deck(const places& p, const std::string& job, const std::string& deck) {
  const std::string stem = p.work + "/" + job;
  for (const char* old : {".dat", ".sti", ".dof"})
    std::filesystem::remove(stem + old);  // not those from before
  write_text(stem + ".inp", deck);
  const int exit = shell(fmt::format("cd '{}' && '{}' '{}' >'{}.log' 2>&1", p.work, p.ccx, job, job));
  if (exit != 0)
    throw std::runtime_error(fmt::format("CalculiX on {}: exit {}; see {}.log", job, exit, stem));
}

std::vector<calculix_table> run_calculix(const places& p, const std::string& job, const std::string& deck) {
  run_deck(p, job, deck);
  return read_calculix_dat(p.work + "/" + job + ".dat");
}

void verdicts::check(bool good, const std::string& words) {
  ++checks_;
  if (!good) ++failures_;
  fmt::print("{} {}\n", good ? "  ok    " : "  FAILED", words);
  std::fflush(stdout);
}

}  // namespace contct::app::peer
