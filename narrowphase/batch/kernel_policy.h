// What a kernel says about itself, for all targets.
#pragma once

namespace carom {

// The units in which a kernel works.
enum class Units {
  metres,
  scaled,  // a power of two: the greatest coordinate of the pair lies between one and two
};

// What is computed again in double precision, one lane at a time, where float32 cannot decide.
enum class Unsure {
  nothing,     // the kernel is exact near touch
  separation,  // the separation alone: the normal is good
  everything,
  left,  // nothing here: what is marked, and that alone, is tested again elsewhere
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
