#include "io/models/mjcf_settings.h"

#include <array>
#include <cmath>

#include "io/files/file.h"
#include "io/printable.h"

namespace carom::io {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Vectors shorter than this give no direction, as in MuJoCo.
constexpr double kNoLength = 1e-14;

bool read_flag(const Xml& element, const char* attribute, bool usual, FirstError& errors) {
  const std::string value = attribute_of(element, attribute);
  if (value.empty()) return usual;
  if (value != "true" && value != "false") {
    errors.add(element, std::string(attribute) + " is " + quoted_name(value) +
                            " (true or false was expected)");
  }
  return value == "true";
}

void read_sequence(const Xml& compiler, MjcfSettings& settings, FirstError& errors) {
  if (compiler.Attribute("eulerseq") == nullptr) return;
  const std::string sequence = attribute_of(compiler, "eulerseq");
  if (sequence.size() != 3 || sequence.find_first_not_of("xyzXYZ") != std::string::npos) {
    errors.add(compiler, "eulerseq is " + quoted_name(sequence) +
                             " (three of the letters xyzXYZ were expected)");
    return;
  }
  settings.euler_sequence = sequence;
}

void read_mesh_folder(const Xml& compiler, MjcfSettings& settings) {
  for (const char* name : {"assetdir", "meshdir"}) {
    const std::string folder = attribute_of(compiler, name);
    if (!folder.empty()) settings.mesh_folder = folder;
  }
}

// A vector of some length; z if it has none.
Vector3d direction(const Xml& element, const char* attribute, const Vector3d& v,
                   FirstError& errors) {
  if (v.norm() >= kNoLength) return v.normalized();
  errors.add(element, std::string(attribute) + " has a vector without length");
  return Vector3d::UnitZ();
}

Quaterniond from_quat(const Xml& element, const std::vector<double>& q, FirstError& errors) {
  const Quaterniond turn(q[0], q[1], q[2], q[3]);
  if (turn.norm() >= kNoLength) return turn.normalized();
  errors.add(element, "quat is zero");
  return Quaterniond::Identity();
}

Quaterniond from_axes(const Xml& element, const std::vector<double>& axes, FirstError& errors) {
  const Vector3d x = direction(element, "xyaxes", {axes[0], axes[1], axes[2]}, errors);
  const Vector3d given(axes[3], axes[4], axes[5]);
  const Vector3d y = direction(element, "xyaxes", given - x * x.dot(given), errors);
  Eigen::Matrix3d turn;
  turn << x, y, x.cross(y);
  return Quaterniond(turn).normalized();
}

Quaterniond from_euler(const std::vector<double>& angles, const MjcfSettings& settings) {
  Quaterniond turn = Quaterniond::Identity();
  for (size_t i = 0; i < 3; ++i) {
    const char letter = settings.euler_sequence[i];
    const bool turns_along = letter >= 'x';
    const int axis = letter - (turns_along ? 'x' : 'X');
    const Quaterniond step(AngleAxisd(angles[i] * settings.angle_unit, Vector3d::Unit(axis)));
    turn = turns_along ? turn * step : step * turn;
  }
  return turn.normalized();
}

}  // namespace

void read_compiler(const Xml& compiler, MjcfSettings& settings, FirstError& errors) {
  const std::string angle = attribute_of(compiler, "angle");
  if (angle == "radian") settings.angle_unit = 1;
  if (angle == "degree") settings.angle_unit = MjcfSettings().angle_unit;
  if (!angle.empty() && angle != "radian" && angle != "degree") {
    errors.add(compiler, "angle is " + quoted_name(angle) + " (radian or degree was expected)");
  }
  const std::string coordinate = attribute_of(compiler, "coordinate");
  if (!coordinate.empty() && coordinate != "local") {
    errors.add(compiler, "coordinate is " + quoted_name(coordinate) + " (only local is read)");
  }
  read_sequence(compiler, settings, errors);
  read_mesh_folder(compiler, settings);
  settings.strips_paths = read_flag(compiler, "strippath", settings.strips_paths, errors);
}

Quaterniond turn_from_z(const Vector3d& way) {
  const Vector3d across = Vector3d::UnitZ().cross(way);
  const double sine = across.norm();
  const double angle = std::atan2(sine, way.z());
  return Quaterniond(
      AngleAxisd(angle, sine > 1e-10 * way.norm() ? Vector3d(across / sine) : Vector3d::UnitX()));
}

Quaterniond orientation_of(const Xml& element, const MjcfSettings& settings,
                           const Quaterniond& usual, FirstError& errors) {
  Quaterniond turn = usual;
  int given = 0;
  const auto read = [&](const char* attribute, size_t count, const auto& convert) {
    const std::vector<double> numbers = numbers_of(element, attribute, count, count, errors);
    if (numbers.empty()) return;
    turn = convert(numbers);
    ++given;
  };
  read("quat", 4, [&](const auto& q) { return from_quat(element, q, errors); });
  read("axisangle", 4, [&](const auto& a) {
    const Vector3d axis = direction(element, "axisangle", {a[0], a[1], a[2]}, errors);
    return Quaterniond(AngleAxisd(a[3] * settings.angle_unit, axis));
  });
  read("xyaxes", 6, [&](const auto& axes) { return from_axes(element, axes, errors); });
  read("zaxis", 3, [&](const auto& z) {
    return turn_from_z(direction(element, "zaxis", {z[0], z[1], z[2]}, errors));
  });
  read("euler", 3, [&](const auto& angles) { return from_euler(angles, settings); });
  if (given > 1) errors.add(element, "has more than one orientation");
  return turn;
}

}  // namespace carom::io
