// carom info and help, behaviour that needs a process of its own, and the small parts of the
// program.
#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <optional>
#include <thread>

#include "carom/simd/isa.h"
#include "cli/run/state_hash.h"
#include "cli/support/statistics.h"
#include "io/pairs_file.h"
#include "tests/cli/cli_test_util.h"

namespace carom::cli {
namespace {

TEST(ProgramTest, InfoTellsBuildAndMachine) {
  const CommandResult result = run_command({"info"});
  EXPECT_EQ(result.code, 0) << result.err;
  for (const char* word : {"compiler", "flags", "-ffp-contract=off", "ISAs compiled in",
                           "ISAs usable here", "threads", "Highway", "oneTBB", "libzip"}) {
    EXPECT_NE(result.out.find(word), std::string::npos) << word;
  }
  EXPECT_NE(result.out.find(name(active_isa())), std::string::npos);
}

TEST(ProgramTest, HelpAndVersion) {
  const CommandResult help = run_command({"--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_NE(help.out.find("verify"), std::string::npos);
  EXPECT_EQ(run_command({"run", "--help"}).code, 0);
  EXPECT_NE(run_command({"generate", "--help"}).out.find("brownian"), std::string::npos);
  EXPECT_EQ(run_command({"--version"}).out.rfind("carom ", 0), 0u);
}

TEST(ProgramTest, HelpShowsDefaults) {
  for (const char* command : {"run", "pairs"}) {
    const std::string help = run_command({command, "--help"}).out;
    for (const char* text : {"=1 ", "=auto ", "=standard ", "=contact "}) {
      EXPECT_NE(help.find(text), std::string::npos) << command << ": " << text;
    }
  }
  EXPECT_NE(run_command({"generate", "--help"}).out.find(".aabbs"), std::string::npos);
}

// Sets CAROM_ISA and restores its old value.
class IsaVariable {
 public:
  explicit IsaVariable(const std::string& value) {
    if (const char* old = std::getenv("CAROM_ISA")) old_ = old;
    setenv("CAROM_ISA", value.c_str(), 1);
  }
  ~IsaVariable() {
    if (old_) {
      setenv("CAROM_ISA", old_->c_str(), 1);
    } else {
      unsetenv("CAROM_ISA");
    }
  }

 private:
  std::optional<std::string> old_;
};

TEST(ProgramTest, UnusableIsaVariableIsRefused) {
  const std::vector<std::string> run = {"run", "still:n=5,frames=1"};
  const std::vector<Isa> usable = usable_isas();
  for (const Isa isa : {Isa::scalar, Isa::sse4, Isa::avx2, Isa::avx512, Isa::neon}) {
    const IsaVariable variable(name(isa));
    if (std::find(usable.begin(), usable.end(), isa) != usable.end()) {
      EXPECT_EQ(run_command(run).code, 0) << name(isa);
    } else {
      expect_error(run, {"CAROM_ISA", name(isa), "cannot be used here"});
    }
  }
  for (const char* harmless : {"", "auto"}) {
    const IsaVariable variable(harmless);
    EXPECT_EQ(run_command(run).code, 0) << harmless;
  }
  const IsaVariable variable("mmx");
  expect_error(run, {"CAROM_ISA", "unknown ISA 'mmx'", "avx2"});
  EXPECT_EQ(run_command({"--version"}).code, 0);
}

// The built program as a process; killed at the end if it still runs.
class Process {
 public:
  explicit Process(std::vector<std::string> arguments, const char* error_path = "/dev/null") {
    arguments.insert(arguments.begin(), CAROM_PROGRAM);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    id_ = ::fork();
    if (id_ != 0) return;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    const int error = ::open(error_path, O_WRONLY | O_NOCTTY);
    ::dup2(error, STDERR_FILENO);
    ::execv(CAROM_PROGRAM, pointers.data());
    ::_exit(127);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process() {
    if (id_ > 0) end_with(SIGKILL);
  }

  // Sends a signal and returns the status of the process as waitpid() gives it.
  int end_with(int signal) {
    int status = -1;
    ::kill(id_, signal);
    ::waitpid(id_, &status, 0);
    id_ = -1;
    return status;
  }

 private:
  pid_t id_ = -1;
};

bool happens(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return true;
}

class ProcessTest : public CliTest {
 protected:
  uintmax_t bytes_in_folder() const {
    uintmax_t bytes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(path(""))) {
      std::error_code gone;
      const uintmax_t size = entry.file_size(gone);
      if (!gone) bytes += size;
    }
    return bytes;
  }
};

TEST_F(ProcessTest, SignalsLeaveNoFileBehind) {
  const std::string scene = "brownian:n=2000,frames=1000000000";
  const std::vector<std::vector<std::string>> commands = {
      {"generate", scene, "-o", path("out.npz")},
      {"generate", scene, "-o", path("out.aabb")},
      {"run", scene, "--threads", "2", "--pairs-out", path("out.npz"), "--json", path("out.json")}};
  for (const std::vector<std::string>& command : commands) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      Process process(command);
      const size_t outputs = command.front() == "run" ? 2 : 1;
      ASSERT_TRUE(happens([&] { return files() == outputs; }));
      const int status = process.end_with(signal);
      EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
      EXPECT_EQ(files(), 0u) << command.front();
    }
  }
}

// libzip writes to a temporary file whose name the program does not know, and which must not be
// left.
TEST_F(ProcessTest, ASignalWhileTheArchiveIsPutTogether) {
  Process process({"generate", "still:n=400000,frames=20", "-o", path("out.npz")});
  ASSERT_TRUE(happens([&] { return bytes_in_folder() > 0; }));
  const int status = process.end_with(SIGINT);
  // The program may finish before the signal arrives.
  const bool complete = std::filesystem::exists(path("out.npz"));
  EXPECT_TRUE(complete || WIFSIGNALED(status));
  EXPECT_EQ(files(), complete ? 1u : 0u);
}

// Reads the program's output from a terminal until `text` appears.
std::string read_until(int terminal, const std::string& text) {
  std::string seen;
  pollfd ready{terminal, POLLIN, 0};
  while (seen.find(text) == std::string::npos && ::poll(&ready, 1, 20'000) == 1) {
    char bytes[256];
    const ssize_t count = ::read(terminal, bytes, sizeof bytes);
    if (count <= 0) break;
    seen.append(bytes, static_cast<size_t>(count));
  }
  return seen;
}

TEST_F(ProcessTest, LongPairsShowProgressOnATerminal) {
  io::PairsFile file;
  file.pairs = 10'000;
  file.shapes.kind = {0};
  file.shapes.params = {{1}};
  for (io::PairSide* side : {&file.a, &file.b}) {
    side->shape.assign(file.pairs, 0);
    side->position32.assign(file.pairs, {0, 0, 0});
  }
  ASSERT_TRUE(io::write_pairs(path("in.npz"), file));
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(terminal, 0);
  ASSERT_EQ(::grantpt(terminal) | ::unlockpt(terminal), 0);
  Process process({"pairs", path("in.npz"), "-o", path("out.npz"), "--repeat", "1000000"},
                  ::ptsname(terminal));
  const std::string seen = read_until(terminal, "/1000000");
  EXPECT_EQ(seen.rfind("run ", 0), 0u) << seen;
  process.end_with(SIGTERM);
  ::close(terminal);
  EXPECT_EQ(files(), 1u);
}

TEST(ProgramTest, Statistics) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(median({}), 0);
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  const Summary summary = summarize(values);
  EXPECT_EQ(summary.min, 1);
  EXPECT_EQ(summary.p99, 198);
  EXPECT_EQ(summary.median, 100.5);
  EXPECT_EQ(summary.mean, 100.5);
  EXPECT_EQ(summarize({7}).p99, 7);
}

std::string hash_of(const std::vector<std::vector<uint8_t>>& lists) {
  StateHash hash;
  for (const auto& list : lists) hash.add(std::span(list));
  return hash.text();
}

TEST(ProgramTest, HashSeesOrderLengthAndEveryBit) {
  EXPECT_EQ(hash_of({{1, 2}, {3}}), hash_of({{1, 2}, {3}}));
  EXPECT_NE(hash_of({{1, 2}, {3}}), hash_of({{1}, {2, 3}}));
  EXPECT_NE(hash_of({{1, 2}}), hash_of({{2, 1}}));
  EXPECT_NE(hash_of({{0}}), hash_of({{0, 0}}));
  EXPECT_NE(hash_of({{}}), hash_of({}));
  EXPECT_NE(hash_of({std::vector<uint8_t>(64, 0)}), hash_of({std::vector<uint8_t>(64, 128)}));
}

}  // namespace
}  // namespace carom::cli
