// The candidate pairs of every frame of a run, as .npz: "pairs" and "frame_first".
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "carom/results/pair.h"
#include "io/files/npz.h"

namespace carom::cli {

class PairsOutput {
 public:
  static Result<PairsOutput> create(const std::string& path);

  Result<void> add_frame(std::span<const Pair> pairs);
  Result<void> finish();

 private:
  PairsOutput(io::NpzWriter writer, size_t member)
      : writer_(std::move(writer)), member_(member), frame_first_{0} {}

  io::NpzWriter writer_;
  size_t member_;
  std::vector<uint64_t> frame_first_;
};

}  // namespace carom::cli
