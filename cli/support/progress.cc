#include "cli/support/progress.h"

#include "io/printable.h"

namespace carom::cli {

using std::chrono::milliseconds;

Progress::Progress(const Console& console, const std::string& what, uint64_t total)
    : console_(console),
      what_(io::printable(what)),
      total_(total),
      next_(Clock::now() + milliseconds(1000)) {}

Progress::~Progress() { erase(); }

void Progress::update(uint64_t done) {
  if (!console_.terminal || Clock::now() < next_) return;
  next_ = Clock::now() + milliseconds(200);
  erase();
  std::string line = what_ + ' ' + std::to_string(done) + '/' + std::to_string(total_);
  console_.err << line << std::flush;
  shown_ = line.size();
}

void Progress::erase() {
  if (shown_ == 0) return;
  console_.err << '\r' << std::string(shown_, ' ') << '\r' << std::flush;
  shown_ = 0;
}

}  // namespace carom::cli
