// Makes clouds of points from bytes, in families that are hard for hulls and meshes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <vector>

#include "fuzz/take.h"

namespace carom::fuzz {

enum class Family : uint8_t {
  any,       // floats of any bits
  box,       // anywhere in a box
  lattice,   // few distinct coordinates
  flat,      // in a plane except for rounding
  noisy,     // a little off the plane
  line,      // on a line except for rounding
  repeated,  // many are equal to one of the first four
  sliver,    // two axes are short
  wedge,     // two planes that meet at a small angle
  needle,    // close to one axis, except the first point
  count
};

// Mostly one metre, otherwise 1e-30 to 1e18.
inline double take_size(Data& data) {
  const auto power = take<uint8_t>(data);
  return power < 192 ? 1 : std::pow(10.0, power % 49 - 30);
}

// Reads a cloud: a byte for the family, one for whether it is turned and moved, one for its
// thinness; then six bytes for each point, or twelve for `any`.
class CloudReader {
 public:
  CloudReader(double size, Data& data) : size_(size), data_(data) {
    family_ = static_cast<Family>(take<uint8_t>(data) % static_cast<int>(Family::count));
    const auto place = take<uint8_t>(data);
    if (place & 1) turn_ = take_orientation(data).cast<double>();
    if (place & 2) middle_ = take_vector(data) * std::ldexp(1, place >> 3);
    if (turn_.norm() > 0) turn_.normalize();
    const auto thin = take<uint8_t>(data);
    thinness_ = std::ldexp(1, -(thin % 64));
    other_thinness_ = std::ldexp(1, -(thin / 64 * 16));
  }

  std::vector<Eigen::Vector3f> points(size_t count) {
    std::vector<Eigen::Vector3f> all;
    while (all.size() < count) all.push_back(next(all));
    return all;
  }

 private:
  Eigen::Vector3f next(const std::vector<Eigen::Vector3f>& before) {
    if (family_ == Family::any) {
      const float x = take<float>(data_), y = take<float>(data_);
      return {x, y, take<float>(data_)};
    }
    const Eigen::Vector3d p = take_vector(data_);
    if (family_ == Family::repeated && before.size() >= 4 && p.x() < 0) {
      return before[static_cast<size_t>(-4 * p.x()) % 4];
    }
    const Eigen::Vector3d shaped = before.empty() && family_ == Family::needle ? p : formed(p);
    return ((middle_ + turn_ * shaped) * size_).cast<float>();
  }

  Eigen::Vector3d formed(const Eigen::Vector3d& p) const {
    const double height =
        p.x() / 3 + p.y() / 7;  // a tilted plane whose coordinates round in every bit
    switch (family_) {
      case Family::lattice:
        return (p * 2).array().round();
      case Family::flat:
        return {p.x(), p.y(), height};
      case Family::noisy:
        return {p.x(), p.y(), height + p.z() * thinness_};
      case Family::line:
        return {p.x(), p.x() / 3, p.x() / 7};
      case Family::sliver:
        return {p.x(), p.y() * thinness_, p.z() * other_thinness_};
      case Family::wedge:
        return {p.x(), p.y(), p.z() < 0 ? 0 : std::abs(p.y()) * thinness_};
      case Family::needle:
        return {p.x() * thinness_, p.y() * thinness_ * other_thinness_, p.z()};
      default:
        return p;
    }
  }

  double size_;
  Data& data_;
  Family family_;
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double thinness_;
  double other_thinness_;
};

}  // namespace carom::fuzz
