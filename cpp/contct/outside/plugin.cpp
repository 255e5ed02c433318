// A kernel that is a shared library with the plug-in ABI, loaded and called in a child process.
#include "contct/outside/plugin.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "contct/kernel/fortran.hpp"
#include "contct/outside/child_process.hpp"

namespace contct::outside {
namespace {

using abi_function = decltype(&contct_kernel_abi);
using kernel_function = decltype(&contct_kernel);
constexpr std::string_view ready_word = "ready";
constexpr const char* too_slow = "did not load within its time";

struct unmapper {
  std::size_t bytes = 0;
  void operator()(std::byte* memory) const { munmap(memory, bytes); }
};

/// Memory that parent and child both see.
using shared_memory = std::unique_ptr<std::byte[], unmapper>;

shared_memory share_memory(std::size_t bytes) {
  void* const at = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (at == MAP_FAILED)
    throw std::system_error(errno, std::generic_category(), "no memory to share with a plug-in");
  return {static_cast<std::byte*>(at), unmapper{bytes}};
}

enum array_index { dd, dtest, cc, ss, smin, id, isep, isurf, arrays };
constexpr const char* names[arrays] = {"DD", "DTEST", "CC", "SS", "SMIN", "ID", "ISEP", "ISURF"};

/// What no kernel may touch, in front of each array and behind it.
constexpr std::size_t fence = 256;
constexpr std::byte fence_byte{0xA5};

/// Where the arrays of a call are in the shared memory, whose beginning holds a copy of this for the child.
struct layout {
  int nc, ndof, indof, ndofpn;
  std::size_t at[arrays] = {};       // the first byte of each array, from the beginning of the memory
  std::size_t bytes[arrays];         // of each array
  std::size_t end = sizeof(layout);  // of the last fence

  explicit layout(const call<double>& c)
      : nc(c.nc()),
        ndof(static_cast<int>(c.dd.size())),
        indof(c.dof.indof),
        ndofpn(c.dof.ndofpn),
        bytes{c.dd.size_bytes(), c.dtest.size_bytes(), c.cc.size_bytes(),   c.ss.size_bytes(),
              sizeof(double),    c.id.size_bytes(),    c.isep.size_bytes(), c.isurf.size_bytes()} {
    constexpr std::size_t alignment = 16;
    for (int a = 0; a < arrays; ++a) {
      at[a] = (end + fence + alignment - 1) / alignment * alignment;
      end = at[a] + bytes[a] + fence;
    }
  }
};

/// The numbers at a place in the shared memory.
template <class T>
T* at(std::byte* memory, std::size_t place) {
  return reinterpret_cast<T*>(memory + place);  // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
}

/// What the child does until its channel is closed: wait for a call, make it, say so.
void serve(std::byte* m, kernel_function ask, int channel) {
  const layout& l = *at<layout>(m, 0);
  const auto reals = [m, &l](array_index a) { return at<double>(m, l.at[a]); };
  const auto wholes = [m, &l](array_index a) { return at<int>(m, l.at[a]); };
  char word = 0;
  while (::read(channel, &word, 1) == 1) {
    ask(reals(dd), reals(dtest), reals(cc), reals(ss), reals(smin), wholes(id), wholes(isep), wholes(isurf),
        l.nc, l.indof, l.ndofpn, l.ndof);
    if (::write(channel, &word, 1) != 1) return;
  }
}

/// What the child does: load the library, say "ready" or what is wrong, serve.
void host(std::byte* memory, const std::string& path, int channel) {
  const auto say = [channel](const std::string& words) {
    [[maybe_unused]] const ssize_t n = ::write(channel, words.data(), words.size());
  };
  fortran::forget_unit_26();  // the plug-in may be FORTRAN and write to its own unit 26
  // dlopen looks for a name without a slash among the system's libraries only.
  void* const library =
      dlopen((path.find('/') == std::string::npos ? "./" + path : path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return say(std::string("cannot be loaded: ") + dlerror());
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): dlsym gives no other type
  const auto version = reinterpret_cast<abi_function>(dlsym(library, "contct_kernel_abi"));
  const auto ask = reinterpret_cast<kernel_function>(dlsym(library, "contct_kernel"));
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  if (version == nullptr || ask == nullptr)
    return say(std::string("found no symbol ") +
               (version == nullptr ? "contct_kernel_abi" : "contct_kernel") +
               "; allowed: a library that exports contct_kernel_abi and contct_kernel");
  if (const int found = version(); found != CONTCT_KERNEL_ABI)
    return say("found ABI " + std::to_string(found) + "; allowed: " + std::to_string(CONTCT_KERNEL_ABI));
  say(std::string(ready_word));
  serve(memory, ask, channel);
}

class plugin_kernel final : public kernel_in_child {
 public:
  plugin_kernel(const std::string& path, const outside_limits& limits)
      : kernel_in_child(facts_of_plugin(path), limits), path_(path) {
    constexpr std::size_t enough_for_most = std::size_t{1} << 18;
    memory_ = share_memory(enough_for_most);
    if (const std::string wrong = start(); !wrong.empty())
      throw std::invalid_argument("plugin:" + path + ": " + wrong);
  }

  void answer(call<double>& c) override {
    refuse_when_enough();
    const layout l(c);
    make_room(l.end);
    if (!child_)
      if (const std::string wrong = start(); !wrong.empty()) fail(wrong, wrong == too_slow);
    write_call(l, c);
    const auto until = deadline();
    std::string word;
    auto how = child_->send("?", until);
    if (how == child_process::sent::whole) how = child_->receive(word, until);
    if (how != child_process::sent::whole) fail_without_answer(how);
    refuse_changes(l, c);
    std::byte* const m = memory_.get();
    c.smin = *at<double>(m, l.at[smin]);
    std::copy_n(at<double>(m, l.at[ss]), c.ss.size(), c.ss.begin());
    std::copy_n(at<int>(m, l.at[isep]), c.isep.size(), c.isep.begin());
  }

  std::string take_text() override { return {}; }

 private:
  /// Start the child. Returns what is wrong with the library.
  std::string start() {
    child_.emplace([this](int channel) { host(memory_.get(), path_, channel); });
    std::string word;
    const auto how = child_->receive(word, deadline());
    if (how == child_process::sent::whole && word == ready_word) return "";
    const std::string words = child_->end();
    child_.reset();
    if (how == child_process::sent::whole) return word;
    return how == child_process::sent::late ? too_slow : words + " while it was loaded";
  }

  /// Memory is shared at the fork: more of it needs another child.
  void make_room(std::size_t bytes) {
    if (bytes <= memory_.get_deleter().bytes) return;
    child_.reset();
    memory_ = share_memory(2 * bytes);
  }

  /// The caller's arrays, in the listing's order.
  static std::array<const void*, arrays> arrays_of(const call<double>& c) {
    return {c.dd.data(), c.dtest.data(), c.cc.data(),   c.ss.data(),
            &c.smin,     c.id.data(),    c.isep.data(), c.isurf.data()};
  }

  void write_call(const layout& l, const call<double>& c) {
    std::byte* const m = memory_.get();
    std::memset(m, std::to_integer<int>(fence_byte), l.end);
    std::memcpy(m, &l, sizeof l);
    const auto from = arrays_of(c);
    for (int a = 0; a < arrays; ++a)
      if (l.bytes[a] > 0) std::memcpy(m + l.at[a], from[a], l.bytes[a]);
  }

  /// Fences and inputs must be as they were.
  void refuse_changes(const layout& l, const call<double>& c) {
    const std::byte* const m = memory_.get();
    const auto from = arrays_of(c);
    std::string words;
    for (int a = 0; a < arrays; ++a) {
      if (!intact(m + l.at[a] - fence)) words = std::string("wrote before the start of ") + names[a];
      if (!intact(m + l.at[a] + l.bytes[a])) words = std::string("wrote past the end of ") + names[a];
    }
    for (const array_index a : {dd, dtest, cc, id, isurf}) {
      if (l.bytes[a] > 0 && std::memcmp(m + l.at[a], from[a], l.bytes[a]) != 0)
        words = std::string("changed its input ") + names[a];
    }
    if (!words.empty()) fail(words);  // with a fresh child next: what else it wrote is not known
  }

  static bool intact(const std::byte* fence_at) {
    return std::all_of(fence_at, fence_at + fence, [](std::byte b) { return b == fence_byte; });
  }

  std::string path_;
  shared_memory memory_;
};

}  // namespace

std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& limits) {
  return std::make_unique<plugin_kernel>(path, limits);
}

}  // namespace contct::outside
