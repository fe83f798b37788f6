// The shells of a block's pairs (narrowphase/hulls/shell.h), from the last step to this one. A pair
// says in its word (packed_direction.h) where its shell is in the list of its step.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "narrowphase/batch/packed_direction.h"
#include "narrowphase/hulls/shell.h"

namespace carom {

// The lists of a world. Blocks may run on several threads.
struct ShellLists {
  std::span<const Shell> last;  // of the last step
  std::span<Shell> now;         // of this step: a place for each pair that is tested
  // Blocks count in this step how many pairs overlap that could have a shell, and how many have
  // that of the last step.
  std::atomic<size_t> overlapping = 0, kept = 0;
};

class KeptShells {
 public:
  // For a block of `count` pairs, the first of which is row `first` of the step.
  KeptShells(ShellLists& lists, size_t first, size_t count)
      : lists_(lists), now_(lists.now.subspan(first, count)), first_(first) {}
  ~KeptShells() {
    lists_.overlapping += overlapping_;
    lists_.kept += kept_;
  }
  KeptShells(const KeptShells&) = delete;
  KeptShells& operator=(const KeptShells&) = delete;

  // The place of a pair with this word in the list of this step: with its shell of the last step,
  // or empty. nullptr: the pair is not to have one.
  Shell* take(uint32_t word) {
    if (word > kOverlapped && word < kHasShell) return nullptr;
    Shell& shell = now_[used_++];
    const size_t place = word & ~kHasShell;
    if (word >= kHasShell && place < lists_.last.size()) {
      shell.take(lists_.last[place]);
    } else {
      shell.triangle_count = 0;
      shell.is_new = false;
    }
    return &shell;
  }

  // The word of a pair that overlaps now, of which take() gave this shell for that word. Where none
  // was found it is looked for again after some steps.
  uint32_t word_of(const Shell* shell, uint32_t before) {
    constexpr uint32_t kStepsWithout = 15;
    ++overlapping_;
    if (!shell) return before - 1;
    if (shell->triangle_count == 0) return kOverlapped + kStepsWithout;
    kept_ += shell->is_new ? 0 : 1;
    return kHasShell | static_cast<uint32_t>(first_ + static_cast<size_t>(shell - now_.data()));
  }

 private:
  ShellLists& lists_;
  std::span<Shell> now_;
  size_t first_, used_ = 0, overlapping_ = 0, kept_ = 0;
};

}  // namespace carom
