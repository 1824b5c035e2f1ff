#include "formats/svg/path.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/number.h"

namespace trimloop::svg {

namespace {

using Pair = std::array<double, 2>;

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  void skip() {  // blanks and at most one comma
    blanks();
    if (at_ < text_.size() && text_[at_] == ',') ++at_, blanks();
  }
  bool done() {
    blanks();
    return at_ == text_.size();
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void take() { ++at_; }
  std::size_t offset() const { return at_; }
  bool starts_number() {
    skip();
    const char c = peek();
    return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.';
  }
  bool number(double& value) {
    skip();
    std::size_t from = at_;
    if (from < text_.size() && text_[from] == '+') ++from;
    const auto [end, fault] = std::from_chars(text_.data() + from, text_.data() + text_.size(), value);
    if (fault != std::errc{} || !std::isfinite(value)) return false;
    at_ = static_cast<std::size_t>(end - text_.data());
    return true;
  }
  bool flag(bool& value) {  // one digit, which may touch the next number
    skip();
    if (peek() != '0' && peek() != '1') return false;
    value = peek() == '1';
    take();
    return true;
  }
  bool pair(Pair& p) { return number(p[0]) && number(p[1]); }

 private:
  void blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || (text_[at_] >= '\t' && text_[at_] <= '\r'))) ++at_;
  }
  std::string_view text_;
  std::size_t at_ = 0;
};

// The pen: where it is, where the subpath began, and the last control point for S and T.
class Pen {
 public:
  Pen(Scanner& scan, std::vector<Segment>& out) : scan_(scan), out_(out) {}

  bool command(char letter, bool first) {
    const bool relative = letter >= 'a';
    origin_ = relative ? at_ : Pair{0, 0};
    switch (relative ? letter - 'a' + 'A' : letter) {
      case 'M': return first ? move() : line();
      case 'L': return line();
      case 'H': return axis(0);
      case 'V': return axis(1);
      case 'C': return cubic(false);
      case 'S': return cubic(true);
      case 'Q': return quad(false);
      case 'T': return quad(true);
      case 'A': return arc();
      default: return false;
    }
  }
  void close() {
    Segment s;
    s.kind = Segment::Kind::Close;
    out_.push_back(s);
    at_ = start_;
    last_ = 'Z';
  }

 private:
  bool point(Pair& p) {
    if (!scan_.pair(p)) return false;
    p = {origin_[0] + p[0], origin_[1] + p[1]};  // 0 + x keeps x but for the sign of zero
    return true;
  }
  void put(Segment s, Pair end, char last) {
    out_.push_back(s);
    at_ = end;
    last_ = last;
  }
  bool move() {
    Segment s;
    if (!point(s.at[0])) return false;
    start_ = s.at[0];
    put(s, s.at[0], 'M');
    return true;
  }
  bool line() {
    Segment s;
    s.kind = Segment::Kind::Line;
    if (!point(s.at[0])) return false;
    put(s, s.at[0], 'L');
    return true;
  }
  bool axis(std::size_t which) {
    Segment s;
    s.kind = Segment::Kind::Line;
    double value = 0;
    if (!scan_.number(value)) return false;
    s.at[0] = at_;
    s.at[0][which] = origin_[which] + value;
    put(s, s.at[0], 'L');
    return true;
  }
  Pair reflected(char kind) const {
    if (last_ != kind) return at_;
    return {2 * at_[0] - control_[0], 2 * at_[1] - control_[1]};
  }
  bool cubic(bool smooth) {
    Segment s;
    s.kind = Segment::Kind::Cubic;
    if (smooth) s.at[0] = reflected('C');
    else if (!point(s.at[0])) return false;
    if (!point(s.at[1]) || !point(s.at[2])) return false;
    put(s, s.at[2], 'C');
    control_ = s.at[1];
    return true;
  }
  bool quad(bool smooth) {
    Segment s;
    s.kind = Segment::Kind::Quad;
    if (smooth) s.at[0] = reflected('Q');
    else if (!point(s.at[0])) return false;
    if (!point(s.at[1])) return false;
    put(s, s.at[1], 'Q');
    control_ = s.at[0];
    return true;
  }
  bool arc() {
    Segment s;
    s.kind = Segment::Kind::Arc;
    if (!scan_.number(s.rx) || !scan_.number(s.ry) || !scan_.number(s.rotation_deg) || !scan_.flag(s.large) ||
        !scan_.flag(s.sweep) || !point(s.at[0]))
      return false;
    s.rx = std::abs(s.rx), s.ry = std::abs(s.ry);
    if (s.rx == 0 || s.ry == 0) s.kind = Segment::Kind::Line;  // SVG 1.1 F.6.2
    put(s, s.at[0], 'A');
    return true;
  }

  Scanner& scan_;
  std::vector<Segment>& out_;
  Pair at_{}, start_{}, control_{}, origin_{};
  char last_ = 'M';
};

}  // namespace

Result<std::vector<Segment>> parse_path(std::string_view data) {
  std::vector<Segment> out;
  Scanner scan(data);
  Pen pen(scan, out);
  const auto bad = [&scan](std::string_view what) {
    return fail(ErrorCode::InvalidArgument, fmt::format("{} at offset {} of the path data", what, scan.offset()),
                static_cast<double>(scan.offset()));
  };
  while (!scan.done()) {
    const char letter = scan.peek();
    if (std::string_view("MmLlHhVvCcSsQqTtAaZz").find(letter) == std::string_view::npos || letter == '\0') return bad("no command");
    if (out.empty() && letter != 'M' && letter != 'm') return bad("path data begin with a move, which is not");
    scan.take();
    if (letter == 'Z' || letter == 'z') {
      pen.close();
      continue;
    }
    bool first = true;
    do {
      if (!pen.command(letter, first)) return bad(fmt::format("the numbers of '{}' end or are none", letter));
      first = false;
    } while (scan.starts_number());
  }
  return out;
}

void append_path_text(std::string& out, const std::vector<Segment>& path) {
  const auto add = [&out](char letter, std::initializer_list<double> numbers) {
    char text[8 * 25];  // at most seven numbers and what parts them
    char* to = text;
    char before = letter;
    for (const double n : numbers) {
      *to++ = before;
      to = std::to_chars(to, text + sizeof text, n == 0 ? 0.0 : n).ptr;
      before = ' ';
    }
    out.append(text, to);
  };
  for (const Segment& s : path) {
    const auto& a = s.at;
    switch (s.kind) {
      case Segment::Kind::Move: add('M', {a[0][0], a[0][1]}); break;
      case Segment::Kind::Line: add('L', {a[0][0], a[0][1]}); break;
      case Segment::Kind::Quad: add('Q', {a[0][0], a[0][1], a[1][0], a[1][1]}); break;
      case Segment::Kind::Cubic: add('C', {a[0][0], a[0][1], a[1][0], a[1][1], a[2][0], a[2][1]}); break;
      case Segment::Kind::Arc:
        add('A', {s.rx, s.ry, s.rotation_deg, s.large ? 1.0 : 0.0, s.sweep ? 1.0 : 0.0, a[0][0], a[0][1]});
        break;
      case Segment::Kind::Close: out += 'Z'; break;
    }
  }
}

std::string path_text(const std::vector<Segment>& path) {
  std::string out;
  append_path_text(out, path);
  return out;
}

}  // namespace trimloop::svg
