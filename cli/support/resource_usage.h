// The system counts memory and page faults of this process.
#pragma once

#include <cstdint>

namespace carom::cli {

// The most memory that it has had at once.
uint64_t peak_rss_bytes();

// How often it has touched a page that the system had not given it yet, on all threads.
uint64_t page_faults();

}  // namespace carom::cli
