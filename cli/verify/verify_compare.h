// Finds the first difference between the results of two frames.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "carom/reference/reference.h"
#include "cli/verify/verify_system.h"

namespace carom::cli {

FrameView view_of(const reference::Frame& frame);

struct Mismatch {
  const char* what;  // "pairs", "contacts", ...
  Pair pair;         // a == b: a single body
};
std::optional<Mismatch> compare(const FrameView& expected, const FrameView& actual);

// Inputs and both results of the pair, one line each.
std::string describe(const Mismatch& mismatch, std::span<const reference::Body> bodies,
                     PositionType positions, const FrameView& expected, const FrameView& actual);

}  // namespace carom::cli
