// A kernel made for a test.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "contct/kernel/kernel.hpp"

namespace contct {

/// A kernel that answers by a function of the test, by default under the corrected rule.
class made_kernel final : public kernel {
 public:
  explicit made_kernel(std::function<void(call<double>&)> answer, contact_rule rule = contact_rule::corrected)
      : facts_{"made", 8, rule, "", "", "", false}, answer_(std::move(answer)) {}
  [[nodiscard]] const kernel_facts& facts() const override { return facts_; }
  void answer(call<double>& c) override { answer_(c); }
  std::string take_text() override { return {}; }

 private:
  kernel_facts facts_;
  std::function<void(call<double>&)> answer_;
};

}  // namespace contct
