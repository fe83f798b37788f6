#include "cli/run/pairs_out.h"

#include <utility>

namespace carom::cli {

Result<PairsOutput> PairsOutput::create(const std::string& path) {
  Result<io::NpzWriter> writer = io::NpzWriter::create(path);
  if (!writer) return writer.error();
  Result<size_t> member = writer->begin("pairs", io::DType::kUint32, {2});
  if (!member) return member.error();
  return PairsOutput(std::move(*writer), *member);
}

Result<void> PairsOutput::add_frame(std::span<const Pair> pairs) {
  static_assert(sizeof(Pair) == 2 * sizeof(uint32_t));
  frame_first_.push_back(frame_first_.back() + pairs.size());
  return writer_.append(member_, std::as_bytes(pairs));
}

Result<void> PairsOutput::finish() {
  Result<void> added = writer_.add("frame_first", frame_first_);
  return added ? writer_.finish() : added;
}

}  // namespace carom::cli
