// Inputs and results as text that loses no bit: floats are hexadecimal.
#pragma once

#include <Eigen/Core>
#include <string>

#include "carom/kernel/contact.h"
#include "carom/reference/reference.h"

namespace carom::cli {

std::string text_of(double value);
std::string text_of(const Eigen::Vector3f& v);
std::string text_of(const Eigen::Vector3d& v);
// "sphere radius R at (x, y, z)".
std::string text_of(const Shape& shape, const Eigen::Vector3d& position, PositionType positions);
std::string text_of(const BodyDesc& body, PositionType positions);
std::string text_of(const Contact& contact);
std::string text_of(const reference::Box& box);

}  // namespace carom::cli
