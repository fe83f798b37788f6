#include "cli/advise/front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "cli/support/number_text.h"
#include "cli/support/table.h"

namespace carom::cli {
namespace {

using accuracy::Trial;

constexpr double kFinest = 1e-7, kCoarsest = 1e-1;  // of the radius
constexpr int kADecade = 4;
constexpr double kFinestModel = 1e-3;  // finer ones are nearly the shapes themselves

std::vector<float> tolerances_for(double radius) {
  std::vector<float> tolerances = {0};
  const int count = static_cast<int>(std::lround(std::log10(kCoarsest / kFinest) * kADecade));
  for (int i = 0; i <= count && radius > 0; ++i) {
    const double part = kFinest * std::pow(10.0, static_cast<double>(i) / kADecade);
    tolerances.push_back(static_cast<float>(part * radius));
  }
  return tolerances;
}

Result<void> add_ladders(LoadedScene& scene, const std::vector<float>& tolerances, double radius) {
  std::vector<double> errors;
  for (const float tolerance : tolerances) {
    if (tolerance >= kFinestModel * radius && tolerance > 0) {
      errors.push_back(error_within(tolerance));
    }
  }
  if (errors.empty()) return {};
  const auto reports = scene.add_ladders(errors);
  return reports ? Result<void>() : reports.error();
}

// Keeps the points that are faster than all with a smaller error. They are in the order of errors.
std::vector<FrontPoint> undominated(const std::vector<FrontPoint>& points) {
  std::vector<FrontPoint> front;
  for (const FrontPoint& point : points) {
    if (front.empty() || point.frame_ms < front.back().frame_ms) front.push_back(point);
  }
  return front;
}

// A grid of characters, with logarithms of the errors to the right.
class Plot {
 public:
  Plot(double least, double most) : least_(std::log10(least)), most_(std::log10(most)) {
    for (std::string& row : rows_) row.assign(kColumns, ' ');
  }

  // `height`: 0 at the bottom, 1 at the top.
  void mark(double error, double height, char sign) {
    if (!(error > 0)) return;
    const double x = (std::log10(error) - least_) / std::max(most_ - least_, 1e-9);
    const auto column = static_cast<int>(std::lround(x * (kColumns - 1)));
    const auto row = static_cast<int>(std::lround((1 - height) * (kRows - 1)));
    if (column < 0 || column >= kColumns || row < 0 || row >= kRows) return;
    rows_[static_cast<size_t>(row)][static_cast<size_t>(column)] = sign;
  }

  void print(std::ostream& out) const {
    for (size_t row = 0; row < rows_.size(); ++row) {
      const double height = 1 - static_cast<double>(row) / (kRows - 1);
      out << (row % 4 == 0 ? number("%5.2f |", height) : "      |") << rows_[row] << '\n';
    }
    out << "      +" << std::string(kColumns, '-') << '\n'
        << "       " << number("%-10.1e", std::pow(10.0, least_)) << std::string(kColumns - 20, ' ')
        << number("%10.1e", std::pow(10.0, most_)) << '\n';
  }

 private:
  static constexpr int kColumns = 64, kRows = 17;

  double least_, most_;
  std::array<std::string, kRows> rows_;
};

}  // namespace

Result<std::vector<FrontPoint>> measure_front(LoadedScene& scene, const SceneSurvey& survey,
                                              const accuracy::StandardRun& standard,
                                              const accuracy::TrialPlan& plan) {
  const std::vector<float> tolerances = tolerances_for(survey.radius.median);
  if (auto added = add_ladders(scene, tolerances, survey.radius.median); !added) {
    return added.error();
  }
  std::vector<Trial> trials;
  for (const float tolerance : tolerances) {
    trials.push_back({.name = "tolerance", .settings = {}});
    trials.back().settings.accuracy.tolerance = tolerance;
  }
  const auto results = accuracy::run_trials(scene, standard, trials, plan);
  if (!results) return results.error();
  std::vector<FrontPoint> points;
  for (size_t i = 0; i < trials.size(); ++i) {
    const std::optional<accuracy::TrialResult>& result = (*results)[i];
    if (!result) continue;
    points.push_back({.tolerance = tolerances[i],
                      .frame_ms = result->frame_ms,
                      .guaranteed_error = double{tolerances[i]} + survey.pairs.error_bound,
                      .measured_error = result->deviation.worst(),
                      .settings = "--tolerance " + shortest(tolerances[i])});
  }
  return undominated(points);
}

std::string front_text(const std::vector<FrontPoint>& front) {
  std::ostringstream out;
  Table table({"tolerance, m", "ms", "of tolerance 0", "guaranteed, m", "measured, m"});
  const double slowest = front.empty() ? 1 : front.front().frame_ms;
  double least = HUGE_VAL, most = 0;
  for (const FrontPoint& point : front) {
    table.add({shortest(point.tolerance), number("%.3f", point.frame_ms),
               number("%.2f", point.frame_ms / slowest), number("%.2g", point.guaranteed_error),
               number("%.2g", point.measured_error)});
    for (const double error : {point.guaranteed_error, point.measured_error}) {
      if (error > 0 && std::isfinite(error)) {
        least = std::min(least, error);
        most = std::max(most, error);
      }
    }
  }
  table.print(out);
  if (!(most > 0)) return out.str();
  Plot plot(least, most);
  for (const FrontPoint& point : front) {
    plot.mark(point.measured_error, point.frame_ms / slowest, 'o');
    plot.mark(point.guaranteed_error, point.frame_ms / slowest, '*');
  }
  out << "\nTime of a frame, of that with tolerance 0, by error in metres (* guaranteed, o "
         "measured)\n";
  plot.print(out);
  return out.str();
}

}  // namespace carom::cli
