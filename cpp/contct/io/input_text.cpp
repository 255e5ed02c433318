#include "contct/io/input_text.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "contct/io/toml_reader.hpp"

namespace contct {
namespace {

// A beam of 100,000 nodes with every coordinate written out takes 2 MB.
constexpr std::size_t most_bytes = std::size_t{32} << 20;

struct closer {
  void operator()(std::FILE* f) const {
    if (f != stdin) (void)std::fclose(f);
  }
};

}  // namespace

std::string read_input(const std::string& path) {
  const bool standard = path == "-";
  const std::string name = standard ? "standard input" : path;
  std::error_code ignored;
  if (!standard && std::filesystem::is_directory(path, ignored)) {
    throw input_error(fmt::format("{}: found a directory; allowed: a problem file", name));
  }
  const std::unique_ptr<std::FILE, closer> file(standard ? stdin : std::fopen(path.c_str(), "rb"));
  if (!file) throw input_error(fmt::format("{}: cannot be read: {}", name, std::strerror(errno)));
  std::string text;
  char block[1 << 16];
  std::size_t got = 0;
  while ((got = std::fread(block, 1, sizeof block, file.get())) > 0) {
    text.append(block, got);
    if (text.size() > most_bytes) {
      throw input_error(fmt::format("{}: found more than {} MiB; allowed: problem files up to that size",
                                    name, most_bytes >> 20));
    }
  }
  if (std::ferror(file.get()) != 0) throw input_error(fmt::format("{}: cannot be read to its end", name));
  return text;
}

}  // namespace contct
