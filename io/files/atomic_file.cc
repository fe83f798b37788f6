#include "io/files/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace carom::io {
namespace {

// The paths of temporary files, where a signal handler can read them.
enum class SlotState : int { kFree, kFilling, kLive, kRemoving };
struct Slot {
  std::atomic<SlotState> state = SlotState::kFree;
  char path[PATH_MAX] = {};
};
static_assert(std::atomic<SlotState>::is_always_lock_free);
constinit std::array<Slot, 32> slots;

bool change(Slot& slot, SlotState from, SlotState to) {
  return slot.state.compare_exchange_strong(from, to);
}

// Returns the slot, or -1 if there is no room and the path is not noted.
int note_temporary(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (size_t i = 0; i < slots.size(); ++i) {
    if (!change(slots[i], SlotState::kFree, SlotState::kFilling)) continue;
    path.copy(slots[i].path, path.size());
    slots[i].path[path.size()] = '\0';
    slots[i].state = SlotState::kLive;
    return static_cast<int>(i);
  }
  return -1;
}

// Counts files that exist under a name that no slot holds. Their threads block signals, and a
// signal handler in another thread waits for zero.
std::atomic<int> creations = 0;
static_assert(std::atomic<int>::is_always_lock_free);

class Creation {
 public:
  Creation() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
    ++creations;
  }
  Creation(const Creation&) = delete;
  Creation& operator=(const Creation&) = delete;
  ~Creation() {
    --creations;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t before_;
};

// Gives up after a second, because the file system may hang.
void wait_for_creations() {
  const timespec millisecond{0, 1'000'000};
  for (int i = 0; i < 1000 && creations != 0; ++i) ::nanosleep(&millisecond, nullptr);
}

// Whether the path is a link into the folders of the system, such as /dev/stdout. Where standard
// output is a file, such a link leads to a regular one.
bool links_to_system(std::filesystem::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int i = 0; i < kMostLinks && std::filesystem::is_symlink(path, error); ++i) {
    const std::filesystem::path target = std::filesystem::read_symlink(path, error);
    path = target.is_absolute() ? target : path.parent_path() / target;
    const std::string text = path.lexically_normal().string();
    if (text.starts_with("/proc/") || text.starts_with("/dev/")) return true;
  }
  return false;
}

std::optional<Error> refuse_special_target(const std::string& path) {
  if (links_to_system(path)) {
    return file_error(path, "is a link to a device or a stream, so it cannot be replaced");
  }
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;  // it does not exist yet
  if (S_ISDIR(status.st_mode)) {
    return file_error(path, "is a directory (a name for a file was expected)");
  }
  if (!S_ISREG(status.st_mode)) {
    return file_error(path, "is not a regular file, so it cannot be replaced");
  }
  return std::nullopt;
}

}  // namespace

AtomicFile::AtomicFile(std::string path, std::string temporary_path, File file)
    : path_(std::move(path)),
      temporary_path_(std::move(temporary_path)),
      slot_(note_temporary(temporary_path_)),
      file_(std::move(file)) {}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_path_(std::exchange(other.temporary_path_, {})),
      slot_(std::exchange(other.slot_, -1)),
      file_(std::move(other.file_)),
      offset_(other.offset_) {}

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(temporary_path_, other.temporary_path_);
  std::swap(slot_, other.slot_);
  std::swap(file_, other.file_);
  std::swap(offset_, other.offset_);
  return *this;
}

AtomicFile::~AtomicFile() { remove_temporary(); }

Result<AtomicFile> AtomicFile::create(const std::string& path) {
  if (path.empty() || path.back() == '/') {
    return file_error(path, "is not the name of a file");
  }
  if (std::optional<Error> error = refuse_special_target(path)) return *error;
  const std::string prefix = path + ".tmp" + std::to_string(::getpid());
  const Creation creation;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const std::string temporary = prefix + "-" + std::to_string(attempt);
    // Not mkstemp: the file must get the permissions that the umask grants.
    File file(::open(temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file) return AtomicFile(path, temporary, std::move(file));
    if (errno != EEXIST) return system_error(path, "cannot be created", errno);
  }
  return file_error(path, "cannot be created: too many temporary files beside it");
}

Result<void> AtomicFile::write(std::span<const std::byte> bytes) {
  Result<void> done = write_at(offset_, bytes);
  if (done) offset_ += bytes.size();
  return done;
}

Result<void> AtomicFile::write_at(uint64_t offset, std::span<const std::byte> bytes) {
  return file_.write_at(offset, bytes, path_);
}

Result<void> AtomicFile::commit() {
  Result<void> closed = file_.close(path_);
  if (!closed) return closed;
  if (std::optional<Error> error = refuse_special_target(path_)) return *error;
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) {
    return system_error(path_, "cannot be created", errno);
  }
  forget_temporary();
  return {};
}

void AtomicFile::remove_temporary() {
  if (!temporary_path_.empty()) ::unlink(temporary_path_.c_str());
  forget_temporary();
}

// Called only after the file was removed or renamed: a signal handler can find it until then.
void AtomicFile::forget_temporary() {
  if (slot_ >= 0) {
    change(slots[static_cast<size_t>(slot_)], SlotState::kLive, SlotState::kFree);
    slot_ = -1;
  }
  temporary_path_.clear();
}

void remove_temporary_files() noexcept {
  const int error_number = errno;
  wait_for_creations();
  for (Slot& slot : slots) {
    // The slot stays in kRemoving, so that no thread fills it meanwhile.
    if (change(slot, SlotState::kLive, SlotState::kRemoving)) ::unlink(slot.path);
  }
  errno = error_number;
}

Result<File> open_spool(const std::string& path) {
  const std::string name = folder_of(path) + ".carom-spool-XXXXXX";
  std::vector<char> pattern(name.c_str(), name.c_str() + name.size() + 1);
  const Creation creation;
  File file(::mkostemp(pattern.data(), O_CLOEXEC));
  if (!file) return system_error(path, "cannot be created", errno);
  ::unlink(pattern.data());
  return file;
}

Result<void> write_text_file(const std::string& path, std::string_view text) {
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  Result<void> written = file->write(std::as_bytes(std::span(text.data(), text.size())));
  if (!written) return written;
  return file->commit();
}

}  // namespace carom::io
