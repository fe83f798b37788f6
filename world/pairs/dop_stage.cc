#include "world/pairs/dop_stage.h"

#include "world/store/columns.h"

namespace carom {

void DopStage::update(const Collidables& bodies, DopKind kind, std::span<const uint8_t> changed,
                      Parallelism parallelism) {
  kind_ = kind;
  records_.resize(bodies.count * dop_record_size(kind));
  compute_dops(bodies, {kind, records_.data()}, parallelism, changed);
}

const std::vector<uint8_t>& DopStage::test(std::span<const Pair> pairs, Parallelism parallelism) {
  overlap_.resize(pairs.size());
  drop_separate_dops({kind_, records_.data()}, pairs, overlap_.data(), parallelism);
  return overlap_;
}

void DopStage::give_back() {
  carom::give_back(records_);
  give_back_scratch(overlap_);
}

size_t DopStage::record_bytes() const { return bytes_of(records_); }
size_t DopStage::pair_bytes() const { return bytes_of(overlap_); }

}  // namespace carom
