#include "narrowphase/batch/scratch_columns.h"

namespace carom {

ResultColumns ScratchColumns::columns() {
  const auto column3 = [this](size_t i) -> std::array<float*, 3> {
    return {floats[i].data(), floats[i + 1].data(), floats[i + 2].data()};
  };
  return {overlap.data(), status.data(), floats[0].data(), column3(1), column3(4), column3(7)};
}

}  // namespace carom
