#include "world/pairs/shell_memory.h"

#include <utility>

#include "world/store/columns.h"

namespace carom {

ShellLists& ShellMemory::prepare(size_t tested) {
  resize_for_overwriting(now_, tested);
  // Both lists get their memory in the first step, which takes its time anyway.
  if (last_.empty()) last_.reserve(now_.capacity());
  lists_.last = last_;
  lists_.now = now_;
  lists_.overlapping = lists_.kept = 0;
  return lists_;
}

size_t ShellMemory::keep() {
  std::swap(last_, now_);
  const size_t kept = lists_.kept;
  if (is_first_) {
    is_first_ = false;
  } else if (2 * kept >= lists_.overlapping) {
    pauses_.end();
  } else {
    pauses_.begin();
    forget();
  }
  return kept;
}

void ShellMemory::forget() {
  last_.clear();
  is_first_ = true;
}

void ShellMemory::give_back() { give_back_scratch(now_); }

size_t ShellMemory::bytes() const { return bytes_of(last_) + bytes_of(now_); }

}  // namespace carom
