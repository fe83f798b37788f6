// Columns of many bodies and of their motions. A loop over one asks what the view looks like before
// its first body, and not at each.
#pragma once

#include <cstddef>
#include <cstring>

#include "impacts/simple_times.h"
#include "shapes/body_reader.h"

namespace carom {

// Element i of an array with a stride; zero if there is no array.
template <class T>
class Strided {
 public:
  Strided(const void* data, size_t stride)
      : data_(static_cast<const char*>(data ? data : &kNone)), stride_(data ? stride : 0) {}

  T operator[](size_t i) const {
    T value;
    std::memcpy(&value, data_ + i * stride_, sizeof(T));
    return value;
  }

 private:
  static constexpr T kNone{};
  const char* data_;
  size_t stride_;
};

// The bodies of a side. The view is copied, so that the compiler knows that writes do not change
// it.
struct BodyColumns {
  const Collidables bodies;
  const SweepView sweep;

  explicit BodyColumns(const MovingSide& side) : bodies(side.bodies), sweep(side.sweep) {}

  BodyReader reader() const { return {bodies}; }

  Strided<Position<float>> displacement() const {
    return {sweep.displacement, sweep.displacement_stride};
  }
  Strided<Position<float>> rotation() const { return {sweep.rotation, sweep.rotation_stride}; }

  // Calls use(positions).
  template <class Use>
  void with_positions(const Use& use) const {
    const PositionView& view = bodies.position;
    if (reader().is_float64()) return use(Strided<Position<double>>(view.data, view.stride));
    use(Strided<Position<float>>(view.data, view.stride));
  }

  // Calls use(radii).
  template <class Use>
  void with_radii(const Use& use) const {
    const PositionView& view = bodies.position;
    const char* base = static_cast<const char*>(view.data);
    switch (view.radius_layout) {
      case RadiusLayout::none:
        return use(Strided<float>(nullptr, 0));
      case RadiusLayout::column:
        return use(Strided<float>(view.radius, view.radius_stride));
      case RadiusLayout::fourth:
        if (reader().is_float64()) {
          return use(Strided<double>(base + sizeof(Position<double>), view.stride));
        }
        return use(Strided<float>(base + sizeof(Position<float>), view.stride));
    }
  }
};

}  // namespace carom
