// SPDX-License-Identifier: Apache-2.0
#include "image/file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "image_test_support.h"

namespace luxo {
namespace {

std::vector<std::byte> someBytes(std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = std::byte(i * 31 + i / 256);
  return bytes;
}

/// Lowers the file size limit of the process for its lifetime.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit lowered{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &lowered);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

Error failureOf(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  try {
    writeFileAtomically(path, bytes);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << path << " was written";
  return {ErrorKind::Internal, "nothing was thrown"};
}

void expectWriteError(const Error& error, const std::filesystem::path& path, const std::string& reason) {
  EXPECT_EQ(error.kind(), ErrorKind::Write);
  EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
  EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
  EXPECT_FALSE(error.hint().empty()) << error.what();
}

TEST(WriteFile, WritesAndReplaces) {
  const ScratchFolder folder;
  for (const std::size_t size : {0u, 1u, 65536u, 300001u}) {
    writeFileAtomically(folder / "a", someBytes(size));
    EXPECT_EQ(readFile(folder / "a"), someBytes(size));
    EXPECT_EQ(folder.entries(), 1u);
  }
}

TEST(WriteFile, HonoursTheUmask) {
  const ScratchFolder folder;
  const mode_t before = umask(027);
  writeFileAtomically(folder / "a", someBytes(3));
  umask(before);
  struct stat status {};
  ASSERT_EQ(stat((folder / "a").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST(WriteFile, SizeLimitLeavesTheOldFileAndNothingElse) {
  const ScratchFolder folder;
  const std::filesystem::path file = folder / "a.png";
  writeFileAtomically(file, someBytes(500));
  {
    // Without care this is SIGXFSZ, which ends the process.
    const FileSizeLimit limit(4096);
    expectWriteError(failureOf(file, someBytes(100000)), file, "File too large");
    expectWriteError(failureOf(folder / "new.png", someBytes(100000)), folder / "new.png", "File too large");
  }
  EXPECT_EQ(readFile(file), someBytes(500));
  EXPECT_EQ(folder.entries(), 1u);
  sigset_t pending;
  sigpending(&pending);
  EXPECT_EQ(sigismember(&pending, SIGXFSZ), 0);
}

TEST(WriteFile, FullDiskIsNamed) {
  // Every write to /dev/full says ENOSPC.
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  expectWriteError(failureOf("/dev/full", someBytes(10)), "/dev/full", "No space left on device");
}

// Names come from models, too, where any byte may stand.
TEST(ReadFile, WhatIsNotThereIsNamedInPrintableText) {
  try {
    static_cast<void>(readFile("n\u00f6\xaa\x01such"));
    FAIL() << "there is such a file";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), std::string("cannot read 'n\u00f6??such': No such file or directory"));
  }
}

TEST(WriteFile, ImpossiblePlaces) {
  const ScratchFolder folder;
  writeFileAtomically(folder / "file", someBytes(5));
  std::filesystem::create_directory(folder / "sub");
  expectWriteError(failureOf(folder / "missing" / "a.png", someBytes(5)), folder / "missing" / "a.png",
                   "No such file or directory");
  expectWriteError(failureOf(folder / "file" / "a.png", someBytes(5)), folder / "file" / "a.png",
                   "Not a directory");
  expectWriteError(failureOf(folder / "sub", someBytes(5)), folder / "sub", "Is a directory");
  const std::string longName(300, 'x');
  expectWriteError(failureOf(folder / longName, someBytes(5)), folder / longName, "File name too long");
  EXPECT_EQ(failureOf("/proc/a.png", someBytes(5)).kind(), ErrorKind::Write);
  EXPECT_EQ(folder.entries(), 2u);
  EXPECT_EQ(readFile(folder / "file"), someBytes(5));
}

TEST(WriteFile, KeepsASymbolicLink) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "real");
  writeFileAtomically(folder / "real" / "a", someBytes(5));
  std::filesystem::create_symlink(folder / "real" / "a", folder / "link");
  writeFileAtomically(folder / "link", someBytes(9));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(readFile(folder / "real" / "a"), someBytes(9));
}

TEST(WriteFile, AReplacedFileKeepsItsMode) {
  const ScratchFolder folder;
  for (const unsigned mode : {0600U, 0640U, 0666U, 0755U}) {
    writeFileAtomically(folder / "a", someBytes(5));
    std::filesystem::permissions(folder / "a", std::filesystem::perms(mode));
    writeFileAtomically(folder / "a", someBytes(9));
    EXPECT_EQ(readFile(folder / "a"), someBytes(9));
    EXPECT_EQ(static_cast<unsigned>(std::filesystem::status(folder / "a").permissions()), mode);
  }
}

TEST(WriteFile, WhatCannotBeWrittenIsKnownBefore) {
  const ScratchFolder folder;
  writeFileAtomically(folder / "file", someBytes(5));
  std::filesystem::create_directory(folder / "sub");
  for (const char* good : {"file", "new", "sub/new"}) EXPECT_NO_THROW(requireWritable(folder / good));
  for (const std::string& bad :
       {std::string("missing/a"), std::string("file/a"), std::string("sub"), std::string(300, 'x')})
    EXPECT_THROW(requireWritable(folder / bad), Error) << bad;
  EXPECT_NO_THROW(requireWritable("/dev/null"));
  EXPECT_EQ(folder.entries(), 2u);
  EXPECT_EQ(readFile(folder / "file"), someBytes(5));
}

TEST(ReadFile, RefusesWhatHasNoEnd) {
  const ScratchFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(static_cast<void>(readFile(folder / "pipe")), Error);  // nobody writes there
  EXPECT_THROW(static_cast<void>(readFile("/dev/zero")), Error);
}

TEST(WriteFile, WritesToAPipeWithoutReplacingIt) {
  const ScratchFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const int reader = open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  writeFileAtomically(pipe, someBytes(100));
  std::vector<std::byte> got(200);
  const ssize_t size = read(reader, got.data(), got.size());
  close(reader);
  ASSERT_EQ(size, 100);
  got.resize(100);
  EXPECT_EQ(got, someBytes(100));
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteFile, ReadingWhatIsNotThereNamesIt) {
  const ScratchFolder folder;
  EXPECT_EQ(kindThrownBy([&] { static_cast<void>(readFile(folder / "none")); }), ErrorKind::Scene);
  EXPECT_EQ(kindThrownBy([&] { static_cast<void>(readFile(folder.path())); }), ErrorKind::Scene);
}

}  // namespace
}  // namespace luxo
