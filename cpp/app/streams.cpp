#include "app/streams.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace contct::app {

void hold_standard_streams() {
  // Opened the wrong way round, input and output that were closed still fail, and are noticed.
  constexpr std::pair<int, int> held[] = {
      {STDIN_FILENO, O_WRONLY}, {STDOUT_FILENO, O_RDONLY}, {STDERR_FILENO, O_WRONLY}};
  for (const auto& [stream, flags] : held) {
    if (fcntl(stream, F_GETFD) < 0) (void)open("/dev/null", flags);  // the least number free: this one
  }
}

}  // namespace contct::app
