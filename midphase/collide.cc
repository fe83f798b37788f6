#include "carom/narrowphase/collide.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cfloat>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "carom/results/result_arrays.h"
#include "carom/shapes/compound_geometry.h"
#include "midphase/collide_pairs.h"
#include "midphase/contact_of_row.h"
#include "midphase/mixed_block.h"
#include "midphase/point_names.h"
#include "narrowphase/batch/stated_body.h"
#include "narrowphase/batch/world_point.h"
#include "narrowphase/blocks/pair_block.h"
#include "narrowphase/pairs/pair_kinds.h"
#include "shapes/body_reader.h"
#include "shapes/quick_kinds.h"

namespace carom {
namespace {

using KindSet = std::array<bool, 256>;

KindSet kinds_in(const Collidables& bodies) {
  KindSet present{};
  if (!bodies.kind) {
    present[static_cast<uint8_t>(bodies.uniform_kind)] = bodies.count > 0;
  } else {
    for (size_t i = 0; i < bodies.count; ++i) present[static_cast<uint8_t>(bodies.kind[i])] = true;
  }
  return present;
}

Error no_kernel(ShapeKind a, ShapeKind b) {
  return {std::string("no kernel for ") + name(a) + " against " + name(b)};
}

// Whether going through the pairs is cheaper than going through all bodies.
bool is_short(const Collidables& a, const Collidables& b, size_t pairs) {
  return pairs < (a.count + b.count) / 8;
}

bool do_all_kinds_meet(const Collidables& a, const Collidables& b) {
  const KindSet in_a = kinds_in(a);
  const KindSet in_b = kinds_in(b);
  bool all_meet = true;
  for (size_t i = 0; i < in_a.size(); ++i) {
    for (size_t j = 0; j < in_b.size(); ++j) {
      if (!in_a[i] || !in_b[j]) continue;
      all_meet = all_meet && supports(static_cast<ShapeKind>(i), static_cast<ShapeKind>(j));
    }
  }
  return all_meet;
}

// Checks the kinds that occur. If some of them have no kernel, or if there are few pairs, checks
// every pair.
template <class PairAt>
Result<void> check_kinds(const Collidables& a, const Collidables& b, size_t count,
                         const PairAt& pair_at) {
  if (!is_short(a, b, count) && do_all_kinds_meet(a, b)) return {};
  const BodyReader reader_a{a};
  const BodyReader reader_b{b};
  for (size_t i = 0; i < count; ++i) {
    const Pair pair = pair_at(i);
    const ShapeKind kind_a = reader_a.kind(pair.a);
    const ShapeKind kind_b = reader_b.kind(pair.b);
    if (!supports(kind_a, kind_b)) return no_kernel(kind_a, kind_b);
  }
  return {};
}

// The first body that Tier::exact does not decide.
Result<void> check_exact(const Collidables& bodies) {
  const BodyReader reader{bodies};
  for (size_t i = 0; i < bodies.count; ++i) {
    const ShapeKind kind = reader.kind(i);
    const bool is_open = is_round(kind) || (kind == ShapeKind::compound && reader.is_valid(i) &&
                                            !is_decided_exactly(shape_of(reader, i)));
    if (is_open) return Error{std::string("the exact tier does not decide a ") + name(kind)};
  }
  return {};
}

bool has_composites(const Collidables& bodies) {
  if (!bodies.kind) return is_composite(bodies.uniform_kind);
  bool found = false;  // without a branch, to read many kinds at once
  for (size_t i = 0; i < bodies.count; ++i) found |= is_composite(bodies.kind[i]);
  return found;
}

// `pairs` nullptr: the pairs are (0, 0), (1, 1), ...
bool may_have_composites(const Collidables& a, const Collidables& b, const Pair* pairs,
                         size_t count) {
  if (!pairs || !is_short(a, b, count)) return has_composites(a) || has_composites(b);
  const BodyReader reader_a{a}, reader_b{b};
  return std::any_of(pairs, pairs + count, [&](const Pair& pair) {
    return is_composite(reader_a.kind(pair.a)) || is_composite(reader_b.kind(pair.b));
  });
}

void fill_sub_shapes(const ResultColumns& out, size_t begin, size_t end) {
  for (uint32_t* column : {out.sub_a, out.sub_b}) {
    if (column) std::fill(column + begin, column + end, 0u);
  }
}

// The distances of a block that has one for all.
std::array<float, kPairsPerBlock> filled(float distance) {
  std::array<float, kPairsPerBlock> distances;
  distances.fill(distance);
  return distances;
}

// `pairs` nullptr: the pairs are (0, 0), (1, 1), ...
struct CollideCall {
  const Collidables& a;
  const Collidables& b;
  const Pair* pairs;
  size_t count;
  Detail detail;
  const ResultColumns& out;
  const CollideOptions& options;
  bool composites = false;  // whether there may be meshes and compounds
  uint32_t* direction = nullptr;
  ExtraContacts* extra = nullptr;
  ShellLists* shells = nullptr;
  size_t first_row = 0;  // of the shells

  Pair pair(size_t i) const {
    const auto index = static_cast<uint32_t>(i);
    return pairs ? pairs[i] : Pair{index, index};
  }
};

void run_blocks(const CollideCall& call) {
  if (call.detail == Detail::pairs || call.count == 0) return;
  const CollideOptions& options = call.options;
  if (call.extra) call.extra->prepare(call.composites ? call.count : 0);
  const ExtraRequest extra{call.composites ? call.extra : nullptr, options.region_limits};
  const bool has_distance = has_contacts(call.detail) && options.contact_distance > 0;
  const auto one_distance = filled(has_distance ? options.contact_distance : 0);
  const float* const distances = has_contacts(call.detail) ? options.contact_distances : nullptr;
  const bool is_quick = have_quick_kind(call.a) && have_quick_kind(call.b);
  const Parallelism parallelism =
      is_quick ? unless_few(options.parallelism, call.count) : options.parallelism;
  for_each_block(call.count, kPairsPerBlock, parallelism, [&](size_t, size_t begin, size_t end) {
    if (has_contacts(call.detail)) fill_sub_shapes(call.out, begin, end);
    std::optional<KeptShells> shells;
    if (call.shells) shells.emplace(*call.shells, call.first_row + begin, end - begin);
    const PairBlock block = {
        .a = call.a,
        .b = call.b,
        .pairs = call.pairs ? call.pairs + begin : nullptr,
        .first = begin,
        .count = end - begin,
        .detail = call.detail,
        .frame = options.frame,
        .measured = options.measured,
        .reach = distances      ? distances + begin
                 : has_distance ? one_distance.data()
                                : nullptr,
        .memory = {call.direction ? call.direction + begin : nullptr, shells ? &*shells : nullptr},
        .accuracy = options.accuracy,
        .out = from_row(call.out, begin)};
    call.composites ? run_mixed_block(block, extra) : run_pair_block(block);
    if (block.out.point_names && has_contacts(call.detail)) name_simple_points(block);
  });
}

void move_to_world(const ResultColumns& columns, size_t row, const CollideCall& call) {
  const Pair pair = call.pair(row);
  const BodyReader a{call.a}, b{call.b};
  const auto move = [row](const std::array<float*, 3>& point, const BodyReader& reader,
                          size_t body) {
    const auto moved = world_point(reader, body, {point[0][row], point[1][row], point[2][row]});
    for (size_t axis = 0; axis < 3; ++axis) point[axis][row] = moved[axis];
  };
  move(columns.point_a, a, pair.a);
  move(columns.point_b, b, pair.b);
  for (size_t k = 0; k < columns.manifold_count[row]; ++k) {
    std::array<float, 3>& point = columns.manifold[row].point[k];
    point = world_point(a, pair.a, point);
  }
}

Result<void> check_lengths(const CollideOptions& options, size_t count) {
  const auto is_good = [](float distance) { return distance >= 0 && distance <= FLT_MAX; };
  if (!is_good(options.accuracy.tolerance)) {
    return Error{"the tolerance is not a finite number >= 0"};
  }
  const float* const each = options.contact_distances;
  if (each ? std::all_of(each, each + count, is_good) : is_good(options.contact_distance)) {
    return {};
  }
  return Error{"a contact distance is not a finite number >= 0"};
}

std::vector<ColumnRole> optional_roles(const ResultColumns& columns) {
  std::vector<ColumnRole> roles = {ColumnRole::sub_shape};
  if (columns.separation_bound) roles.push_back(ColumnRole::bound);
  if (columns.features) roles.push_back(ColumnRole::memory);
  if (columns.point_names) roles.push_back(ColumnRole::name);
  return roles;
}

// Runs the call in the frame of the bodies, in which contacts are listed, and moves points to the
// frame that the caller wants afterwards.
void list_regions(const CollideCall& asked, ContactRegions& regions) {
  ResultArrays rows;
  rows.resize(asked.count, Detail::manifold, optional_roles(asked.out));
  const ResultColumns& columns = rows.columns();
  if (columns.features) std::copy_n(asked.out.features, asked.count, columns.features);
  ExtraContacts extra;
  CollideOptions options = asked.options;
  options.frame = WitnessFrame::body;
  run_blocks({asked.a, asked.b, asked.pairs, asked.count, asked.detail, columns, options,
              asked.composites, nullptr, &extra});

  regions.first.assign(asked.count + 1, 0);
  regions.contacts.clear();
  regions.manifolds.clear();
  regions.point_names.clear();
  for (size_t i = 0; i < asked.count; ++i) {
    const float* const each = options.contact_distances;
    if (has_contact(columns, i, each ? each[i] : options.contact_distance)) {
      add_contacts(columns, i, asked.pair(i), extra, regions);
    }
    regions.first[i + 1] = regions.contacts.size();
  }

  if (asked.options.frame == WitnessFrame::world) {
    for (size_t i = 0; i < asked.count; ++i) move_to_world(columns, i, asked);
  }
  copy_rows(columns, asked.out, Detail::manifold, asked.count, [](size_t i) { return i; });
}

Result<void> run(CollideCall call) {
  call.composites = may_have_composites(call.a, call.b, call.pairs, call.count);
  if (Result<void> checked = check_lengths(call.options, call.count); !checked) return checked;
  if (call.options.accuracy.tier == Tier::exact) {
    for (const Collidables* bodies : {&call.a, &call.b}) {
      if (Result<void> checked = check_exact(*bodies); !checked) return checked;
    }
  }
  if (call.detail == Detail::regions && call.options.regions) {
    list_regions(call, *call.options.regions);
  } else {
    run_blocks(call);
  }
  return {};
}

}  // namespace

// Composites work with all kinds: their parts have kernels against all shapes with bounds, and
// parts without a kernel are skipped.
bool supports(ShapeKind a, ShapeKind b) {
  const auto is_shape = [](ShapeKind kind) {
    return static_cast<size_t>(kind) < size_t{kShapeKindCount};
  };
  const bool composites = is_composite(a) || is_composite(b);
  return composites ? is_shape(a) && is_shape(b) : find_pair_kind(a, b).exists();
}

bool is_decided_exactly(const Shape& shape) {
  const auto* const compound = std::get_if<Compound>(&shape);
  if (!compound || !compound->geometry) return !is_round(kind_of(shape));
  const auto children = compound->geometry->children();
  return std::ranges::all_of(
      children, [](const CompoundChild& child) { return is_decided_exactly(child.shape); });
}

Result<void> check_pairs(const Collidables& a, const Collidables& b, std::span<const Pair> pairs) {
  return check_kinds(a, b, pairs.size(), [&](size_t i) { return pairs[i]; });
}

Result<void> collide(const Collidables& a, const Collidables& b, std::span<const Pair> pairs,
                     Detail detail, const ResultColumns& out, const CollideOptions& options) {
  if (Result<void> checked = check_pairs(a, b, pairs); !checked) return checked;
  return run({a, b, pairs.data(), pairs.size(), detail, out, options});
}

Result<void> collide_rows(const Collidables& a, const Collidables& b, Detail detail,
                          const ResultColumns& out, const CollideOptions& options) {
  assert(a.count == b.count);
  const auto pair_at = [](size_t i) -> Pair {
    return {static_cast<uint32_t>(i), static_cast<uint32_t>(i)};
  };
  if (Result<void> checked = check_kinds(a, b, a.count, pair_at); !checked) return checked;
  return run({a, b, nullptr, a.count, detail, out, options});
}

void collide_pairs(const PairsOfWorld& tested, Detail detail, const ResultColumns& out,
                   const CollideOptions& options) {
  run_blocks({tested.bodies, tested.bodies, tested.pairs.data(), tested.pairs.size(), detail, out,
              options, tested.has_composites, tested.direction, tested.extra, tested.shells,
              tested.first_row});
}

bool uses_directions(ShapeKind a, ShapeKind b) {
  const PairKindRef kind = find_pair_kind(a, b);
  return kind.exists() && kPairKinds[kind.index].has_direction_pass();
}

}  // namespace carom
