// A kernel made for a test.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "contct/kernel/kernel.hpp"

namespace contct {

/// A kernel that answers by a function of the test, by default under the corrected rule and without a text.
class made_kernel final : public function_kernel {
 public:
  /// `last_text` is the text of the last call.
  explicit made_kernel(const std::function<void(call<double>&)>& answer,
                       contact_rule rule = contact_rule::corrected,
                       const std::shared_ptr<const std::string>& last_text = nullptr)
      : function_kernel({"made", 8, rule, "", "", "", last_text != nullptr},
                        [answer, last_text](call<double>& c, std::string& text) {
                          answer(c);
                          if (last_text) text = *last_text;
                        }) {}
};

}  // namespace contct
