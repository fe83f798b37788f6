#include "cli/support/resource_usage.h"

#include <sys/resource.h>

namespace carom::cli {
namespace {

rusage usage_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

}  // namespace

uint64_t peak_rss_bytes() { return static_cast<uint64_t>(usage_so_far().ru_maxrss) * 1024; }

uint64_t page_faults() { return static_cast<uint64_t>(usage_so_far().ru_minflt); }

}  // namespace carom::cli
