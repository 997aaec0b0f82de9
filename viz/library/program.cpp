#include "library/program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

extern char** environ;

namespace shoal::viz {
namespace {

namespace fs = std::filesystem;

// Linux takes 2 MiB of arguments and environment together, each with a pointer beside it.
constexpr std::size_t kBatchBytes = std::size_t{1} << 19;

bool can_run(const fs::path& file) {
  std::error_code code;
  return fs::is_regular_file(file, code) && ::access(file.c_str(), X_OK) == 0;
}

std::vector<fs::path> places_of_shoal() {
  std::vector<fs::path> places;
  std::error_code code;
  const fs::path own = fs::read_symlink("/proc/self/exe", code);
  if (!code) {
    const fs::path folder = own.parent_path();
    places.push_back(folder / "shoal");
    places.push_back((folder / "../../engine/app/shoal").lexically_normal());
  }
  const char* path = std::getenv("PATH");
  for (std::string_view rest = path ? path : ""; !rest.empty();) {
    const std::string_view folder = rest.substr(0, rest.find(':'));
    if (!folder.empty()) places.push_back(fs::path(folder) / "shoal");
    rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
  }
  return places;
}

struct Pipe {
  int read_end = -1;
  int write_end = -1;

  Pipe() = default;
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close_end(read_end);
    close_end(write_end);
  }
  bool open() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return false;
    read_end = ends[0];
    write_end = ends[1];
    return true;
  }
  static void close_end(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
};

Error cannot_start(const fs::path& program, int code) {
  return Error{ErrorCode::unreadable, std::string("cannot be started: ") + std::strerror(code),
               program.string(), ""};
}

// Standard output and error at once, so that the program never waits for us.
void read_both(Pipe& out, Pipe& err, Finished& finished) {
  std::array<pollfd, 2> waits{pollfd{out.read_end, POLLIN, 0}, pollfd{err.read_end, POLLIN, 0}};
  const std::array<std::string*, 2> texts{&finished.out, &finished.err};
  std::array<char, 1 << 16> buffer;
  while (waits[0].fd >= 0 || waits[1].fd >= 0) {
    if (::poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR) return;
    for (std::size_t i = 0; i < waits.size(); ++i) {
      if (waits[i].fd < 0 || waits[i].revents == 0) continue;
      const ssize_t count = ::read(waits[i].fd, buffer.data(), buffer.size());
      if (count > 0) texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
      if (count == 0 || (count < 0 && errno != EINTR)) waits[i].fd = -1;
    }
  }
}

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int spawn(const fs::path& program, const std::vector<std::string>& arguments, const Pipe& out,
          const Pipe& err, pid_t& process) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out.write_end, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write_end, STDERR_FILENO);
  const int code =
      ::posix_spawn(&process, program.c_str(), &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return code;
}

}  // namespace

Result<fs::path> find_shoal() {
  for (const fs::path& place : places_of_shoal()) {
    if (can_run(place)) return place;
  }
  return Error{ErrorCode::not_found,
               "the program shoal is needed, which is neither beside shoal-viz nor in PATH", "",
               "install the two together, or add shoal's folder to PATH"};
}

Result<Finished> run_program(const fs::path& program, const std::vector<std::string>& arguments) {
  Pipe out;
  Pipe err;
  if (!out.open() || !err.open()) return cannot_start(program, errno);
  pid_t process = 0;
  if (const int code = spawn(program, arguments, out, err, process); code != 0) {
    return cannot_start(program, code);
  }
  Pipe::close_end(out.write_end);
  Pipe::close_end(err.write_end);
  Finished finished;
  read_both(out, err, finished);
  finished.exit_status = wait_for(process);
  return finished;
}

std::vector<Range> command_line_batches(std::span<const std::string> texts) {
  std::vector<Range> batches;
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const std::size_t size = texts[i].size() + 1 + sizeof(char*);
    if (batches.empty() || bytes + size > kBatchBytes) {
      batches.push_back({i, i});
      bytes = 0;
    }
    bytes += size;
    batches.back().end = i + 1;
  }
  return batches;
}

}  // namespace shoal::viz
