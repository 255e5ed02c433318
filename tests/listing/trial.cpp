#include "listing/trial.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "listing/child.hpp"

namespace contct_test {
namespace {

const unsigned battery_cpu_seconds = 2;  // it takes hundredths of one

void write_file(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

child_end compile(const std::string& source, const std::vector<std::string>& options,
                  const scratch_folder& folder) {
  write_file(folder.path() / "copy.f", source);
  // The linker is told to miss CONTCT, so that a subroutine of another name is no success.
  std::vector<std::string> command{
      CONTCT_FORTRAN_COMPILER_PATH, "-shared",     "-fPIC",        "-fdefault-real-8",
      "-ffp-contract=off",          "-std=legacy", "-ffixed-form", "-Wl,--require-defined=contct_"};
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(), {"copy.f", "-o", "copy.so"});
  return run_child(command, folder.path());
}

/// A compiler that broke down has not judged the source.
void insist_on_a_verdict(const child_end& compiled) {
  const auto says = [&](const char* words) { return compiled.err.find(words) != std::string::npos; };
  if (!compiled.exited || says("internal compiler error") || says("terminated program")) {
    throw std::runtime_error("the compiler broke down: " + compiled.err);
  }
}

/// Lines of "call|field|value".
std::vector<answer> parse_answers(const std::string& lines) {
  std::vector<answer> answers;
  std::istringstream stream(lines);
  answer a;
  while (std::getline(stream, a.call, '|') && std::getline(stream, a.field, '|') &&
         std::getline(stream, a.value)) {
    answers.push_back(a);
  }
  return answers;
}

bool says_bounds(const std::string& complaint) {
  return complaint.find("Fortran runtime error: Index") != std::string::npos &&
         complaint.find(" bound of ") != std::string::npos;
}

}  // namespace

behaviour try_out(const std::string& source, const std::vector<std::string>& options) {
  const scratch_folder folder;
  behaviour seen;
  const child_end compiled = compile(source, options, folder);
  insist_on_a_verdict(compiled);
  seen.compiles = compiled.well();
  seen.complaint = compiled.err;
  if (!seen.compiles) return seen;

  const child_end ran = run_child({CONTCT_LISTING_BATTERY, (folder.path() / "copy.so").string()},
                                  folder.path(), battery_cpu_seconds);
  seen.ends_well = ran.well();
  seen.ends_at_bounds = !ran.well() && says_bounds(ran.err);
  seen.answers = parse_answers(ran.out);
  seen.text = file_text(folder.path() / "fort.26");
  seen.complaint = ran.err;
  return seen;
}

bool checksum_refuses(const std::string& source) {
  const scratch_folder folder;
  write_file(folder.path() / "copy.f", source);
  const child_end check =
      run_child({CONTCT_CMAKE, "-DLISTING=copy.f", std::string("-DCHECKSUM=") + CONTCT_LISTING_CHECKSUM, "-P",
                 CONTCT_CHECKSUM_SCRIPT},
                folder.path());
  return !check.well() && check.err.find("The listing has been edited") != std::string::npos;
}

}  // namespace contct_test
