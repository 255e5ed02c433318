#include "app/process.hpp"

#include <fcntl.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "catch.hpp"

namespace contct {
namespace {

/// Replaces the child process by the program. Output goes to files, because a pipe could fill up and block
/// the program.
[[noreturn]] void become(const std::filesystem::path& directory, std::vector<std::string> arguments,
                         const process_options& options, const std::filesystem::path& streams, int terminal) {
  dup2(open((streams / "in").c_str(), O_RDONLY), STDIN_FILENO);
  dup2(options.error_terminal ? terminal : open((streams / "err").c_str(), O_WRONLY), STDERR_FILENO);
  if (chdir(directory.c_str()) != 0) _exit(127);
  const std::string output = options.output.empty() ? (streams / "out").string() : options.output;
  dup2(options.terminal ? terminal : open(output.c_str(), O_WRONLY), STDOUT_FILENO);
  for (int left_over = STDERR_FILENO + 1; left_over < 10; ++left_over) close(left_over);
  if (output == "closed") close(STDOUT_FILENO);
  clearenv();
  setenv("PATH", "/usr/bin:/bin", 1);
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  arguments.insert(arguments.begin(), "contct");
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  execv(CONTCT_PROGRAM, argv.data());
  _exit(127);
}

/// Returns everything that the program writes to its terminal.
std::string drain(int terminal) {
  std::string text;
  char block[4096];
  ssize_t got = 0;
  while ((got = ::read(terminal, block, sizeof block)) > 0) text.append(block, static_cast<std::size_t>(got));
  return text;  // reading fails after the last writer has closed the terminal
}

}  // namespace

finished shell(const std::string& line) {
  const scratch_folder streams;
  const int status =
      std::system(("(" + line + ") >'" + (streams.path() / "out").string() + "' 2>&1").c_str());
  finished f;
  f.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  f.out = streams.read("out");
  return f;
}

finished contct_program(const std::filesystem::path& directory, const texts& arguments,
                        const process_options& options) {
  const scratch_folder streams;
  streams.write("in", options.input);
  streams.write("out", "");
  streams.write("err", "");
  int leader = -1;
  int terminal = -1;
  winsize size{24, 80, 0, 0};
  const bool wants_terminal = options.terminal || options.error_terminal;
  if (wants_terminal && openpty(&leader, &terminal, nullptr, nullptr, &size) != 0) {
    throw std::runtime_error("no pseudo-terminal can be had");
  }
  const pid_t child = fork();
  if (child == 0) become(directory, arguments, options, streams.path(), terminal);
  finished f;
  if (terminal >= 0) {
    close(terminal);
    (options.terminal ? f.out : f.err) = drain(leader);
    close(leader);
  }
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  f.exit = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  f.peak_kib = used.ru_maxrss;
  if (!options.terminal) f.out = streams.read("out");
  if (!options.error_terminal) f.err = streams.read("err");
  return f;
}

texts words_of(const std::string& line) {
  texts all;
  std::istringstream in(line);
  for (std::string word; in >> std::quoted(word, '\'');) {
    if (const std::size_t at = word.find('@'); at != std::string::npos)
      word.replace(at, 1, CONTCT_ROOT "/reference/");
    if (const std::size_t at = word.find('$'); at != std::string::npos)
      word.replace(at, 1, CONTCT_PLUGINS "/libvariant_");
    all.push_back(word);
  }
  return all;
}

nlohmann::json workplace::printed_json(const std::string& line) const {
  const finished f = contct(line);
  INFO(line << "\n" << f.err);
  REQUIRE(f.exit == 0);
  return nlohmann::json::parse(f.out);
}

void workplace::check(const std::string& line, int exit, const texts& out, const texts& err,
                      const process_options& options) const {
  const auto before = files();
  const finished f = contct(line, options);
  INFO("contct " << line << "\n" << f.out << f.err);
  CHECK(f.exit == exit);
  check_words(f.out, out.empty() && exit == 2 ? texts{""} : out);
  check_words(f.err, err.empty() && exit == 0 ? texts{""} : err);
  if (exit == 2) CHECK(files() == before);
}

void workplace::check_refusals(const std::string& command,
                               const std::vector<std::pair<std::string, std::string>>& rows,
                               const process_options& options) const {
  for (const auto& [more, message] : rows) check(command + " " + more, 2, {}, {message}, options);
}

}  // namespace contct
