// SPDX-License-Identifier: Apache-2.0
#include "image/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/printable.h"
#include "base/temporary_files.h"

namespace luxo {
namespace {

namespace fs = std::filesystem;

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd) : fd_(fd) {}
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { close(); }

  [[nodiscard]] int get() const { return fd_; }
  [[nodiscard]] bool valid() const { return fd_ >= 0; }
  /// 0, or -1 with errno: some file systems report a failed write only here.
  int close() { return fd_ < 0 ? 0 : ::close(std::exchange(fd_, -1)); }

 private:
  int fd_;
};

// Makes write() report a file size limit and a closed pipe by errno: their signals would end the process.
// Both are sent to the writing thread, so blocking them there, and taking back what arrived, hides them from
// nobody else.
class BlockedWriteSignals {
 public:
  BlockedWriteSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGXFSZ);
    sigaddset(&signals_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  BlockedWriteSignals(const BlockedWriteSignals&) = delete;
  BlockedWriteSignals& operator=(const BlockedWriteSignals&) = delete;
  ~BlockedWriteSignals() {
    const int saved = errno;
    const timespec now{};
    while (sigtimedwait(&signals_, nullptr, &now) > 0) continue;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    errno = saved;
  }

 private:
  sigset_t signals_{};
  sigset_t before_{};
};

std::string hintFor(int code, const fs::path& path) {
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  switch (code) {
    case ENOSPC:
    case EDQUOT:
      return fmt::format("free some space for '{}', or write somewhere else", folder);
    case EFBIG:
      return "the file is larger than a limit allows; see ulimit -f";
    case ENOENT:
      return fmt::format("create the folder first: mkdir -p '{}'", folder);
    case ENOTDIR:
      return fmt::format("'{}' is not a folder", folder);
    case EISDIR:
      return "it is a folder; add a file name";
    case EACCES:
    case EPERM:
      return fmt::format("you may not write in '{}'; choose another folder", folder);
    case EROFS:
      return fmt::format("'{}' is read-only; choose another folder", folder);
    case ENAMETOOLONG:
      return "choose a shorter name";
    default:
      return {};
  }
}

[[noreturn]] void throwWriteError(const fs::path& path, int code) {
  throw Error(ErrorKind::Write,
              fmt::format("cannot write '{}': {}", printable(path.string()), std::strerror(code)),
              hintFor(code, path));
}

/// 0, or the errno of the write that failed.
int writeAll(int fd, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes = bytes.subspan(std::size_t(written));
  }
  return 0;
}

void writeDirectly(const fs::path& path, std::span<const std::byte> bytes) {
  const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.valid()) throwWriteError(path, errno);
  if (const int code = writeAll(file.get(), bytes)) throwWriteError(path, code);
}

// A file of our own next to the target; removed again unless it becomes the target.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& target)
      : target_(target), file_(create(target, temporary_, name_)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }

  void write(std::span<const std::byte> bytes) {
    if (const int code = writeAll(file_.get(), bytes)) throwWriteError(target_, code);
    if (::fsync(file_.get()) != 0) throwWriteError(target_, errno);
    if (file_.close() != 0) throwWriteError(target_, errno);
  }

  /// What replaces a file may be read and written by whom that one could.
  void takeMode(mode_t mode) {
    if (::fchmod(file_.get(), mode & 07777) != 0) throwWriteError(target_, errno);
  }

  void becomeTarget() {
    if (::rename(temporary_.c_str(), target_.c_str()) != 0) throwWriteError(target_, errno);
    temporary_.clear();
    name_.reset();
  }

 private:
  // O_EXCL instead of mkstemp, which would force mode 0600 upon the picture. Process and count keep
  // concurrent writers apart; on a shared disk another host may have taken the name, then the next is tried.
  static int create(const fs::path& target, fs::path& temporary, std::optional<TemporaryName>& name) {
    static std::atomic<unsigned> count{0};
    for (;;) {
      fs::path candidate = target.parent_path() / fmt::format(".luxo-{}-{}.tmp", ::getpid(), ++count);
      const int fd = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (fd < 0 && errno == EEXIST) continue;
      if (fd < 0) throwWriteError(target, errno);
      name.emplace(candidate.string());
      temporary = std::move(candidate);
      return fd;
    }
  }

  const fs::path& target_;
  fs::path temporary_;
  std::optional<TemporaryName> name_;
  FileDescriptor file_;
};

}  // namespace

std::vector<std::byte> readFile(const fs::path& path) {
  const auto failed = [&](int code) {
    return Error(ErrorKind::Scene,
                 fmt::format("cannot read '{}': {}", printable(path.string()), std::strerror(code)));
  };
  // Without O_NONBLOCK a pipe that nobody writes to would hold up the opening itself.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.valid()) throw failed(errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) throw failed(errno);
  if (S_ISDIR(status.st_mode)) throw failed(EISDIR);
  if (!S_ISREG(status.st_mode))
    throw Error(ErrorKind::Scene,
                fmt::format("cannot read '{}': it is no regular file", printable(path.string())),
                "devices and pipes have no end that one could wait for");
  std::vector<std::byte> bytes;
  // What it says is its size, unless that is too much to believe before it is read.
  bytes.reserve(std::size_t(std::clamp<off_t>(status.st_size, 0, off_t(1) << 30)));
  std::array<std::byte, 65536> chunk;
  for (;;) {
    const ssize_t size = ::read(file.get(), chunk.data(), chunk.size());
    if (size == 0) return bytes;
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) throw failed(errno);
    bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + size);
  }
}

namespace {

/// Where writing to a path leads.
struct Destination {
  fs::path file;
  bool exists = false;
  mode_t mode = 0;  ///< where it exists

  [[nodiscard]] bool regular() const { return !exists || S_ISREG(mode); }
};

/// Error(Write): a folder, or nothing that the system could look at.
Destination destinationOf(const fs::path& path) {
  struct stat existing {};
  if (::stat(path.c_str(), &existing) != 0) {
    if (errno != ENOENT) throwWriteError(path, errno);
    return {.file = path};
  }
  if (S_ISDIR(existing.st_mode)) throwWriteError(path, EISDIR);
  const bool regular = S_ISREG(existing.st_mode);
  return {.file = regular ? fs::canonical(path) : path, .exists = true, .mode = existing.st_mode};
}

}  // namespace

void requireWritable(const fs::path& path) {
  const Destination destination = destinationOf(path);
  if (destination.regular())
    static_cast<void>(TemporaryFile(destination.file));  // what writing begins with
  else if (::access(path.c_str(), W_OK) != 0)
    throwWriteError(path, errno);
}

void writeFileAtomically(const fs::path& path, std::span<const std::byte> bytes) {
  const BlockedWriteSignals blocked;
  const Destination destination = destinationOf(path);
  if (!destination.regular()) return writeDirectly(path, bytes);
  TemporaryFile file(destination.file);
  if (destination.exists) file.takeMode(destination.mode);
  file.write(bytes);
  file.becomeTarget();
}

}  // namespace luxo
