/// @file
/// A value, or an error with a message that a person can act on.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace carom {

/// Why something could not be done.
struct Error {
  std::string message;  ///< one line without a trailing newline
};

/// Holds a T, or the reason why there is none. It never throws: reading the value of a failed
/// result, or the error of a good one, is a programming mistake (undefined).
template <class T>
class [[nodiscard]] Result {
 public:
  /// A good result.
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  /// A failed result.
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  /// True if there is a value.
  explicit operator bool() const { return state_.index() == 0; }
  /// The value of a good result.
  T& operator*() { return *std::get_if<0>(&state_); }
  /// The value of a good result.
  const T& operator*() const { return *std::get_if<0>(&state_); }
  /// The value of a good result.
  T* operator->() { return std::get_if<0>(&state_); }
  /// The value of a good result.
  const T* operator->() const { return std::get_if<0>(&state_); }
  /// The reason of a failed result.
  const Error& error() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, Error> state_;
};

/// The result of an action that yields no value.
template <>
class [[nodiscard]] Result<void> {
 public:
  /// Success.
  Result() = default;
  /// A failed result.
  Result(Error error) : error_(std::move(error)) {}

  /// True if the action succeeded.
  explicit operator bool() const { return !error_; }
  /// The reason of a failed result.
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace carom
