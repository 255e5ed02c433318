// The reader of options that come as JSON to the C interface. Nothing is run with them: a kernel's name may
// be a command.
#include <cmath>
#include <functional>
#include <stdexcept>

#include "contct/serve/answer.hpp"
#include "fuzz/fuzz.hpp"

namespace {

using contct::fuzz::require;
using contct::serve::request;

/// What is refused is refused by name.
void ask(const std::function<void()>& for_option) {
  try {
    for_option();
  } catch (const std::invalid_argument& e) {
    require(std::string_view(e.what()).starts_with("options: "), "a refusal says what it is about", e.what());
  }
}

/// Each option as the kind of value that it takes.
void ask_for_all(const request& r) {
  constexpr int most = 1000;
  ask([&r] {
    const int whole = r.whole("max_increments", 0, 0, most);
    require(whole >= 0 && whole <= most, "a whole number is in its range");
  });
  ask([&r] { (void)r.flag("envelope"); });
  ask([&r] { (void)r.text("engine", ""); });
  ask([&r] { require(!r.texts("kernels", {"cpp"}).empty(), "there is a kernel"); });
  ask([&r] {
    for (const auto& list : r.lists("numbers"))
      for (const double x : list) require(std::isfinite(x), "a number is finite");
  });
  ask([&r] { (void)r.file(); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(contct::fuzz::text_of(data, size));
  ask([&text] {
    ask_for_all(
        {text.c_str(), {"file", "folder", "kernels", "engine", "envelope", "max_increments", "numbers"}});
  });
  return 0;
}
