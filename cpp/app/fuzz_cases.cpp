#include "app/fuzz_cases.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>

#include "contct/outside/registry.hpp"
#include "contct/text/output_file.hpp"

namespace contct {
namespace {

/// A kernel's name as part of a file's: "plugin:./mine.so" becomes "plugin-mine-so".
std::string file_name_of(const std::string& kernel) {
  std::string name;
  const std::string library = std::filesystem::path(kernel).filename().string();
  for (const char ch : kernel.rfind("plugin:", 0) == 0 && library != kernel ? "plugin-" + library : kernel) {
    const bool plain = std::isalnum(static_cast<unsigned char>(ch)) != 0;
    if (plain) name += ch;
    if (!plain && !name.empty() && name.back() != '-') name += '-';
  }
  constexpr std::size_t longest = 60;
  return name.substr(0, longest);
}

trace_header header_of(const found_case& c) {
  trace_header h = header_for(facts_of_kernel(c.what.leader), CONTCT_LISTING_SHA256);
  h.about = {"found by contct fuzz, and shrunk"};
  return h;
}

void write(const std::string& path, const std::string& text) {
  output_file out(path);
  out.write(text);
  out.finish();
}

}  // namespace

std::vector<std::string> write_cases(const std::vector<found_case>& cases, const std::string& folder,
                                     std::uint64_t seed) {
  std::filesystem::create_directories(folder);
  std::vector<std::string> names;
  for (const found_case& c : cases) {
    const std::string stem =
        (std::filesystem::path(folder) / fmt::format("{}-seed{}", file_name_of(c.what.follower), seed))
            .string();
    write(stem + ".trace", trace_of(c, header_of(c)));
    write(stem + "_test.cpp", catch_test_of(c));
    write(stem + ".f", fortran_main_of(c));
    for (const char* end : {".trace", "_test.cpp", ".f"}) names.push_back(stem + end);
  }
  return names;
}

}  // namespace contct
