#include "cli/terminal.h"

#include <fmt/color.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <memory>

#include "base/bytes.h"
#include "base/number.h"
#include "formats/iges/file.h"
#include "formats/iges/names.h"
#include "formats/step/file.h"

namespace trimloop::cli {

bool use_color(const Common& common) {
  if (common.color != When::Auto) return common.color == When::Always;
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  if (no_color && *no_color) return false;
  if (term && std::string_view(term) == "dumb") return false;
  return ::isatty(STDERR_FILENO) != 0;
}

namespace {

std::string painted(const Common& common, fmt::text_style style, std::string_view text) {
  return use_color(common) ? fmt::format(style, "{}", text) : std::string(text);
}

fmt::text_style style_of(Severity severity) {
  switch (severity) {
    case Severity::Fatal:
    case Severity::Error: return fmt::emphasis::bold | fmt::fg(fmt::terminal_color::red);
    case Severity::Warning: return fmt::emphasis::bold | fmt::fg(fmt::terminal_color::yellow);
    default: return fmt::emphasis::bold | fmt::fg(fmt::terminal_color::cyan);
  }
}

// Set while a bar stands on the last line of the terminal.
bool bar_is_shown = false;

void clear_bar() {
  if (!bar_is_shown) return;
  std::fputs("\r\033[K", stderr);
  bar_is_shown = false;
}

}  // namespace

void complain(const Common& common, std::string_view what, std::string_view next) {
  clear_bar();
  fmt::print(stderr, "trimloop: {} {}\n", painted(common, style_of(Severity::Error), "error:"), what);
  if (!next.empty()) fmt::print(stderr, "  try: {}\n", next);
}

void say(const Common& common, std::string_view line) {
  if (common.quiet) return;
  clear_bar();
  fmt::print(stderr, "{}\n", line);
}

bool emit(const Common& common, std::string_view data) {
  if (!common.output.empty() && common.output != "-") {
    const auto saved = io::save(common.output, data, common.force);
    if (!saved) complain(common, saved.error().text);
    return saved.has_value();
  }
  clear_bar();
  const bool written = std::fwrite(data.data(), 1, data.size(), stdout) == data.size() && std::fflush(stdout) == 0;
  if (!written) complain(common, "cannot write to standard output");
  return written;
}

bool take_sew(const std::string& word, io::ReadOptions& options) {
  options.sew = word != "off";
  if (word == "off" || word == "auto") return true;
  std::string_view number = word;
  if (number.size() > 2 && number.substr(number.size() - 2) == "mm") number.remove_suffix(2);
  const NumberText<double> value = read_real(number);
  if (!value || !(value.value > 0)) return false;
  options.sew_mm = value.value;
  return true;
}

io::ReadResult read_input(const Common& common, const std::string& file, io::ReadOptions options) {
  options.assume_unit = common.assume_unit;
  options.execution = common.execution;
  if (file != "-") return io::read(file, options);
  std::string bytes;
  char block[1 << 16];
  for (;;) {
    const std::size_t n = std::fread(block, 1, sizeof block, stdin);
    bytes.append(block, n);
    if (n == 0 || bytes.size() > common.execution.limits.file_bytes) break;
  }
  return io::read_bytes(std::move(bytes), "-", options);
}

int exit_code_of(const io::ReadResult& result) {
  if (result.io_failed) return CannotReadOrWrite;
  if (result.limit_reached) return LimitReached;
  return result.usable ? Done : Findings;
}

std::string describe(const Common& common, const io::ReadResult& result, const Diagnostic& d) {
  std::string out = result.source.name;
  if (d.location.line) out += fmt::format(":{}:{}", d.location.line, d.location.column);
  const std::string head = fmt::format("{}[{} {}]", to_string(d.severity), d.rule->id, d.rule->slug);
  out += fmt::format(": {}: {}\n", painted(common, style_of(d.severity), head), printable(d.text, 400));

  std::string where;
  if (!d.entity.empty()) {
    where += d.entity;
    if (!d.type.empty()) {
      const bool is_iges = result.source.format == io::Format::Iges;
      const std::string_view name = is_iges ? iges::entity_name(std::atoi(d.type.c_str())) : std::string_view{};
      where += name.empty() ? fmt::format(" ({})", d.type) : fmt::format(" ({} {})", d.type, name);
    }
    if (d.parameter > 0) where += fmt::format(", parameter {}", d.parameter);
    if (!d.path.empty()) where += fmt::format(", used by {}", fmt::join(d.path, " in "));
  }
  const std::string unit = d.unit.empty() ? std::string(d.rule->unit) : d.unit;
  if (d.measured == d.measured) {
    where += fmt::format("{}measured {:.6g}{}{}", where.empty() ? "" : "; ", d.measured, unit.empty() ? "" : " ", unit);
    if (d.limit == d.limit) where += fmt::format(", limit {:.6g}{}{}", d.limit, unit.empty() ? "" : " ", unit);
  }
  if (d.at) where += fmt::format("{}at ({:.6g}, {:.6g}, {:.6g}) mm", where.empty() ? "" : "; ", (*d.at)[0], (*d.at)[1], (*d.at)[2]);
  if (!where.empty()) out += "  " + where + "\n";

  if (d.location.line && (result.source.iges || result.source.step)) {
    const std::string_view bytes = result.source.iges ? result.source.iges->bytes() : result.source.step->bytes();
    const std::size_t begin = d.location.offset - (d.location.column - 1);
    std::size_t end = begin;
    while (end < bytes.size() && bytes[end] != '\n' && bytes[end] != '\r' && end - begin < 100) ++end;
    const std::string number = fmt::format("{:>6}", d.location.line);
    out += fmt::format("{} | {}\n", number, printable(bytes.substr(begin, end - begin), 120));
    if (d.location.column <= 100) {
      out += fmt::format("       | {}{}\n", std::string(d.location.column - 1, ' '),
                         std::string(std::max<std::size_t>(1, std::min<std::size_t>(d.location.length, 60)), '^'));
    }
  }
  return out;
}

std::string summary(const Report& report) {
  std::string out;
  for (const Severity s : {Severity::Fatal, Severity::Error, Severity::Warning, Severity::Info, Severity::Hint}) {
    const std::size_t n = report.count(s);
    if (n == 0) continue;
    if (!out.empty()) out += ", ";
    const bool counted = s == Severity::Error || s == Severity::Warning || s == Severity::Hint;
    out += fmt::format("{} {}{}", n, to_string(s), counted && n != 1 ? "s" : "");
  }
  return out.empty() ? "no findings" : out;
}

void complain_unusable(const Common& common, const std::string& file, const io::ReadResult& result) {
  for (const Diagnostic& d : result.report.items()) {
    if (d.severity != Severity::Fatal) continue;
    complain(common, fmt::format("{}: {} [{}]", file, printable(d.text, 400), d.rule->id),
             fmt::format("trimloop explain {}", d.rule->id));
    return;
  }
  complain(common, fmt::format("{}: ended early: cancelled, or a limit on time or memory was reached", file));
}

std::function<void(double)> progress_bar(const Common& common, std::string label) {
  const bool wanted = common.progress == When::Always ||
                      (common.progress == When::Auto && !common.quiet && ::isatty(STDERR_FILENO) != 0);
  if (!wanted) return {};
  const auto start = std::chrono::steady_clock::now();
  auto last = std::make_shared<int>(-1);
  const bool at_once = common.progress == When::Always;
  return [start, last, at_once, label = std::move(label)](double done) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const int percent = static_cast<int>(100 * done);
    if ((!at_once && seconds < 0.5) || percent == *last) return;
    *last = percent;
    constexpr int width = 26;
    const int filled = static_cast<int>(width * done);
    fmt::print(stderr, "\r[{}{}] {:3}%  {}", std::string(static_cast<std::size_t>(filled), '='),
               std::string(static_cast<std::size_t>(width - filled), ' '), percent, label);
    std::fflush(stderr);
    bar_is_shown = true;
  };
}

void end_progress(const Common&) { clear_bar(); }

}  // namespace trimloop::cli
