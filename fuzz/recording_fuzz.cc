// Reads any bytes as a recording of bounds. The reader must accept or refuse them cleanly.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "fuzz/memory_file.h"
#include "io/recording.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const carom::fuzz::MemoryFile file(data, size);
  auto reader = carom::io::RecordingReader::open(file.path());
  if (!reader) return 0;
  const carom::io::RecordingInfo& info = reader->info();
  if (304 + info.bodies * info.frames * 32 != size) std::abort();
  // A recording without bodies may claim 2^31 frames in 304 bytes.
  const uint64_t frames =
      info.frames < 1000 ? info.frames + 1 : 1000;  // one more wraps around the end
  std::vector<float> boxes;
  for (uint64_t i = 0; i < frames; ++i) {
    if (!reader->read_frame(boxes)) break;
    if (boxes.size() != info.bodies * carom::io::kFloatsPerBox) std::abort();
  }
  return 0;
}
