// Text inside markup.
#pragma once

#include <string>
#include <string_view>

namespace contct {

/// Text as it may stand between tags and in quoted attributes of HTML and XML. Control characters, which
/// XML cannot hold at all, are shown as U+FFFD.
[[nodiscard]] std::string markup_text(std::string_view text);

}  // namespace contct
