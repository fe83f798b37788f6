// Writes inputs and results as text without loss: floats are hexadecimal.
#pragma once

#include <Eigen/Core>
#include <string>

#include "carom/reference/reference.h"
#include "carom/results/contact.h"
#include "carom/results/sweep.h"

namespace carom::cli {

std::string text_of(double value);
std::string text_of(const Eigen::Vector3f& v);
std::string text_of(const Eigen::Vector3d& v);
// "box half (x, y, z) at (x, y, z) orientation (x, y, z, w) float32".
std::string text_of(const Shape& shape, const Pose& pose, PositionType positions);
std::string text_of(const BodyDesc& body, PositionType positions);
std::string text_of(const Sweep& sweep);
std::string text_of(const Contact& contact);
std::string text_of(const ManifoldPoints& manifold);
std::string text_of(const reference::Box& box);

}  // namespace carom::cli
