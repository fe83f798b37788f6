#include "cli/verify_text.h"

#include <cstdio>

namespace carom::cli {
namespace {

template <class Vector>
std::string list(const Vector& v) {
  char text[160];
  std::snprintf(text, sizeof text, "(%a, %a, %a)", double{v[0]}, double{v[1]}, double{v[2]});
  return text;
}

}  // namespace

std::string text_of(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

std::string text_of(const Eigen::Vector3f& v) { return list(v); }
std::string text_of(const Eigen::Vector3d& v) { return list(v); }

std::string text_of(const Shape& shape, const Eigen::Vector3d& position, PositionType positions) {
  std::string text;
  if (const Sphere* sphere = std::get_if<Sphere>(&shape)) {
    text = "sphere radius " + text_of(double{sphere->radius});
  } else {
    const Aabb& box = std::get<Aabb>(shape);
    text = "aabb lower " + text_of(box.lower) + " upper " + text_of(box.upper);
  }
  return text + " at " + text_of(position) +
         (positions == PositionType::float64 ? " float64" : " float32");
}

std::string text_of(const BodyDesc& body, PositionType positions) {
  std::string text =
      text_of(body.shape, body.position, positions) + " velocity " + text_of(body.linear_velocity);
  char rest[120];
  std::snprintf(rest, sizeof rest, " motion %d layer %#x mask %#x owner %u%s",
                static_cast<int>(body.motion), body.layer, body.mask, body.owner,
                body.sensor ? " sensor" : "");
  return text + rest;
}

std::string text_of(const Contact& contact) {
  return "separation " + text_of(double{contact.separation}) + " normal " +
         text_of(contact.normal) + " arm_a " + text_of(contact.arm_a) + " arm_b " +
         text_of(contact.arm_b) + " normal_velocity " + text_of(double{contact.normal_velocity}) +
         " status " + std::to_string(static_cast<int>(contact.status));
}

std::string text_of(const reference::Box& box) {
  return text_of(box.lower) + " - " + text_of(box.upper);
}

}  // namespace carom::cli
