#include "mutants/build.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "listing/child.hpp"
#include "listing/edit.hpp"

namespace contct_test {
namespace {

using words = std::vector<std::string>;
namespace fs = std::filesystem;

const fs::path root = CONTCT_ROOT;

words split(const std::string& line) {
  std::istringstream stream(line);
  words all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

words operator+(words left, const words& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

void run_tool(const words& command, const fs::path& folder) {
  const child_end end = run_child(command, folder);
  if (!end.well()) throw std::runtime_error("the mutant does not compile or link:\n" + end.err);
}

/// The listing under both of its names, as fortran/CMakeLists.txt compiles it. A line that is cut at
/// column 72 would be another mutant than the one that is written down.
words compile_listing(const fs::path& source, const fs::path& folder) {
  const words common = words{CONTCT_FORTRAN_COMPILER_PATH} + split(CONTCT_FORTRAN_BUILD_FLAGS) +
                       words{"-O2",  "-std=legacy", "-ffp-contract=off", "-Werror=line-truncation",
                             "-cpp", "-c",          source.string()};
  run_tool(common + words{"-DCONTCT=CONTC8", "-fdefault-real-8", "-o", "r8.o"}, folder);
  run_tool(common + words{"-DCONTCT=CONTC4", "-o", "r4.o"}, folder);
  return {"r8.o", "r4.o"};
}

/// The object of the C++ kernel that is made of the mutated file. The folder of the mutant comes before the
/// tree, so that a header in it is the one that is included.
words compile_cpp(const fs::path& source, const fs::path& folder) {
  const bool header = source.extension() == ".hpp";
  const fs::path unit = header ? root / "cpp/contct/kernel/contct.cpp" : source;
  run_tool(words{CONTCT_CXX_COMPILER_PATH} + split(CONTCT_CXX_BUILD_FLAGS) +
               words{"-O1", "-std=c++20", "-ffp-contract=off", "-DCONTCT_FORTRAN_COMPILER=\"\"",
                     "-DCONTCT_CXX_COMPILER=\"\"", "-DCONTCT_FORTRAN_FLAGS=\"\"", "-DCONTCT_CXX_FLAGS=\"\"",
                     "-I" + (folder / "cpp").string(), "-I" + (root / "cpp").string(), "-c", unit.string(),
                     "-o", "kernel.o"},
           folder);
  return {"kernel.o"};
}

}  // namespace

std::string mutated_source(const mutant& m) {
  const std::string source = file_text(root / m.file);
  if (source.empty()) throw std::runtime_error("cannot read " + (root / m.file).string());
  try {
    return edited(source, {{m.find, m.replace}});
  } catch (const std::runtime_error& e) {
    throw std::runtime_error("the text to replace, in " + m.file + ": " + e.what());
  }
}

fs::path build_program(const mutant& m, const std::string& source, const fs::path& folder) {
  const fs::path copy = folder / m.file;
  fs::create_directories(copy.parent_path());
  std::ofstream(copy, std::ios::binary) << source;
  const words objects = is_fortran(m) ? compile_listing(copy, folder) : compile_cpp(copy, folder);
  run_tool(words{CONTCT_CXX_COMPILER_PATH} + split(CONTCT_CXX_BUILD_FLAGS) + words{CONTCT_JUDGE_OBJECT} +
               objects + split(CONTCT_LIBRARIES) + split(CONTCT_LINK_FLAGS) + words{"-o", "mutant"},
           folder);
  return folder / "mutant";
}

}  // namespace contct_test
