#include "bench/peers/narrowphase/answers.h"

#include <algorithm>
#include <cmath>

namespace carom::bench {
namespace {

constexpr double kBand = 1e-3;  // of the mean bounding radius; pairs nearer to touch are excluded

}  // namespace

double mean_radius(const PlacedShape& a, const PlacedShape& b) {
  return (local_bounds(a).diagonal().norm() + local_bounds(b).diagonal().norm()) / 4;
}

std::vector<Truth> truths_of(const PairStream& stream) {
  std::vector<Truth> truths;
  for (size_t i = 0; i < stream.spec().count; ++i) {
    truths.push_back(
        {stream.expected(i).separation, mean_radius(stream.bodies_a()[i], stream.bodies_b()[i])});
  }
  return truths;
}

std::vector<Truth> truths_of(const MeshStream& stream) {
  std::vector<Truth> truths;
  for (size_t i = 0; i < stream.spec().count; ++i) {
    const PlacedShape& body = stream.bodies()[i];
    truths.push_back({stream.separation(i), mean_radius(body, body)});
  }
  return truths;
}

std::vector<Truth> truths_of(const MotionStream& stream) {
  std::vector<Truth> truths;
  for (size_t i = 0; i < stream.spec().count; ++i) {
    truths.push_back({stream.expected(i).toi <= 1 ? -1.0F : 1.0F, 0});
  }
  return truths;
}

Agreement agreement(std::span<const Truth> truths, const PairAnswers& answers) {
  Agreement result = {.pairs = truths.size()};
  std::vector<double> errors;
  for (size_t i = 0; i < truths.size(); ++i) {
    const auto& [separation, radius] = truths[i];
    if (std::fabs(separation) <= kBand * radius) {
      ++result.excluded;
    } else if ((separation <= 0) != (answers.overlaps[i] != 0)) {
      ++result.different;
    }
    const float reported = answers.separations[i];
    if (std::isnan(reported)) continue;
    errors.push_back(std::fabs(double{reported} - separation) / radius);
  }
  if (errors.empty()) return result;
  std::sort(errors.begin(), errors.end());
  result.measured = errors.size();
  result.median_error = errors[errors.size() / 2];
  result.worst_error = errors.back();
  return result;
}

}  // namespace carom::bench
