// What exact arithmetic says of an explained run, in words and as JSON.
#pragma once

#include <string>
#include <vector>

#include "contct/exact/path_1989.hpp"
#include "contct/write/explain.hpp"

namespace contct {

/// The listing's answer, without rounding, to the numbers that a call was given, as they are to the bit. None
/// where one of them is not finite.
[[nodiscard]] std::optional<listing_answer> answer_of(const explained_call& c);

/// A sentence that is added to an explanation; a loud one is in the colour of what is wrong.
struct added_remark {
  std::string words;
  bool loud = false;
};

/// The exact numbers beside each increment: those of the call's own input, and those of the exact path of the
/// 1989 rule. reference/explain-format.md has the members.
class exact_addition {
 public:
  using remarks = std::vector<added_remark>;

  /// `path` observes the same run, in front of what explains it, and must outlive this object; null where the
  /// exact path is not followed, for the reason in `why_no_path`.
  explicit exact_addition(const exact_companion* path, std::string why_no_path = {})
      : path_(path), why_no_path_(std::move(why_no_path)) {}

  /// Called before all others, once for each increment.
  void begin(const explained_increment& i) { call_ = answer_of(i.call); }
  /// Of one pair's s, of SMIN, and of the increment's end.
  [[nodiscard]] remarks of_s(const explained_kernels& of, const explained_increment& i,
                             const explained_pair& p) const;
  [[nodiscard]] remarks of_smin(const explained_kernels& of, const explained_increment& i) const;
  [[nodiscard]] remarks of_end(const explained_kernels& of, const explained_increment& i) const;
  /// Add members to those of an increment, and to those of a pair.
  void put_increment(nlohmann::ordered_json& out, const explained_kernels& of,
                     const explained_increment& i) const;
  void put_pair(nlohmann::ordered_json& out, const explained_kernels& of, const explained_increment& i,
                const explained_pair& p) const;

 private:
  /// The exact path's call; null where there is none that compares.
  [[nodiscard]] const exact_call* path_call() const { return path_ == nullptr ? nullptr : path_->call(); }
  [[nodiscard]] nlohmann::ordered_json path_json(const explained_kernels& of,
                                                 const explained_increment& i) const;

  const exact_companion* path_;
  std::string why_no_path_;
  std::optional<listing_answer> call_;  // of the increment at hand
};

}  // namespace contct
