#include "cli/advise/scene_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "accuracy/pairs/body_size.h"
#include "carom/narrowphase/collide.h"
#include "cli/advise/pair_survey.h"
#include "io/recording.h"

namespace carom::cli {
namespace {

// The most displacements kept for the spread: enough for a p99, and no more memory than the frames.
constexpr size_t kMostDisplacements = 4'000'000;

template <class T>
bool any_above(const std::vector<T>& values, T limit) {
  return std::any_of(values.begin(), values.end(), [=](T value) { return value > limit; });
}

void survey_bodies(const LoadedScene& scene, SceneSurvey& survey, std::vector<double>& radius) {
  const io::SceneInfo& info = scene.info();
  std::vector<double> finite, aspects;
  for (size_t i = 0; i < info.bodies; ++i) {
    const Shape shape = scene.player().body(scene.frame(0), i).shape;
    survey.all_decided_exactly = survey.all_decided_exactly && is_decided_exactly(shape);
    radius.push_back(accuracy::bounding_radius(shape));
    if (!std::isfinite(radius.back())) continue;
    finite.push_back(radius.back());
    aspects.push_back(accuracy::aspect(shape));
  }
  survey.radius = spread_of(std::move(finite));
  survey.aspect = spread_of(std::move(aspects));
  survey.kinds = scene.player().bodies_of_kind();
  survey.fixed = static_cast<uint64_t>(
      std::count(info.body_motion.begin(), info.body_motion.end(), uint8_t{0}));
  survey.sensors = static_cast<uint64_t>(
      std::count_if(info.sensor.begin(), info.sensor.end(), [](uint8_t is) { return is != 0; }));
  const auto narrows = [](uint32_t bits) { return bits != 0xffffffffu; };
  survey.has_filters = std::any_of(info.layer.begin(), info.layer.end(), narrows) ||
                       std::any_of(info.mask.begin(), info.mask.end(), narrows) ||
                       any_above(info.owner, 0u) || any_above(info.space, 0u) ||
                       !info.excluded_pairs.empty();
  survey.has_velocities = info.has_linear_velocity;
}

void note_position(double coordinate, SceneSurvey& survey) {
  if (!std::isfinite(coordinate)) return;
  survey.farthest = std::max(survey.farthest, std::abs(coordinate));
  survey.fits_float32 &= double{static_cast<float>(coordinate)} == coordinate;
}

void survey_places(const LoadedScene& scene, SceneSurvey& survey) {
  survey.float64 = scene.positions() == PositionType::float64;
  for (size_t f = 0; f < scene.frames(); ++f) {
    const io::SceneFrame& frame = scene.frame(f);
    for (const float coordinate : frame.position32) note_position(coordinate, survey);
    for (const double coordinate : frame.position64) note_position(coordinate, survey);
    for (const float coordinate : frame.boxes) note_position(coordinate, survey);
  }
  const auto farthest = static_cast<float>(survey.farthest);
  survey.float32_step =
      double{std::nextafter(farthest, std::numeric_limits<float>::infinity())} - farthest;
}

const float* orientation_of(const io::SceneFrame& frame, size_t body) {
  return frame.orientation.empty() ? nullptr : &frame.orientation[4 * body];
}

// Looks only at kinds that turn with their bodies.
void survey_orientations(const LoadedScene& scene, SceneSurvey& survey) {
  survey.has_orientation = !scene.frame(0).orientation.empty();
  if (!survey.has_orientation) return;
  survey.all_unturned = true;
  for (size_t i = 0; i < survey.bodies; ++i) {
    const ShapeKind kind = kind_of(scene.player().body(scene.frame(0), i).shape);
    if (row_count(kind) == 0) continue;
    for (size_t f = 0; f < scene.frames(); ++f) {
      const float* q = orientation_of(scene.frame(f), i);
      survey.all_unturned &= q[0] == 0 && q[1] == 0 && q[2] == 0;
    }
  }
}

// The straight distance that a point at distance 1 from the centre moves: 2 sin(angle / 2).
double turn_chord(const float* before, const float* now) {
  if (before == nullptr || std::equal(before, before + 4, now)) return 0;
  const Eigen::Vector4d p = Eigen::Map<const Eigen::Vector4f>(before).cast<double>();
  const Eigen::Vector4d q = Eigen::Map<const Eigen::Vector4f>(now).cast<double>();
  const double cosine = std::min(1.0, std::abs(p.dot(q)) / (p.norm() * q.norm()));
  return 2 * std::sqrt(1 - cosine * cosine);
}

double box_motion(const float* before, const float* now) {
  double square = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double lower = double{now[axis]} - before[axis];
    const double upper = double{now[4 + axis]} - before[4 + axis];
    square += std::max(lower * lower, upper * upper);
  }
  return std::sqrt(square);
}

template <class T>
double way(const std::vector<T>& before, const std::vector<T>& now, size_t body) {
  double square = 0;
  for (size_t i = 3 * body; i < 3 * body + 3; ++i) {
    const double step = double{now[i]} - double{before[i]};
    square += step * step;
  }
  return std::sqrt(square);
}

// A bound of how far a point of the body moves from one frame to the next.
double motion_of(const io::SceneFrame& before, const io::SceneFrame& now, size_t body,
                 double radius) {
  if (!now.boxes.empty()) {
    const size_t first = io::kFloatsPerBox * body;
    return box_motion(&before.boxes[first], &now.boxes[first]);
  }
  const double shift = now.position64.empty() ? way(before.position32, now.position32, body)
                                              : way(before.position64, now.position64, body);
  const double chord = turn_chord(orientation_of(before, body), orientation_of(now, body));
  return chord > 0 && std::isfinite(radius) ? shift + chord * radius : shift;
}

void survey_motion(const LoadedScene& scene, const std::vector<double>& radius,
                   SceneSurvey& survey) {
  const size_t steps = scene.frames() - 1;
  if (steps == 0 || survey.bodies == 0) return;
  const size_t stride = survey.bodies * steps / kMostDisplacements + 1;
  std::vector<double> displacements;
  uint64_t looked_at = 0;
  for (size_t i = 0; i < survey.bodies * steps; i += stride) {
    const size_t body = i % survey.bodies;
    const size_t step = i / survey.bodies;
    const double motion = motion_of(scene.frame(step), scene.frame(step + 1), body, radius[body]);
    ++looked_at;
    if (motion > 0) displacements.push_back(motion);
  }
  survey.moving_share = static_cast<double>(displacements.size()) / static_cast<double>(looked_at);
  survey.displacement = spread_of(std::move(displacements));
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const size_t rank = (values.size() * 99 + 99) / 100 - 1;
  return {values.front(), values[values.size() / 2], values[rank], values.back()};
}

Result<SceneSurvey> survey(const LoadedScene& scene) {
  SceneSurvey survey;
  survey.bodies = scene.info().bodies;
  survey.frames = scene.frames();
  survey.frames_of_scene = scene.info().frames;
  std::vector<double> radius;
  survey_bodies(scene, survey, radius);
  survey_places(scene, survey);
  survey_orientations(scene, survey);
  survey_motion(scene, radius, survey);
  Result<PairSurvey> pairs = survey_pairs(scene, radius);
  if (!pairs) return pairs.error();
  survey.pairs = std::move(*pairs);
  return survey;
}

}  // namespace carom::cli
