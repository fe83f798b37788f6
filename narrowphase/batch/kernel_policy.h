// What a kernel states about itself, for all targets.
#pragma once

namespace carom {

// The units in which a kernel works.
enum class Units {
  metres,
  scaled,  // a power of two: the greatest coordinate of the pair lies between one and two
};

// Unsure lanes are computed again in double precision. This says how much of their results is, and
// which way: by Kernel::test() in lanes of doubles, or one at a time.
enum class Unsure {
  nothing,     // the kernel is exact near touch
  separation,  // in lanes, only the separation, by Kernel::exact_separation(): the normal is good
  in_lanes,    // everything
  test,        // in lanes: the decision, and everything of overlapping pairs (of boxes)
  everything,  // one at a time
  left,        // nothing: the kernel defers its unsure rows to another test
};

// Which columns a kernel is compiled to write. `Kernel::kColumns`; per_detail where it says
// nothing.
enum class Columns {
  per_detail,  // twice: for the decision alone, and for contacts
  decision,
  contact,
  as_asked,  // once: the batch's detail is looked at in the loop, which long kernels do not feel
};

}  // namespace carom
