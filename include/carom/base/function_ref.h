/// @file
/// A reference to a function of the caller.
#pragma once

#include <type_traits>

namespace carom {

/// A reference to a callable, without ownership and without allocation, unlike std::function.
template <class Signature>
class FunctionRef;

/// Refers to anything that can be called with `Args` and returns R: a lambda, a function object. It
/// must outlive every call. A temporary lambda lives until the end of the full expression, so it
/// may be written straight into the arguments of a call, but not into a variable of options.
template <class R, class... Args>
class FunctionRef<R(Args...)> {
 public:
  /// Refers to nothing; it must not be called.
  FunctionRef() = default;
  /// Refers to `f`.
  template <class F>
    requires(std::is_invocable_r_v<R, const F&, Args...>)
  FunctionRef(const F& f)
      : object_(&f), call_([](const void* object, Args... args) -> R {
          return (*static_cast<const F*>(object))(args...);
        }) {}

  /// Calls the function.
  R operator()(Args... args) const { return call_(object_, args...); }
  /// Whether it refers to a function.
  explicit operator bool() const { return call_ != nullptr; }

 private:
  const void* object_ = nullptr;
  R (*call_)(const void*, Args...) = nullptr;
};

}  // namespace carom
