/// @file
/// The columns that stateless calls of the narrow phase write to, and the list of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "carom/results/contact.h"

namespace carom {

/// Where stateless calls write: dense columns with one entry a pair; a column that is nullptr is
/// not written. A pair without an answer gets overlap 0, Status::invalid and NaN elsewhere. Names
/// and signs are those of Contact. ResultArrays (result_arrays.h) owns memory for them.
///
/// A new column is a pointer here and a line in for_each_result(), which everything that
/// allocates, copies, compares or writes columns goes through.
struct ResultColumns {
  uint8_t* overlap = nullptr;          ///< 1 overlap, 0 separate; kUndecided at Tier::certified
  uint8_t* status = nullptr;           ///< Status
  float* separation = nullptr;         ///< metres; <= 0: overlap by that much
  std::array<float*, 3> normal{};      ///< unit, world frame, from A to B
  std::array<float*, 3> point_a{};     ///< witness point of A, in the WitnessFrame of the call
  std::array<float*, 3> point_b{};     ///< witness point of B, in the WitnessFrame of the call
  uint8_t* manifold_count = nullptr;   ///< 0 for separate pairs, else 1 to 4
  ManifoldPoints* manifold = nullptr;  ///< in the frame of point_a
  /// Metres by which the separation may be off at most: a forward bound of the kernel
  /// (docs/accuracy.md). Optional, at any detail but pairs; NaN for invalid pairs.
  float* separation_bound = nullptr;
  /// The sub-shape of A that makes the contact: the child of a compound, the triangle of a mesh; 0
  /// for simple shapes, and for a pair without contact. Optional, at details with contacts.
  uint32_t* sub_a = nullptr;
  uint32_t* sub_b = nullptr;  ///< the sub-shape of B, likewise
  /// The names of the points; all 0 for a pair without contact. Optional, at details with contacts.
  /// Far from the origin they need WitnessFrame::body.
  PointNames* point_names = nullptr;
  /// In and out: the closest corners of two hulls, coded. Zero it at first. A caller that measures
  /// the same pairs again and again hands in the entries that the last call left; calls then take
  /// 0.60 to 0.78 of the time while pairs move slowly (docs/narrowphase_peers.md). The content does
  /// not change decisions. Separations, normals and points are as accurate with any content, but
  /// may differ in bits where two sets of corners are equally near. Used at details with contacts,
  /// in the tiers standard and fast, where separate pairs are measured; entries of other kinds stay
  /// as they are. Optional.
  uint64_t* features = nullptr;
};

/// Who fills a column, and whether a caller has to have it.
enum class ColumnRole : uint8_t {
  test,       ///< the test of the pair; kernels need every such column that the detail fills
  manifold,   ///< the manifold of the pair; needed at Detail::manifold
  bound,      ///< the error bound of the separation; only if the caller wants it
  sub_shape,  ///< the parts that made the contact; only if the caller wants them
  name,       ///< names of points; only if the caller wants them
  memory,     ///< what the caller hands in again in its next call; only if the caller wants it
};

/// Whether a column is there only if the caller wants it.
constexpr bool is_optional(ColumnRole role) {
  return role != ColumnRole::test && role != ColumnRole::manifold;
}

/// The entry of a column in the list.
struct ColumnInfo {
  const char* name;  ///< the name of the field, and of the array in files of results
  Detail detail;     ///< the least detail that fills it
  ColumnRole role;   ///< who fills it
};

/// Calls visit(info, field of each of `columns`...) for every field of ResultColumns, in their
/// order. `columns` are ResultColumns or structs with fields of the same names. A field is a
/// pointer, or three for the components of a vector.
template <class Visit, class... Columns>
constexpr void for_each_result(const Visit& visit, Columns&&... columns) {
  using enum ColumnRole;
  visit(ColumnInfo{"overlap", Detail::overlap, test}, columns.overlap...);
  visit(ColumnInfo{"status", Detail::overlap, test}, columns.status...);
  visit(ColumnInfo{"separation", Detail::contact, test}, columns.separation...);
  visit(ColumnInfo{"normal", Detail::contact, test}, columns.normal...);
  visit(ColumnInfo{"point_a", Detail::contact, test}, columns.point_a...);
  visit(ColumnInfo{"point_b", Detail::contact, test}, columns.point_b...);
  visit(ColumnInfo{"manifold_count", Detail::manifold, manifold}, columns.manifold_count...);
  visit(ColumnInfo{"manifold", Detail::manifold, manifold}, columns.manifold...);
  visit(ColumnInfo{"separation_bound", Detail::overlap, bound}, columns.separation_bound...);
  visit(ColumnInfo{"sub_a", Detail::contact, sub_shape}, columns.sub_a...);
  visit(ColumnInfo{"sub_b", Detail::contact, sub_shape}, columns.sub_b...);
  visit(ColumnInfo{"point_names", Detail::contact, name}, columns.point_names...);
  visit(ColumnInfo{"features", Detail::contact, memory}, columns.features...);
}

/// The same with a call for every single pointer.
template <class Visit, class... Columns>
constexpr void for_each_column(const Visit& visit, Columns&&... columns) {
  const auto each = [&](const ColumnInfo& info, auto&... field) {
    if constexpr ((requires { std::tuple_size<std::remove_cvref_t<decltype(field)>>::value; } &&
                   ...)) {
      for (size_t axis = 0; axis < 3; ++axis) visit(info, field[axis]...);
    } else {
      visit(info, field...);
    }
  };
  for_each_result(each, columns...);
}

/// How many pointers for_each_column() visits.
inline constexpr size_t kColumnCount = [] {
  size_t count = 0;
  for_each_column([&](const ColumnInfo&, auto*) { ++count; }, ResultColumns());
  return count;
}();
static_assert(kColumnCount * sizeof(void*) == sizeof(ResultColumns),
              "every column must be in for_each_result()");

/// Which pairs get more than the decision: separation, normal and points, at details with contacts.
/// For the other pairs all columns but overlap, status and manifold_count may hold anything; their
/// status is that of the decision.
enum class Measured : uint8_t {
  all,          ///< every pair
  overlapping,  ///< contacts only. Boxes and hulls against boxes and hulls take half of the time if
                ///< they are separate; most other kinds gain nothing
  separate,     ///< clearances only: no penetration search, which is most of the time that
                ///< overlapping hulls take (composites are searched). There are no manifold points
};

}  // namespace carom
