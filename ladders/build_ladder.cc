#include "carom/ladders/build_ladder.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/float_environment.h"
#include "carom/hulls/simplify_hull.h"
#include "carom/shapes/compound_geometry.h"
#include "carom/shapes/mesh_geometry.h"
#include "ladders/box_model.h"
#include "ladders/capsule_model.h"
#include "ladders/simplify_mesh.h"

namespace carom::ladders {
namespace {

// A model, or why there is none.
struct Model {
  std::optional<Rung> rung;
  size_t pieces = 0;
  std::string refused;
  std::optional<BoxModel> box = std::nullopt;  // if the rung is the box of a child: where it lies
};

Model refused(std::string why) { return {.rung = std::nullopt, .refused = std::move(why)}; }

// Whose shape it is. A body that is a box has it about its origin, a child has a pose that is free.
enum class Owner { body, child };

constexpr const char* kNoGain = "nothing markedly simpler was found within it";

size_t pieces_of(const Shape& shape) {
  if (const auto* hull = std::get_if<Hull>(&shape)) return hull->geometry->points().size();
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return mesh->geometry->triangles().size();
  const auto* compound = std::get_if<Compound>(&shape);
  if (!compound) return 1;
  size_t sum = 0;
  for (const CompoundChild& child : compound->geometry->children()) sum += pieces_of(child.shape);
  return sum;
}

// The fewest points that will do. Fewer points do not always lie further away, so that this finds
// few rather than the fewest.
Model model_of(const HullGeometry& hull, double most) {
  std::optional<SimplifiedHull> best;
  size_t too_few = 3, enough = hull.points().size();
  while (enough - too_few > 1) {
    const size_t points = (too_few + enough) / 2;
    Result<SimplifiedHull> simpler =
        simplify_hull(hull.points(), {.most_points = points, .side = HullSide::both});
    if (!simpler) return refused(simpler.error().message);
    if (simpler->error <= most) {
      enough = std::min(points, simpler->geometry->points().size());
      best = std::move(*simpler);
    } else {
      too_few = points;
    }
  }
  const bool is_simpler = best && 5 * best->geometry->points().size() <= 4 * hull.points().size();
  if (!is_simpler) return refused(kNoGain);
  const size_t points = best->geometry->points().size();
  return {Rung{Hull{std::move(best->geometry)}, best->error}, points, {}};
}

Model model_of(const MeshGeometry& mesh, double most) {
  const MeshRules& rules = mesh.rules();
  if (rules.one_sided) return refused("its triangles are one-sided");
  if (rules.thickness > 0) return refused("its triangles are thick");
  std::optional<SimplerMesh> simpler = simplify_mesh(mesh, most);
  if (!simpler) return refused(kNoGain);
  const size_t triangles = simpler->geometry->triangles().size();
  return {Rung{Mesh{std::move(simpler->geometry)}, simpler->error}, triangles, {}};
}

Model simplest_of(const Shape& shape, Owner owner, double most);

// Puts the model in place of the shape, and says how far the two are apart at most.
double replace_shape(CompoundChild& child, const Model& model) {
  if (!model.box) {
    child.shape = model.rung->shape;
    return model.rung->error;
  }
  const BoxModel box = placed(*model.box, child);
  child = box.box;
  return box.error;
}

// The union of the models of the children, or of those that have none.
Model model_of(const CompoundGeometry& compound, double most) {
  std::vector<CompoundChild> children(compound.children().begin(), compound.children().end());
  double error = 0;
  std::map<const void*, Model> known;  // children may share a geometry
  for (CompoundChild& child : children) {
    const auto* hull = std::get_if<Hull>(&child.shape);
    const auto* mesh = std::get_if<Mesh>(&child.shape);
    if ((!hull && !mesh) || is_rounded(kind_of(child.shape))) continue;
    const void* const geometry =
        hull ? static_cast<const void*>(hull->geometry.get()) : mesh->geometry.get();
    auto [place, is_new] = known.try_emplace(geometry);
    if (is_new) place->second = simplest_of(child.shape, Owner::child, most);
    if (!place->second.rung) continue;
    CompoundChild simpler = child;
    const double apart = replace_shape(simpler, place->second);
    if (apart > most) continue;  // so far out that float32 rounds its place too much
    child = std::move(simpler);
    error = std::max(error, apart);
  }
  if (error == 0) return refused(kNoGain);
  auto simpler = make_compound(children);
  if (!simpler) return refused(simpler.error().message);
  const Shape shape = Compound{std::move(*simpler)};
  return {Rung{shape, error}, pieces_of(shape), {}};
}

// The box of a hull, if one is within the error.
std::optional<Model> box_of(const HullGeometry& hull, Owner owner, double most) {
  const bool is_body = owner == Owner::body;
  std::optional<BoxModel> box = is_body ? box_of_body(hull) : box_of_child(hull);
  if (!box || !(box->error <= most)) return std::nullopt;
  Model model{Rung{box->box.shape, box->error}, 1, {}};
  if (!is_body) model.box = std::move(box);
  return model;
}

Model model_of(const Shape& shape, double most) {
  if (const auto* hull = std::get_if<Hull>(&shape)) return model_of(*hull->geometry, most);
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return model_of(*mesh->geometry, most);
  if (const auto* compound = std::get_if<Compound>(&shape))
    return model_of(*compound->geometry, most);
  return refused("shapes of this kind have no simpler model");
}

Model simplest_of(const Shape& shape, Owner owner, double most) {
  if (is_rounded(kind_of(shape))) return refused("shapes with a rounding have no simpler model");
  std::optional<Rung> capsule = capsule_model(shape);
  if (capsule && capsule->error <= most) return {std::move(capsule), 1, {}};
  if (const auto* hull = std::get_if<Hull>(&shape)) {
    if (std::optional<Model> box = box_of(*hull->geometry, owner, most)) return std::move(*box);
  }
  return model_of(shape, most);
}

bool has_no_geometry(const Shape& shape) {
  if (const auto* hull = std::get_if<Hull>(&shape)) return !hull->geometry;
  if (const auto* mesh = std::get_if<Mesh>(&shape)) return !mesh->geometry;
  const auto* compound = std::get_if<Compound>(&shape);
  return compound && !compound->geometry;
}

void attach(Shape& shape, LadderPtr ladder) {
  if (auto* hull = std::get_if<Hull>(&shape)) hull->ladder = std::move(ladder);
  if (auto* mesh = std::get_if<Mesh>(&shape)) mesh->ladder = std::move(ladder);
  if (auto* compound = std::get_if<Compound>(&shape)) compound->ladder = std::move(ladder);
}

}  // namespace
}  // namespace carom::ladders

namespace carom {

double error_within(double tolerance) { return 0.5 * kShareOfRungs * tolerance; }

Result<LadderedShape> build_ladder(const Shape& shape, std::span<const double> errors) {
  const FloatEnvironment environment;
  const auto begin = std::chrono::steady_clock::now();
  for (size_t i = 0; i < errors.size(); ++i) {
    const bool ascends = i == 0 || errors[i - 1] < errors[i];
    if (errors[i] > 0 && std::isfinite(errors[i]) && ascends) continue;
    return Error{"the errors of a ladder must be finite, more than 0 and ascending"};
  }
  if (ladders::has_no_geometry(shape)) return Error{"the shape has no geometry"};
  LadderedShape result{shape, {.pieces = ladders::pieces_of(shape), .entries = {}}};
  auto ladder = std::make_shared<Ladder>();
  for (const double most : errors) {
    ladders::Model model = ladders::simplest_of(shape, ladders::Owner::body, most);
    const bool is_capsule = model.rung && std::holds_alternative<Capsule>(model.rung->shape);
    const bool is_box = model.rung && std::holds_alternative<Box>(model.rung->shape);
    result.report.entries.push_back({most, model.rung ? model.rung->error : 0, model.pieces,
                                     is_capsule, is_box, std::move(model.refused)});
    if (!model.rung) continue;
    const bool is_coarser = ladder->rungs.empty() || model.rung->error > ladder->rungs.back().error;
    if (is_coarser) ladder->rungs.push_back(std::move(*model.rung));
  }
  if (!ladder->rungs.empty()) ladders::attach(result.shape, std::move(ladder));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  result.report.seconds = took.count();
  return result;
}

}  // namespace carom
