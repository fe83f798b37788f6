// Numbers and pairs as text.
#pragma once

#include <string>

#include "accuracy/pairs/oracle_pairs.h"

namespace carom::accuracy {

// printf for one number.
std::string text(const char* format, double value);

// All numbers of a pair, in hexadecimal, so that they can be put into a test.
std::string describe(const ConvexPair& pair, PositionType positions);

}  // namespace carom::accuracy
