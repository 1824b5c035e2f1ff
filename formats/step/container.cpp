#include "formats/step/container.h"

#include <fmt/format.h>
#include <zlib.h>

#include <vector>

#include "base/bytes.h"
#include "formats/step/rules.h"

namespace trimloop::step {
namespace {

constexpr std::size_t room = std::size_t{1} << 20;  // whatever the ratio

void refuse(Report& report, std::string text, double measured = not_measured, double limit = not_measured) {
  Diagnostic& d = report.add(rules::container, Severity::Fatal, std::move(text));
  d.location.offset = 0;
  d.measured = measured;
  d.limit = limit;
}

// Inflates all of `packed`. `window`: -15 for the raw streams of ZIP, 31 for gzip (RFC 1951, 1952).
std::optional<std::string> inflated(std::string_view packed, int window, const Limits& limits, Report& report) {
  z_stream stream{};
  if (inflateInit2(&stream, window) != Z_OK) {
    refuse(report, "the decompression cannot be started");
    return std::nullopt;
  }
  const std::size_t most = std::min(limits.file_bytes, packed.size() * largest_ratio + room);
  std::string out;
  std::size_t fed = 0, used = 0;
  int state = Z_OK;
  while (state != Z_STREAM_END) {
    if (stream.avail_in == 0 && fed < packed.size()) {
      const std::size_t n = std::min<std::size_t>(packed.size() - fed, std::size_t{1} << 30);
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + fed));
      stream.avail_in = static_cast<uInt>(n);
      fed += n;
    }
    if (used == out.size()) out.resize(std::min(most + 1, std::max(out.size() * 2, 4 * packed.size() + 4096)));
    const std::size_t free_bytes = std::min<std::size_t>(out.size() - used, std::size_t{1} << 30);
    stream.next_out = reinterpret_cast<Bytef*>(out.data() + used);
    stream.avail_out = static_cast<uInt>(free_bytes);
    state = inflate(&stream, Z_NO_FLUSH);
    used += free_bytes - stream.avail_out;
    const bool starved = state == Z_BUF_ERROR || (state == Z_OK && stream.avail_in == 0 && fed == packed.size() && stream.avail_out > 0);
    if (used > most || (state != Z_OK && state != Z_STREAM_END) || starved) break;
  }
  inflateEnd(&stream);
  if (used > most) {
    refuse(report, fmt::format("the file unpacks to more than {} bytes, {} times what is packed", most, largest_ratio),
           static_cast<double>(used), static_cast<double>(most));
    return std::nullopt;
  }
  if (state != Z_STREAM_END) {
    refuse(report, "the compressed data are damaged or cut");
    return std::nullopt;
  }
  out.resize(used);
  return out;
}

std::uint32_t number(std::string_view bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = count - 1; i >= 0; --i) {
    const std::size_t k = at + static_cast<std::size_t>(i);
    value = value << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
  }
  return value;
}

struct Member {
  std::string name;
  std::uint32_t flags = 0, method = 0, packed = 0, size = 0, offset = 0;
};

// The central directory (APPNOTE 4.3.12), found from its end record.
std::optional<std::vector<Member>> members(std::string_view zip) {
  constexpr std::size_t end_record = 22, longest_comment = 65535;
  if (zip.size() < end_record) return std::nullopt;
  const std::size_t from = zip.size() > end_record + longest_comment ? zip.size() - end_record - longest_comment : 0;
  const std::size_t end = zip.rfind("PK\5\6");
  if (end == std::string_view::npos || end < from) return std::nullopt;
  const std::size_t count = number(zip, end + 10, 2);
  std::size_t at = number(zip, end + 16, 4);
  std::vector<Member> out;
  for (std::size_t i = 0; i < count; ++i) {
    if (at + 46 > zip.size() || zip.substr(at, 4) != "PK\1\2") return std::nullopt;
    Member m;
    m.flags = number(zip, at + 8, 2);
    m.method = number(zip, at + 10, 2);
    m.packed = number(zip, at + 20, 4);
    m.size = number(zip, at + 24, 4);
    m.offset = number(zip, at + 42, 4);
    const std::size_t name = number(zip, at + 28, 2);
    m.name = zip.substr(at + 46, name);
    at += 46 + name + number(zip, at + 30, 2) + number(zip, at + 32, 2);
    out.push_back(std::move(m));
  }
  return out;
}

bool escapes(std::string_view name) {
  return name.find("..") != std::string_view::npos || (!name.empty() && (name[0] == '/' || name[0] == '\\')) ||
         (name.size() > 1 && name[1] == ':');
}

std::optional<std::string> from_zip(std::string_view zip, const Limits& limits, Report& report) {
  const auto all = members(zip);
  if (!all) {
    refuse(report, "the archive has no readable directory; it may be cut");
    return std::nullopt;
  }
  // The root of edition 3, else the only file.
  const Member* root = nullptr;
  std::size_t files = 0, roots = 0;
  for (const Member& m : *all) {
    if (!m.name.empty() && m.name.back() == '/') continue;
    if (escapes(m.name)) {
      report.add(rules::container, fmt::format("a member of the archive leads out of it: {}; it is left out", printable(m.name, 60)));
      continue;
    }
    ++files;
    if (m.name == "ISO-10303.p21" || m.name == "ISO-10303-21.p21") root = &m, ++roots;
    else if (roots == 0) root = &m;
  }
  if (!root || roots > 1 || (roots == 0 && files > 1)) {
    refuse(report, !root ? "the archive holds no file" : fmt::format("the archive holds {} files and not one root ISO-10303.p21", files),
           static_cast<double>(files), 1);
    return std::nullopt;
  }
  if (files > 1) report.add(rules::container, Severity::Info, fmt::format("{} more files in the archive are not read", files - 1));
  if (root->flags & 1 || root->packed == 0xFFFFFFFFu || (root->method != 0 && root->method != 8)) {
    refuse(report, root->flags & 1 ? "the archive is encrypted" : "the archive is of a kind that is not read (ZIP64 or an uncommon method)");
    return std::nullopt;
  }
  const std::size_t header = root->offset;
  if (header + 30 > zip.size() || zip.substr(header, 4) != "PK\3\4") {
    refuse(report, "the archive's directory leads nowhere");
    return std::nullopt;
  }
  const std::size_t begin = header + 30 + number(zip, header + 26, 2) + number(zip, header + 28, 2);
  if (begin > zip.size() || root->packed > zip.size() - begin) {
    refuse(report, "the archive is cut");
    return std::nullopt;
  }
  const std::string_view data = zip.substr(begin, root->packed);
  if (root->method == 0) return std::string(data);
  return inflated(data, -15, limits, report);
}

}  // namespace

Container container_of(std::string_view first) {
  if (first.substr(0, 2) == "\x1F\x8B") return Container::Gzip;
  if (first.substr(0, 4) == "PK\3\4" || first.substr(0, 4) == "PK\5\6") return Container::Zip;
  return Container::None;
}

std::optional<std::string> unpack(std::string_view packed, const Limits& limits, Report& report) {
  auto out = container_of(packed) == Container::Gzip ? inflated(packed, 31, limits, report) : from_zip(packed, limits, report);
  if (out && container_of(*out) != Container::None) {
    refuse(report, "the archive holds another archive");
    return std::nullopt;
  }
  return out;
}

}  // namespace trimloop::step
