/// @file
/// A reference to a function of the caller.
#pragma once

#include <type_traits>

namespace carom {

/// A reference to a callable, without ownership and without allocation, unlike std::function.
template <class Signature>
class FunctionRef;

/// Refers to anything that can be called with `Args` and returns R: a lambda, a function object, a
/// function. It must outlive every call. A temporary lambda lives until the end of the full
/// expression, so it may be written straight into the arguments of a call, but not into a variable
/// of options.
template <class R, class... Args>
class FunctionRef<R(Args...)> {
 public:
  /// Refers to nothing; it must not be called.
  FunctionRef() = default;
  /// Refers to `f`.
  template <class F>
  requires(std::is_object_v<F>&& std::is_invocable_r_v<R, const F&, Args...>)
      FunctionRef(const F& f)
      : target_{.object = &f}, call_([](Target target, Args... args) -> R {
          return (*static_cast<const F*>(target.object))(args...);
        }) {}
  /// Refers to a plain function.
  FunctionRef(R (*f)(Args...))
      : target_{.function = reinterpret_cast<void (*)()>(f)},
        call_([](Target target, Args... args) -> R {
          return reinterpret_cast<R (*)(Args...)>(target.function)(args...);
        }) {}

  /// Calls the function.
  R operator()(Args... args) const { return call_(target_, args...); }
  /// Whether it refers to a function.
  explicit operator bool() const { return call_ != nullptr; }

 private:
  union Target {
    const void* object;
    void (*function)();
  };

  Target target_{.object = nullptr};
  R (*call_)(Target, Args...) = nullptr;
};

}  // namespace carom
