// A kernel that is asked each call of a leader after it, and its answers compared to the bit.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/compare/compare.hpp"
#include "contct/compare/margin.hpp"
#include "contct/kernel/call_inputs.hpp"
#include "contct/kernel/kernel.hpp"

namespace contct::compare {

/// The first call in which a follower did not answer as the leader.
struct mismatch_report {
  std::int64_t call = 0;  ///< from 1
  std::string leader;     ///< names of the kernels
  std::string follower;
  mismatch where;
  std::vector<decision> decisions;  ///< of the leader in that call
};

/// Two lines: "call 7: mine differs in SS(3): fortran has 0x1p-1, mine has 0x1p-2 (4503599627370496 ULP)",
/// and its branch margin.
[[nodiscard]] std::vector<std::string> words_of(const mismatch_report& f);

/// The branch margin: the narrowest decision of the call, and what follows from it.
[[nodiscard]] std::string margin_words(const mismatch_report& f);

/// Throws std::invalid_argument when the two differ in precision or rule: their answers cannot be
/// equal to the bit.
void refuse_unequal(const kernel_facts& leader, const kernel_facts& follower);

/// Ask `k` a call that was answered already, whose ISEP was `isep_before`, and compare SMIN, all of SS and
/// all of ISEP; the text too, as `equality` says, where there is `text` and the kernel writes any. A kernel
/// that fails has one mismatch, in the field "answer". `out` receives its outputs.
std::optional<mismatch> ask_and_compare(kernel& k, const call<double>& answered,
                                        std::span<const int> isep_before,
                                        std::optional<std::string_view> text, text_equality equality,
                                        call_outputs& out, tally& t);

/// Asks a kernel the calls of a leader, counts what is compared, and keeps the first mismatch.
class follower {
 public:
  /// `k` must outlive this object. The leader's facts say what its calls are: precision, text.
  follower(kernel_facts leader, kernel& k);

  /// Ask call `number` (from 1), which the leader answered. `text` is the leader's unit 26, or nothing where
  /// it is not to be compared.
  const std::optional<mismatch>& ask(std::int64_t number, const call<double>& answered,
                                     std::span<const int> isep_before, std::optional<std::string_view> text);
  /// Keep a mismatch that was found in call `number`, unless an earlier call has one.
  void note(std::int64_t number, const mismatch& found, const call<double>& answered,
            std::span<const int> isep_before);

  [[nodiscard]] kernel& asked() const { return *kernel_; }
  /// How its text is compared with the leader's.
  [[nodiscard]] text_equality equality() const { return text_equality_of(leader_, kernel_->facts()); }
  /// The outputs of the last call, and where they differ first from the leader's.
  [[nodiscard]] const call_outputs& answer() const { return answer_; }
  [[nodiscard]] const std::optional<mismatch>& difference() const { return difference_; }
  [[nodiscard]] bool answered() const { return !difference_ || difference_->field != "answer"; }
  [[nodiscard]] const std::optional<mismatch_report>& first() const { return first_; }
  tally compared;

 private:
  kernel_facts leader_;
  kernel* kernel_;
  call_outputs answer_;
  std::optional<mismatch> difference_;
  std::optional<mismatch_report> first_;
};

}  // namespace contct::compare
