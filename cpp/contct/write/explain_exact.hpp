// What exact arithmetic says of an explained run, in words and as JSON.
#pragma once

#include <string>
#include <vector>

#include "contct/exact/path_1989.hpp"
#include "contct/write/explain.hpp"

namespace contct::write {

/// The listing's answer, without rounding, to the numbers that a call was given, as they are to the bit. None
/// where one of them is not finite.
[[nodiscard]] std::optional<listing_answer> answer_of(const explained_call& c);

/// The exact numbers beside each increment: those of the call's own input, and those of the exact path of the
/// 1989 rule. reference/explain-format.md has the members.
class exact_addition final : public explain_addition {
 public:
  /// `path` observes the same run, in front of what explains it, and must outlive this object; null where the
  /// exact path is not followed, for the reason in `why_no_path`.
  explicit exact_addition(const exact_companion* path, std::string why_no_path = {})
      : path_(path), why_no_path_(std::move(why_no_path)) {}

  void begin(const explained_increment& i) override { call_ = answer_of(i.call); }
  [[nodiscard]] remarks of_s(const explained_kernels& of, const explained_increment& i,
                             const explained_pair& p) const override;
  [[nodiscard]] remarks of_smin(const explained_kernels& of, const explained_increment& i) const override;
  [[nodiscard]] remarks of_end(const explained_kernels& of, const explained_increment& i) const override;
  void put_increment(nlohmann::ordered_json& out, const explained_kernels& of,
                     const explained_increment& i) const override;
  void put_pair(nlohmann::ordered_json& out, const explained_kernels& of, const explained_increment& i,
                const explained_pair& p) const override;

 private:
  /// The exact path's call; null where there is none that compares.
  [[nodiscard]] const exact_call* path_call() const { return path_ == nullptr ? nullptr : path_->call(); }
  [[nodiscard]] nlohmann::ordered_json path_json(const explained_kernels& of,
                                                 const explained_increment& i) const;

  const exact_companion* path_;
  std::string why_no_path_;
  std::optional<listing_answer> call_;  // of the increment at hand
};

}  // namespace contct::write
