#include "formats/step/edit.h"

#include <fmt/format.h>

#include <cmath>

#include "base/number.h"
#include "formats/step/scan.h"
#include "formats/step/strings.h"
#include "formats/step/tape.h"

namespace trimloop::step {

namespace {

struct Span {
  std::size_t begin = 0, end = 0;
};
struct Members {  // of "(a,b,c)"
  std::vector<Span> spans;
  std::size_t behind = 0;  // the byte after the ')'
};

// What stands between the '(' at `open` and its ')', parted at commas; blanks and comments around a member are not of it.
std::optional<Members> members(std::string_view text, std::size_t open) {
  Members out;
  std::size_t depth = 0, at = skip_blanks(text, open + 1);
  Span span{at, at};
  while (at < text.size()) {
    const char c = text[at];
    if (depth == 0 && (c == ',' || c == ')')) {
      const bool empty_list = c == ')' && out.spans.empty() && span.begin == span.end;
      if (!empty_list) out.spans.push_back(span);
      out.behind = at + 1;
      if (c == ')') return out;
      at = skip_blanks(text, at + 1);
      span = {at, at};
      continue;
    }
    if (c == '(') ++depth;
    if (c == ')') --depth;
    const std::size_t last = c == '\'' ? end_of_string(text, at) : c == '"' ? text.find('"', at + 1) : at;
    if (last == std::string_view::npos) return std::nullopt;
    span.end = last + 1;
    at = skip_blanks(text, last + 1);
  }
  return std::nullopt;
}

// "KEYWORD (" at `at`: the place of the '(', or npos; a list has no keyword.
std::size_t opening(std::string_view text, std::size_t at, std::string_view* keyword = nullptr) {
  const std::size_t begin = at;
  if (at < text.size() && text[at] == '!') ++at;  // a keyword of the user's own
  while (at < text.size() && is_word(text[at])) ++at;
  if (keyword) *keyword = text.substr(begin, at - begin);
  at = skip_blanks(text, at);
  return at < text.size() && text[at] == '(' ? at : std::string_view::npos;
}

// The '(' of the part's attributes; without a name, of a simple instance.
std::size_t opening_of_part(std::string_view value, const std::string& part) {
  constexpr std::size_t none = std::string_view::npos;
  std::string_view keyword;
  if (value.empty() || value[0] != '(') {
    const std::size_t open = opening(value, 0, &keyword);
    return part.empty() || keyword == part ? open : none;
  }
  std::size_t at = skip_blanks(value, 1);
  while (at < value.size() && value[at] != ')') {
    const std::size_t open = opening(value, at, &keyword);
    if (open == none || keyword == part) return open;
    const auto passed = members(value, open);
    if (!passed) return none;
    at = skip_blanks(value, passed->behind);
  }
  return none;
}

// One parameter as a tape, or nothing when the text is not exactly that.
bool is_parameter(const std::string& wrapped, Tape& tape) {
  const bool read = tape.read(wrapped, Limits{});
  return read && tape.faults().empty() && tape.parts().size() == 1 && tape.size() > 0 && tape[0].end == tape.size();
}

}  // namespace

std::optional<ParameterPath> parameter_path(std::string_view text) {
  ParameterPath path;
  while (true) {
    const std::size_t point = std::min(text.find('.'), text.size());
    const std::string_view word = text.substr(0, point);
    const auto number = read_integer(word);
    if (number && number.value >= 1 && is_digit(word[0])) {
      path.steps.push_back(static_cast<std::size_t>(number.value));
    } else if (path.part.empty() && path.steps.empty() && !word.empty() && !is_digit(word[0])) {
      path.part = word;
    } else {
      return std::nullopt;
    }
    if (point == text.size()) break;
    text.remove_prefix(point + 1);
  }
  if (path.steps.empty()) return std::nullopt;
  return path;
}

Result<std::string_view> parameter_at(const File& file, Ref ref, const ParameterPath& path) {
  const Instance* instance = file.find(ref);
  if (!instance) return fail(ErrorCode::NotFound, "the file has no instance of that name");
  const std::string_view value = file.value(*instance);
  std::size_t open = opening_of_part(value, path.part);
  if (open == std::string_view::npos) {
    return fail(ErrorCode::NotFound, path.part.empty() ? "a complex instance: name the part, as in SI_UNIT.1" : "the instance has no such part");
  }
  Span span;
  for (std::size_t k = 0; k < path.steps.size(); ++k) {
    if (k > 0) {
      open = opening(value.substr(0, span.end), span.begin);
      if (open == std::string_view::npos) return fail(ErrorCode::NotFound, "the parameter has no members");
    }
    const auto inside = members(value, open);
    if (!inside) return fail(ErrorCode::InvalidArgument, "the instance cannot be read so far");
    if (path.steps[k] > inside->spans.size()) {
      return fail(ErrorCode::NotFound, "there is no such parameter", double(path.steps[k]), double(inside->spans.size()));
    }
    span = inside->spans[path.steps[k] - 1];
  }
  return value.substr(span.begin, span.end - span.begin);
}

Result<std::string> set_parameter(const File& file, Ref ref, const ParameterPath& path, std::string_view text) {
  const auto place = parameter_at(file, ref, path);
  if (!place) return tl::unexpected<Error>(place.error());
  const std::string wrapped = fmt::format("X({})", text);
  Tape tape;
  if (!is_parameter(wrapped, tape)) return fail(ErrorCode::InvalidArgument, "that is not one parameter of Part 21");
  for (std::uint32_t i = 0; i < tape.size(); ++i) {
    if (tape[i].kind == Token::Kind::Reference && !file.find({tape[i].id})) {
      return fail(ErrorCode::InvalidArgument, "the file has no #" + std::to_string(tape[i].id));
    }
  }
  const std::string_view bytes = file.bytes();
  const auto at = static_cast<std::size_t>(place->data() - bytes.data());
  std::string out;
  out.reserve(bytes.size() + text.size());
  out += bytes.substr(0, at);
  out += text;
  return out += bytes.substr(at + place->size());
}

Result<std::string> parameter_text(const File& file, Ref ref, const ParameterPath& path, std::string_view value) {
  const auto place = parameter_at(file, ref, path);
  if (!place) return tl::unexpected<Error>(place.error());
  if (value == "$") return std::string(value);
  const std::string wrapped = fmt::format("X({})", *place);
  Tape tape;
  const auto kind = is_parameter(wrapped, tape) ? tape[0].kind : Token::Kind::Bad;
  if (kind == Token::Kind::String) return encode_string(value);
  if (kind == Token::Kind::Real) {
    const auto number = read_real(value);
    if (!number || !std::isfinite(number.value)) return fail(ErrorCode::InvalidArgument, "a real number is wanted");
    return step_real(number.value);
  }
  if (kind == Token::Kind::Integer) {
    const auto number = read_integer(value);
    if (!number) return fail(ErrorCode::InvalidArgument, "an integer is wanted");
    return std::to_string(number.value);
  }
  if (kind == Token::Kind::Reference && (value.empty() || value[0] != '#')) {
    return fail(ErrorCode::InvalidArgument, "an instance is wanted, as in #12");
  }
  if (kind == Token::Kind::Enumeration && (value.empty() || value.front() != '.')) return fmt::format(".{}.", value);
  return std::string(value);
}

}  // namespace trimloop::step
