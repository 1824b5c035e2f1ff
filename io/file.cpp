#include "io/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "io/io.h"

namespace trimloop::io {

namespace {

// Owns a file descriptor.
struct Descriptor {
  int fd = -1;
  explicit Descriptor(int f) : fd(f) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd >= 0) ::close(fd);
  }
};

tl::unexpected<Error> system_error(std::string_view what, const std::filesystem::path& path) {
  return fail(ErrorCode::Io, fmt::format("{} {}: {}", what, path.string(), std::strerror(errno)));
}

tl::unexpected<Error> too_large(const std::filesystem::path& path, std::size_t bytes, std::size_t limit) {
  return fail(ErrorCode::Limit, fmt::format("{} has {} bytes, more than the limit of {}", path.string(), bytes, limit),
              static_cast<double>(bytes), static_cast<double>(limit));
}

}  // namespace

Result<std::string> load(const std::filesystem::path& path, std::size_t max_bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.fd < 0) return system_error("cannot open", path);
  struct stat status {};
  if (::fstat(file.fd, &status) != 0) return system_error("cannot examine", path);
  if (S_ISDIR(status.st_mode)) return fail(ErrorCode::Io, fmt::format("cannot read {}: it is a directory", path.string()));
  const auto stated = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
  if (stated > max_bytes) return too_large(path, stated, max_bytes);

  // Pipes state no size: read until the end in growing steps, the stated size only reserves.
  std::string bytes;
  std::size_t used = 0;
  bytes.resize(stated + 1);
  for (;;) {
    if (used == bytes.size()) bytes.resize(bytes.size() * 2 + (std::size_t{1} << 16));
    const ssize_t n = ::read(file.fd, bytes.data() + used, bytes.size() - used);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return system_error("cannot read", path);
    if (n == 0) break;
    used += static_cast<std::size_t>(n);
    if (used > max_bytes) return too_large(path, used, max_bytes);
  }
  bytes.resize(used);
  return bytes;
}

Result<void> save(const std::filesystem::path& path, std::string_view bytes, bool overwrite) {
  std::error_code ignored;
  if (!overwrite && std::filesystem::exists(path, ignored)) {
    return fail(ErrorCode::Io, fmt::format("{} exists; --force overwrites it", path.string()));
  }
  std::string temporary = path.string() + ".XXXXXX";
  const Descriptor file(::mkstemp(temporary.data()));
  if (file.fd < 0) return system_error("cannot write beside", path);
  const auto abandon = [&](std::string_view what) {
    auto error = system_error(what, path);
    ::unlink(temporary.c_str());
    return error;
  };
  while (!bytes.empty()) {
    const ssize_t n = ::write(file.fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return abandon("cannot write");
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  // mkstemp makes files private; an output file has the rights that any new file would have.
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (::fchmod(file.fd, 0666 & ~mask) != 0) return abandon("cannot set the rights of");
  if (::rename(temporary.c_str(), path.c_str()) != 0) return abandon("cannot replace");
  return {};
}

}  // namespace trimloop::io
