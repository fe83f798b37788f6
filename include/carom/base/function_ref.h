/// @file
/// References to functions that a call may use until it returns.
#pragma once

namespace carom {

/// A non-owning reference to a callable, which costs no allocation, unlike std::function. Valid for
/// as long as the callable is.
template <class Signature>
class FunctionRef;

/// The reference to a callable that takes `Args` and returns `R`.
template <class R, class... Args>
class FunctionRef<R(Args...)> {
 public:
  /// Refers to `f`, which must outlive the reference.
  template <class F>
  FunctionRef(const F& f)
      : object_(&f), call_([](const void* object, Args... args) -> R {
          return (*static_cast<const F*>(object))(args...);
        }) {}
  /// Calls it.
  R operator()(Args... args) const { return call_(object_, args...); }

 private:
  const void* object_;
  R (*call_)(const void*, Args...);
};

}  // namespace carom
