#include "contct/text/input_text.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

namespace contct::text {
namespace {

struct closer {
  void operator()(std::FILE* f) const {
    if (f != stdin) (void)std::fclose(f);
  }
};

}  // namespace

void refuse_line(std::string_view file, std::int64_t line, std::string_view found, std::string_view allowed) {
  std::string message(file);
  if (line > 0) message += ":" + std::to_string(line);
  throw input_error(message.append(": found ").append(found).append("; allowed: ").append(allowed));
}

std::string read_input(const std::string& path, const std::string& kind, std::size_t most_mib) {
  const bool standard = path == "-";
  const std::string name = standard ? "standard input" : path;
  std::error_code ignored;
  if (!standard && std::filesystem::is_directory(path, ignored))
    refuse_line(name, 0, "a directory", "a " + kind);
  const std::unique_ptr<std::FILE, closer> file(standard ? stdin : std::fopen(path.c_str(), "rb"));
  if (!file) throw input_error(name + ": cannot be read: " + std::strerror(errno));
  std::string text;
  char block[1 << 16];
  std::size_t got = 0;
  while ((got = std::fread(block, 1, sizeof block, file.get())) > 0) {
    text.append(block, got);
    if (text.size() >> 20 >= most_mib)
      refuse_line(name, 0, std::to_string(most_mib) + " MiB or more", "a " + kind + " below that size");
  }
  if (std::ferror(file.get()) != 0) throw input_error(name + ": cannot be read to its end");
  return text;
}

}  // namespace contct::text
