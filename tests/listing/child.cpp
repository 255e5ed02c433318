#include "listing/child.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace contct_test {
namespace {

const unsigned alarm_seconds = 60;
const int could_not_start = 127;

/// In the child: point a stream at a file. Only calls that are safe between fork and exec.
bool redirect(int stream, const char* file) {
  const int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  return opened >= 0 && dup2(opened, stream) >= 0 && close(opened) == 0;
}

/// In the child: become the program. Limits and alarm outlive exec.
[[noreturn]] void become(char* const* command, const char* folder, unsigned cpu_seconds) {
  const rlimit limit{cpu_seconds, cpu_seconds};
  if (chdir(folder) == 0 && redirect(STDOUT_FILENO, "said") && redirect(STDERR_FILENO, "complained") &&
      setrlimit(RLIMIT_CPU, &limit) == 0) {
    alarm(alarm_seconds);
    execv(command[0], command);
  }
  _exit(could_not_start);
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  }
  return status;
}

}  // namespace

child_end run_child(const std::vector<std::string>& command, const std::filesystem::path& folder,
                    unsigned cpu_seconds) {
  std::vector<std::string> words = command;
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const pid_t child = fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) become(pointers.data(), folder.c_str(), cpu_seconds);
  const int status = wait_for(child);

  const bool exited = WIFEXITED(status);
  if (exited && WEXITSTATUS(status) == could_not_start) {
    throw std::runtime_error("cannot start " + command.front());
  }
  return {exited, exited ? WEXITSTATUS(status) : WTERMSIG(status), file_text(folder / "said"),
          file_text(folder / "complained")};
}

std::string file_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace contct_test
