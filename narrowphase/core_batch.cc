#include "narrowphase/core_batch.h"

#include "narrowphase/any_pair_ref.h"
#include "narrowphase/furthest.h"
#include "narrowphase/row_store.h"
#include "narrowphase/scalar_batch.h"
#include "narrowphase/stated_body.h"

namespace carom {
namespace {

reference::Quaternion<double> orientation_of(const BodyReader& body, size_t index) {
  const Row q = body.orientation(index);
  return reference::quaternion_as<double>({q[0], q[1], q[2], q[3]});
}

template <class T>
auto shape_at(const BodyReader& body, size_t index) {
  return reference::shape_as<double>(std::get<T>(shape_of(body, index)));
}

std::array<float, 10> numbers_of(const reference::Separation& s) {
  return {s.separation, s.normal.x(), s.normal.y(), s.normal.z(), s.arm_a.x(),
          s.arm_a.y(),  s.arm_a.z(),  s.arm_b.x(),  s.arm_b.y(),  s.arm_b.z()};
}

// Proofs of shapes whose points are rounded by more than a rotation are not for these bounds.
template <class T>
bool has_exact_points(const T& shape) {
  if constexpr (std::is_same_v<T, reference::DopShape<double>>) return false;
  if constexpr (std::is_same_v<T, reference::TriangleShape<double>>) return !shape.is_special();
  return true;
}

template <class A, class B>
void test_rows(const Batch& batch, ShapeKind kind_a, ShapeKind kind_b) {
  const Collidables view_a = view_of(batch.a, batch.layout, kind_a);
  const Collidables view_b = view_of(batch.b, batch.layout, kind_b);
  const BodyReader a{view_a};
  const BodyReader b{view_b};
  const RowStore store(batch, kind_a, kind_b);
  const reference::CoreTest test = {furthest_point_in_lanes(), !has_contacts(batch.detail)};
  for (size_t row = 0; row < batch.count; ++row) {
    const Pair pair = batch.pairs[row];
    if (!a.is_valid(pair.a) || !b.is_valid(pair.b)) {
      store.put_invalid(row);
      continue;
    }
    const Position<double> p = a.position<double>(pair.a), q = b.position<double>(pair.b);
    const auto shape_a = shape_at<A>(a, pair.a);
    const auto shape_b = shape_at<B>(b, pair.b);
    const reference::SeparationAs<double> s = reference::in_scaled_units<double>(
        shape_a, shape_b,
        {{q.x - p.x, q.y - p.y, q.z - p.z}, orientation_of(a, pair.a), orientation_of(b, pair.b)},
        [&](const auto& x, const auto& y, const reference::PairPose<double>& pose) {
          return core_separation(x, y, pose, test);
        });
    store.put(row, s.status, numbers_of(reference::rounded(s)));
    const bool is_proven = !s.is_unsure && has_exact_points(shape_a) && has_exact_points(shape_b);
    if (batch.unsure && !is_proven) batch.unsure[row] = 1;
  }
}

}  // namespace

template <class A, class B>
void run_core_batch(const Batch& batch) {
  const ShapeKind kind_a = kind_of(A()), kind_b = kind_of(B());
  if (batch.pass == Pass::manifold) return run_scalar_manifolds(batch, kind_a, kind_b);
  test_rows<A, B>(batch, kind_a, kind_b);
}

template void run_core_batch<Sphere, Dop>(const Batch&);
template void run_core_batch<Capsule, Dop>(const Batch&);
template void run_core_batch<Aabb, Dop>(const Batch&);
template void run_core_batch<Box, Dop>(const Batch&);
template void run_core_batch<Dop, Dop>(const Batch&);
template void run_core_batch<Dop, Triangle>(const Batch&);
template void run_core_batch<Sphere, Hull>(const Batch&);
template void run_core_batch<Capsule, Hull>(const Batch&);
template void run_core_batch<Aabb, Hull>(const Batch&);
template void run_core_batch<Box, Hull>(const Batch&);
template void run_core_batch<Dop, Hull>(const Batch&);
template void run_core_batch<Hull, Hull>(const Batch&);
template void run_core_batch<Hull, Triangle>(const Batch&);

}  // namespace carom
