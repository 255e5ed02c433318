// What the child process of a plug-in does: load it and make calls.
#include "contct/kernel/plugin.h"

#include <dlfcn.h>
#include <unistd.h>

#include <stdexcept>

#include "contct/kernel/child_kernel.hpp"
#include "contct/kernel/fortran.hpp"
#include "contct/kernel/own_kernel.hpp"
#include "contct/kernel/trace.hpp"

namespace contct {
namespace {

using abi_function = decltype(&contct_kernel_abi);

/// Make the call, and say what came of it as trace text.
std::string answer_to(std::string_view asked, kernel_procedure* ask) {
  recorded_call recorded;
  trace_reader(asked, "the call").next_inputs(recorded);
  call<double> c = recorded.out.prepare(recorded.in);
  put_guarded(c, ask);
  std::string text;
  append_answer(c.smin, c.ss, c.isep, "", text);
  return text;
}

void say(int channel, std::string_view words) {
  while (!words.empty()) {
    const ssize_t n = ::write(channel, words.data(), words.size());
    if (n <= 0) return;
    words.remove_prefix(n);
  }
}

/// What the child does until its channel is closed: wait for a call, make it, say what came of it.
void serve(kernel_procedure* ask, int channel) {
  char block[1 << 14];
  std::string asked;
  for (ssize_t n = 0; (n = ::read(channel, block, sizeof block)) > 0;) {
    asked.append(block, n);
    if (!asked.ends_with("\nask\n")) continue;
    try {
      say(channel, answer_to(asked, ask));
    } catch (const std::exception& e) {
      say(channel, std::string(fault_word) + e.what() + "\nend\n");
    }
    asked.clear();
  }
}

}  // namespace

void host_plugin(const std::string& path, int channel) {
  fortran::forget_unit_26();  // the plug-in may be FORTRAN and write to its own unit 26
  // dlopen looks for a name without a slash among the system's libraries only.
  void* const library =
      dlopen((path.find('/') == std::string::npos ? "./" + path : path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return say(channel, std::string("cannot be loaded: ") + dlerror());
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): dlsym gives no other type
  const auto version = reinterpret_cast<abi_function>(dlsym(library, "contct_kernel_abi"));
  const auto ask = reinterpret_cast<kernel_procedure*>(dlsym(library, "contct_kernel"));
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  if (version == nullptr || ask == nullptr)
    return say(channel, std::string("found no symbol ") +
                            (version == nullptr ? "contct_kernel_abi" : "contct_kernel") +
                            "; allowed: a library that exports contct_kernel_abi and contct_kernel");
  if (const int found = version(); found != CONTCT_KERNEL_ABI)
    return say(channel,
               "found ABI " + std::to_string(found) + "; allowed: " + std::to_string(CONTCT_KERNEL_ABI));
  say(channel, ready_word);
  serve(ask, channel);
}

}  // namespace contct
