#include "tests/support/impacts.h"

namespace carom::test {

bool same_bits(const ImpactRow& x, const ImpactRow& y) {
  return std::memcmp(&x, &y, sizeof x) == 0;
}

std::string show(const ImpactRow& row) {
  return "toi " + hex(row.toi) + " (" + std::to_string(row.toi) + ") status " +
         std::to_string(row.status) + " separation " + hex(row.separation) + " normal " +
         hex3(row.normal) + " point_a " + hex3(row.point_a) + " point_b " + hex3(row.point_b) +
         " parts " + std::to_string(row.sub_a) + ", " + std::to_string(row.sub_b);
}

ImpactTable::ImpactTable(size_t count, unsigned missing) : missing_(missing) {
  for (int c = 0; c < kColumns; ++c) {
    const size_t size = c == kStatus ? 1 : sizeof(float);
    columns_.emplace_back(count, size, size);
  }
}

ImpactColumns ImpactTable::out() {
  ImpactColumns out;
  out.toi = at<float>(0);
  out.separation = at<float>(1);
  for (int i = 0; i < 3; ++i) {
    out.normal[i] = at<float>(2 + i);
    out.point_a[i] = at<float>(5 + i);
    out.point_b[i] = at<float>(8 + i);
  }
  out.sub_a = at<uint32_t>(11);
  out.sub_b = at<uint32_t>(12);
  out.status = at<uint8_t>(kStatus);
  return out;
}

ImpactRow ImpactTable::row(size_t i) const {
  ImpactRow row{};
  for (int c = 0; c < kColumns; ++c) {
    columns_[c].copy(i, reinterpret_cast<char*>(&row) + c * sizeof(float));
  }
  return row;
}

void forget_columns(ImpactRow& row, unsigned missing) {
  for (int c = 0; c < ImpactTable::kColumns; ++c) {
    if ((missing >> c & 1) == 0) continue;
    const size_t size = c == ImpactTable::kStatus ? 1 : sizeof(float);
    std::memset(reinterpret_cast<char*>(&row) + c * sizeof(float), kNotWritten, size);
  }
}

LaidOutSweeps::LaidOutSweeps(std::span<const Sweep> sweeps, size_t stride)
    : displacements_(sweeps, &Sweep::displacement, stride),
      rotations_(sweeps, &Sweep::rotation, stride) {}

SweepView LaidOutSweeps::view() const {
  SweepView view;
  displacements_.add_to(view.displacement, view.displacement_stride);
  rotations_.add_to(view.rotation, view.rotation_stride);
  return view;
}

LaidOutSweeps::Vectors::Vectors(std::span<const Sweep> sweeps, Eigen::Vector3f Sweep::*member,
                                size_t stride)
    : is_given_(stride > 0), bytes_(sweeps.size(), kSize, stride > 0 ? stride : kSize) {
  for (size_t i = 0; i < sweeps.size(); ++i) {
    const Eigen::Vector3f& vector = sweeps[i].*member;
    is_given_ |= vector != Eigen::Vector3f::Zero();
    for (int axis = 0; axis < 3; ++axis) bytes_.set(i, vector[axis], axis * sizeof(float));
  }
}

void LaidOutSweeps::Vectors::add_to(const float*& data, size_t& stride) const {
  if (is_given_) data = bytes_.as<float>();
  stride = bytes_.stride();
}

ImpactCall impact_call(PositionType positions) {
  ImpactCall call;
  call.layout.positions = positions;
  return call;
}

Result<void> try_impacts(std::span<const MovedPair> pairs, const ImpactCall& call,
                         std::vector<ImpactRow>& rows) {
  std::vector<PlacedShape> bodies_a, bodies_b;
  std::vector<Sweep> sweeps_a, sweeps_b;
  for (const MovedPair& pair : pairs) {
    bodies_a.push_back(pair.bodies.a);
    bodies_b.push_back(pair.bodies.b);
    sweeps_a.push_back(pair.sweep_a);
    sweeps_b.push_back(pair.sweep_b);
  }
  const LaidOut a(bodies_a, call.layout), b(bodies_b, call.layout);
  const LaidOutSweeps moved_a(sweeps_a, call.sweep_stride), moved_b(sweeps_b, call.sweep_stride);
  const auto count = static_cast<uint32_t>(pairs.size());
  const auto place = [&](uint32_t i) { return call.backwards ? count - 1 - i : i; };
  GuardedArray list(count, sizeof(Pair), sizeof(Pair));
  for (uint32_t i = 0; i < count; ++i) list.set(place(i), Pair{i, i});
  ImpactTable table(count, call.missing);
  const ScopedFloatMode mode(call.mode);
  const Result<void> result = time_of_impact(
      a.view(), moved_a.view(), b.view(), moved_b.view(), std::span(list.as<Pair>(), count),
      table.out(), {.frame = call.frame, .parallelism = call.parallelism});
  for (uint32_t i = 0; i < count; ++i) rows.push_back(table.row(place(i)));
  return result;
}

std::vector<ImpactRow> run_impacts(std::span<const MovedPair> pairs, const ImpactCall& call) {
  std::vector<ImpactRow> rows;
  const Result<void> result = try_impacts(pairs, call, rows);
  if (!result) ADD_FAILURE() << result.error().message;
  return rows;
}

ImpactRow row_of(const reference::Impact& impact) {
  const auto numbers = [](const Eigen::Vector3f& v) { return std::array{v.x(), v.y(), v.z()}; };
  return {impact.toi,
          impact.separation,
          numbers(impact.normal),
          numbers(impact.arm_a),
          numbers(impact.arm_b),
          impact.sub_a,
          impact.sub_b,
          static_cast<uint32_t>(impact.status)};
}

std::vector<ImpactRow> expected_impacts(std::span<const MovedPair> pairs, const ImpactCall& call) {
  const ForcedIsa scalar(Isa::scalar);
  std::vector<ImpactRow> rows;
  for (const MovedPair& pair : pairs) {
    const auto& [a, b] = pair.bodies;
    rows.push_back(
        call.frame == WitnessFrame::world
            ? run_impacts({&pair, 1}, call)[0]
            : row_of(reference::time_of_impact(a.shape, a.pose(), pair.sweep_a, b.shape, b.pose(),
                                               pair.sweep_b, call.layout.positions)));
  }
  return rows;
}

testing::AssertionResult same_impacts(std::span<const ImpactRow> expected,
                                      std::span<const ImpactRow> actual,
                                      std::span<const MovedPair> pairs) {
  if (expected.size() != actual.size()) {
    return testing::AssertionFailure() << expected.size() << " rows and " << actual.size();
  }
  for (size_t i = 0; i < expected.size(); ++i) {
    if (same_bits(expected[i], actual[i])) continue;
    return testing::AssertionFailure() << "row " << i << " of " << expected.size() << "\n"
                                       << show(pairs[i]) << "\nexpected " << show(expected[i])
                                       << "\nactual   " << show(actual[i]);
  }
  return testing::AssertionSuccess();
}

ImpactRow impact_of(const MovedPair& pair, PositionType positions) {
  return run_impacts({&pair, 1}, impact_call(positions))[0];
}

}  // namespace carom::test
