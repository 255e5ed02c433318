// Values as bytes, for another process of this program.
#pragma once

#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::lab {

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;
template <>
inline constexpr bool is_list<std::string> = true;

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

/// Visits every value that belongs to `value`: `plain(bytes, size)` for what is copied as it is, `resized`
/// for the size of a list and whether an optional value is there. A struct that is more than plain bytes has
/// a function beside it that names its members, for both ways:
///     template <class Visit> void pack(Visit& visit, STRUCT& s) { visit(s.a, s.b); }
template <class Way>
class packing {
 public:
  template <class... Values>
  void operator()(Values&... values) {
    (one(values), ...);
  }

 private:
  [[nodiscard]] Way& way() { return static_cast<Way&>(*this); }

  template <class T>
  void one(T& value) {
    if constexpr (is_list<T>) {
      way().resize(value);
      for (auto& v : value) one(v);
    } else if constexpr (is_optional<T> && !std::is_trivially_copyable_v<T>) {
      way().engage(value);
      if (value) one(*value);
    } else if constexpr (std::is_trivially_copyable_v<T>) {
      way().plain(&value, sizeof value);
    } else {
      pack(*this, value);
    }
  }
};

/// Values into bytes.
class packer : public packing<packer> {
 public:
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  friend packing<packer>;
  void plain(const void* value, std::size_t size) { bytes_.append(static_cast<const char*>(value), size); }
  template <class List>
  void resize(const List& list) {
    const std::size_t size = list.size();
    plain(&size, sizeof size);
  }
  template <class T>
  void engage(const std::optional<T>& value) {
    const bool there = value.has_value();
    plain(&there, sizeof there);
  }
  std::string bytes_;
};

/// Bytes back into values, in the same order. Throws std::length_error where bytes are missing.
class unpacker : public packing<unpacker> {
 public:
  explicit unpacker(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] bool is_at_end() const { return bytes_.empty(); }

 private:
  friend packing<unpacker>;
  void plain(void* value, std::size_t size) {
    if (size > bytes_.size()) throw std::length_error("packed values end too early");
    std::memcpy(value, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  template <class List>
  void resize(List& list) {
    std::size_t size = 0;
    plain(&size, sizeof size);
    if (size > bytes_.size()) throw std::length_error("packed values end too early");
    list.resize(size);
  }
  template <class T>
  void engage(std::optional<T>& value) {
    bool there = false;
    plain(&there, sizeof there);
    value.reset();
    if (there) value.emplace();
  }
  std::string_view bytes_;
};

/// All of `values` as bytes.
template <class... Values>
[[nodiscard]] std::string packed(Values&&... values) {
  packer p;
  p(values...);
  return p.take();
}

/// The same back, into `values`.
template <class... Values>
void unpack(std::string_view bytes, Values&... values) {
  unpacker u(bytes);
  u(values...);
  if (!u.is_at_end()) throw std::length_error("more is packed than was asked for");
}

}  // namespace contct::lab
