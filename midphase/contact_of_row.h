// A row of results -> the contacts of its pair.
#pragma once

#include "carom/results/contact_regions.h"
#include "carom/results/pair.h"
#include "carom/results/result_columns.h"
#include "midphase/extra_contacts.h"

namespace carom {

// Whether the pair overlaps, or is separate by no more than `distance`.
inline bool has_contact(const ResultColumns& rows, size_t row, float distance) {
  const uint8_t overlap = rows.overlap[row];
  return overlap == 1 || (overlap == 0 && distance > 0 && rows.separation[row] <= distance);
}

// The first contact of the pair. Rows are relative to the bodies.
inline Contact contact_of_row(const ResultColumns& rows, size_t row, Pair pair) {
  const auto vector = [row](const std::array<float*, 3>& columns) -> Eigen::Vector3f {
    return {columns[0][row], columns[1][row], columns[2][row]};
  };
  return {.a = pair.a,
          .b = pair.b,
          .sub_a = rows.sub_a ? rows.sub_a[row] : 0,
          .sub_b = rows.sub_b ? rows.sub_b[row] : 0,
          .normal = vector(rows.normal),
          .separation = rows.separation[row],
          .arm_a = vector(rows.point_a),
          .normal_velocity = 0,
          .arm_b = vector(rows.point_b),
          .status = static_cast<Status>(rows.status[row]),
          .manifold_count = rows.manifold_count ? rows.manifold_count[row] : uint8_t{0}};
}

// Adds all contacts of the pair, which has one.
inline void add_contacts(const ResultColumns& rows, size_t row, Pair pair,
                         const ExtraContacts& extra, ContactRegions& regions) {
  regions.contacts.push_back(contact_of_row(rows, row, pair));
  regions.contacts.back().left_out = extra.left_out(row);
  regions.manifolds.push_back(rows.manifold[row]);
  if (rows.point_names) regions.point_names.push_back(rows.point_names[row]);
  for (const ContactWithPoints& each : extra.of(row)) {
    regions.contacts.push_back(each.contact);
    regions.manifolds.push_back(each.points);
    if (rows.point_names) regions.point_names.push_back(each.names);
  }
}

}  // namespace carom
