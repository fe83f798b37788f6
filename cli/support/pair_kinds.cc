#include "cli/support/pair_kinds.h"

#include "carom/narrowphase/collide.h"

namespace carom::cli {

std::vector<std::string> pair_kinds(const BodiesOfKind& bodies) {
  std::vector<std::string> names;
  for (size_t a = 0; a < bodies.size(); ++a) {
    for (size_t b = a; b < bodies.size(); ++b) {
      auto kind_a = static_cast<ShapeKind>(a);
      auto kind_b = static_cast<ShapeKind>(b);
      bool can_meet = a == b ? bodies[a] > 1 : bodies[a] > 0 && bodies[b] > 0;
      if (can_meet && supports(kind_a, kind_b)) {
        names.push_back(std::string(name(kind_a)) + "-" + name(kind_b));
      }
    }
  }
  return names;
}

}  // namespace carom::cli
