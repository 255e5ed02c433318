// A kernel that is a shared library with the plug-in ABI, loaded and called in a child process.
#include "contct/outside/plugin.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "contct/kernel/fortran.hpp"
#include "contct/outside/child_process.hpp"
#include "contct/outside/outside.hpp"

namespace contct {
namespace {

using abi_function = decltype(&contct_kernel_abi);
using kernel_function = decltype(&contct_kernel);
constexpr std::string_view ready_word = "ready";
constexpr const char* too_slow = "did not load within its time";

/// Memory that parent and child both see, as long as this object lives.
class shared_memory {
 public:
  explicit shared_memory(std::size_t bytes) : size_(bytes) {
    at_ = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (at_ == MAP_FAILED)
      throw std::system_error(errno, std::generic_category(), "no memory to share with a plug-in");
  }
  ~shared_memory() { munmap(at_, size_); }
  shared_memory(const shared_memory&) = delete;
  shared_memory& operator=(const shared_memory&) = delete;

  [[nodiscard]] std::byte* data() const { return static_cast<std::byte*>(at_); }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  void* at_;
  std::size_t size_;
};

/// One array of a call in shared memory, between two fences that nobody may touch.
struct fenced_array {
  static constexpr std::size_t fence = 256;
  static constexpr unsigned char fence_byte = 0xA5;
  const char* name;
  std::size_t at;     // of its first element
  std::size_t bytes;  // of all

  [[nodiscard]] std::size_t end() const { return (at + bytes + fence + 15) / 16 * 16; }
};

/// Where everything of a call of `nc` pairs and `dofs` dofs stands. The child works it out again.
struct layout {
  int nc, dofs, indof, ndofpn;

  [[nodiscard]] std::vector<fenced_array> arrays() const {
    const auto pairs = static_cast<std::size_t>(nc);
    const auto reals = static_cast<std::size_t>(dofs) * sizeof(double);
    std::vector<fenced_array> all = {{"DD", 0, reals},
                                     {"DTEST", 0, reals},
                                     {"CC", 0, pairs * sizeof(double)},
                                     {"SS", 0, pairs * sizeof(double)},
                                     {"SMIN", 0, sizeof(double)},
                                     {"ID", 0, pairs * sizeof(int)},
                                     {"ISEP", 0, pairs * sizeof(int)},
                                     {"ISURF", 0, pairs * sizeof(int)}};
    std::size_t at = 64;  // behind this layout itself
    for (fenced_array& a : all) {
      a.at = at + fenced_array::fence;
      at = a.end();
    }
    return all;
  }
  [[nodiscard]] std::size_t bytes() const { return arrays().back().end() + fenced_array::fence; }
};
enum array_index { dd, dtest, cc, ss, smin, id, isep, isurf };

template <class T>
T* at(std::byte* memory, const fenced_array& a) {
  return reinterpret_cast<T*>(memory + a.at);
}

/// What the child does for ever: wait for a call, make it, say so.
void serve(const shared_memory& memory, kernel_function ask, int channel) {
  char word = 0;
  while (read(channel, &word, 1) == 1) {
    layout l{};
    std::memcpy(&l, memory.data(), sizeof l);
    const std::vector<fenced_array> a = l.arrays();
    std::byte* const m = memory.data();
    ask(at<double>(m, a[dd]), at<double>(m, a[dtest]), at<double>(m, a[cc]), at<double>(m, a[ss]),
        at<double>(m, a[smin]), at<int>(m, a[id]), at<int>(m, a[isep]), at<int>(m, a[isurf]), l.nc, l.indof,
        l.ndofpn, l.dofs);
    if (write(channel, &word, 1) != 1) return;
  }
}

/// What the child does: load the library, say "ready" or what is wrong, serve.
void host(const shared_memory& memory, const std::string& path, int channel) {
  const auto say = [channel](const std::string& words) { (void)!write(channel, words.data(), words.size()); };
  fortran::forget_unit_26();  // the plug-in may be FORTRAN, with a unit 26 of its own
  // dlopen looks for a name without a slash among the system's libraries only.
  void* const library =
      dlopen((path.find('/') == std::string::npos ? "./" + path : path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return say(std::string("cannot be loaded: ") + dlerror());
  const auto version = reinterpret_cast<abi_function>(dlsym(library, "contct_kernel_abi"));
  const auto ask = reinterpret_cast<kernel_function>(dlsym(library, "contct_kernel"));
  if (version == nullptr || ask == nullptr)
    return say(std::string("found no symbol ") +
               (version == nullptr ? "contct_kernel_abi" : "contct_kernel") +
               "; allowed: a library that exports contct_kernel_abi and contct_kernel");
  if (const int found = version(); found != CONTCT_KERNEL_ABI)
    return say("found ABI " + std::to_string(found) + "; allowed: " + std::to_string(CONTCT_KERNEL_ABI));
  say(std::string(ready_word));
  serve(memory, ask, channel);
}

class plugin_kernel final : public kernel {
 public:
  plugin_kernel(const std::string& path, const outside_limits& limits)
      : facts_(facts_of_plugin(path)), path_(path), limits_(limits), failures_(limits) {
    constexpr std::size_t enough_for_most = std::size_t{1} << 18;
    memory_.emplace(enough_for_most);
    if (const std::string wrong = start(); !wrong.empty())
      throw std::invalid_argument("plugin:" + path + ": " + wrong);
  }

  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }

  void answer(call<double>& c) override {
    failures_.refuse_when_enough();
    const layout l{c.nc(), static_cast<int>(c.dd.size()), c.dof.indof, c.dof.ndofpn};
    make_room(l.bytes());
    if (!child_) {
      const std::string wrong = start();
      if (wrong == too_slow) failures_.fail_late(wrong);
      if (!wrong.empty()) failures_.fail(wrong);
    }
    put(l, c);
    const auto deadline = child_process::clock::now() + limits_.patience;
    std::string word;
    child_process::sent how = child_->send("?", deadline);
    if (how == child_process::sent::whole) how = child_->receive(word, deadline);
    if (how != child_process::sent::whole) {
      const std::string words = child_->end();
      child_.reset();
      if (how == child_process::sent::late)
        failures_.fail_late("did not answer within " + std::to_string(limits_.patience.count()) + " ms");
      failures_.fail(words);
    }
    refuse_trespass(l, c);
    take(l, c);
  }

  std::string take_text() override { return {}; }

 private:
  /// Start the child. Returns what is wrong with the library.
  std::string start() {
    child_.emplace([this](int channel) { host(*memory_, path_, channel); });
    std::string word;
    const auto how = child_->receive(word, child_process::clock::now() + limits_.patience);
    if (how == child_process::sent::whole && word == ready_word) return "";
    const std::string words = child_->end();
    child_.reset();
    if (how == child_process::sent::whole) return word;
    return how == child_process::sent::late ? too_slow : words + " while it was loaded";
  }

  /// Memory is shared at the fork: more of it needs another child.
  void make_room(std::size_t bytes) {
    if (bytes <= memory_->size()) return;
    child_.reset();
    memory_.emplace(2 * bytes);
  }

  void put(const layout& l, const call<double>& c) {
    const std::vector<fenced_array> a = l.arrays();
    std::byte* const m = memory_->data();
    std::memset(m, fenced_array::fence_byte, l.bytes());
    std::memcpy(m, &l, sizeof l);
    std::copy(c.dd.begin(), c.dd.end(), at<double>(m, a[dd]));
    std::copy(c.dtest.begin(), c.dtest.end(), at<double>(m, a[dtest]));
    std::copy(c.cc.begin(), c.cc.end(), at<double>(m, a[cc]));
    std::copy(c.ss.begin(), c.ss.end(), at<double>(m, a[ss]));
    *at<double>(m, a[smin]) = c.smin;
    std::copy(c.id.begin(), c.id.end(), at<int>(m, a[id]));
    std::copy(c.isep.begin(), c.isep.end(), at<int>(m, a[isep]));
    std::copy(c.isurf.begin(), c.isurf.end(), at<int>(m, a[isurf]));
  }

  /// Fences and inputs must be as they were.
  void refuse_trespass(const layout& l, const call<double>& c) {
    const std::vector<fenced_array> a = l.arrays();
    std::byte* const m = memory_->data();
    std::string words;
    for (const fenced_array& array : a) {
      if (!fence_stands(m + array.at - fenced_array::fence))
        words = std::string("wrote in front of ") + array.name;
      if (!fence_stands(m + array.at + array.bytes))
        words = std::string("wrote behind the end of ") + array.name;
    }
    const auto kept = [&](array_index i, const void* before) {
      if (a[i].bytes > 0 && std::memcmp(m + a[i].at, before, a[i].bytes) != 0)
        words = std::string("changed its input ") + a[i].name;
    };
    kept(dd, c.dd.data());
    kept(dtest, c.dtest.data());
    kept(cc, c.cc.data());
    kept(id, c.id.data());
    kept(isurf, c.isurf.data());
    if (words.empty()) return;
    child_.reset();  // who knows what else it wrote
    failures_.fail(words);
  }

  static bool fence_stands(const std::byte* fence) {
    return std::all_of(fence, fence + fenced_array::fence,
                       [](std::byte b) { return b == std::byte{fenced_array::fence_byte}; });
  }

  void take(const layout& l, call<double>& c) {
    const std::vector<fenced_array> a = l.arrays();
    std::byte* const m = memory_->data();
    c.smin = *at<double>(m, a[smin]);
    std::copy_n(at<double>(m, a[ss]), c.ss.size(), c.ss.begin());
    std::copy_n(at<int>(m, a[isep]), c.isep.size(), c.isep.begin());
  }

  kernel_facts facts_;
  std::string path_;
  outside_limits limits_;
  failure_count failures_;
  std::optional<shared_memory> memory_;
  std::optional<child_process> child_;
};

}  // namespace

kernel_facts facts_of_plugin(const std::string& path) {
  return {"plugin:" + path, 8, "listing", "a shared library", "", "", false};
}

std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& limits) {
  return std::make_unique<plugin_kernel>(path, limits);
}

}  // namespace contct
