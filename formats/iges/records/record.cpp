#include "formats/iges/records/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bytes.h"
#include "base/number.h"
#include "formats/iges/rules.h"

namespace trimloop::iges {
namespace {

constexpr std::size_t most_findings = 50;    // on single tokens of one record; the record is bad enough by then
constexpr std::size_t most_notes = 100'000;  // AsGiven of one record; beyond it empty fields go back as their values

// What the two trailing groups may point to: associativities, notes and text templates; properties and attribute
// tables.
constexpr std::initializer_list<int> associativity_kinds = {402, 212, 312};
constexpr std::initializer_list<int> property_kinds = {406, 422, 316};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string hollerith(std::string_view text) {
  return text.empty() ? std::string() : fmt::format("{}H{}", text.size(), text);
}

Field field_of(const Token& token) {
  const bool is_text = token.kind == Token::Kind::Text;
  return {token.kind, std::string(is_text ? trimmed(token.text) : token.text)};
}

std::string text_of(const Field& field) {
  switch (field.kind) {
    case Token::Kind::Empty:
      return {};
    case Token::Kind::Text:
      return field.text;
    case Token::Kind::Hollerith:
      return fmt::format("{}H{}", field.text.size(), field.text);
  }
  return {};
}

// As find_first_of, which calls memchr for every character: here the first or second decides.
template <std::size_t N>
bool has_any(std::string_view text, const char (&set)[N]) {
  for (char c : text)
    for (std::size_t i = 0; i + 1 < N; ++i)
      if (c == set[i]) return true;
  return false;
}

bool has_digit(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// The spellings of "not a number" and "infinite" that run-time libraries print, and Fortran's overflowed field.
bool is_not_finite_word(std::string_view text) {
  std::string upper;
  for (char c : text.substr(0, 16)) upper += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return upper.find("NAN") != std::string::npos || upper.find("INF") != std::string::npos ||
         upper.find('#') != std::string::npos || upper.find("**") != std::string::npos;
}

}  // namespace

void AsGiven::restore(std::vector<std::string>& tokens) const {
  if (tokens.size() != canonical_count) return;
  for (const Note& note : notes) {
    if (note.index > canonical_count)
      tokens.push_back(text_of(note.given));
    else if (!note.omitted && tokens[note.index - 1] == note.canonical)
      tokens[note.index - 1] = text_of(note.given);
  }
  const bool still_default = std::all_of(notes.begin(), notes.end(), [&](const Note& note) {
    return !note.omitted || tokens[note.index - 1] == note.canonical;
  });
  if (!still_default) return;
  for (auto note = notes.rbegin(); note != notes.rend(); ++note)
    if (note->omitted) tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(note->index - 1));
}

TokenReader::TokenReader(const File& file, const DirectoryEntry& entry, const Parameters& parameters,
                         const Limits& limits, Report& report)
    : file_(file), entry_(entry), tokens_(parameters.tokens), limits_(limits), report_(report) {}

std::size_t TokenReader::left() const { return tokens_.size() > next_ ? tokens_.size() - next_ : 0; }

// The next token, or null when the record has ended, the place in it is lost or an optional tail is not there.
const Token* TokenReader::next() {
  ++canonical_;
  if (lost_) return nullptr;
  if (absent_ > 0) {
    --absent_;
    return nullptr;
  }
  return next_ < tokens_.size() ? &tokens_[next_++] : nullptr;
}

// --- findings ---------------------------------------------------------------------------------------------------

void TokenReader::add(std::size_t parameter, Severity severity, const Rule& rule, std::string text, double measured,
                      double limit) {
  if (report_.count(rule.id) >= Report::stored_per_rule) {
    report_.add(rule, severity, {});  // only counted
    return;
  }
  Diagnostic finding;
  finding.rule = &rule;
  finding.severity = severity;
  finding.text = std::move(text);
  if (!tokens_.empty()) {
    const Token& token = tokens_[std::min(parameter, tokens_.size() - 1)];
    finding.location = file_.locate(token.offset);
    finding.location.offset = token.offset;
    finding.location.length = token.text.size();
  }
  finding.entity = fmt::format("D{}", entry_.de);
  finding.type = fmt::format("{}:{}", entry_.type, entry_.form);
  finding.parameter = static_cast<int>(std::min<std::size_t>(parameter, std::numeric_limits<int>::max()));
  finding.measured = measured;
  finding.limit = limit;
  report_.add(std::move(finding));
}

void TokenReader::fault(const Rule& rule, std::string text, double measured, double limit) {
  fault_at(next_ - 1, rule, std::move(text), measured, limit);
}

void TokenReader::remark(const Rule& rule, std::string text, double measured, double limit) {
  remark_at(next_ - 1, rule.severity, rule, std::move(text), measured, limit);
}

void TokenReader::fault_at(std::size_t parameter, const Rule& rule, std::string text, double measured, double limit) {
  ok_ = false;
  add(parameter, std::max(rule.severity, Severity::Error), rule, std::move(text), measured, limit);
}

void TokenReader::remark_at(std::size_t parameter, const Rule& rule, std::string text, double measured, double limit) {
  add(parameter, rule.severity, rule, std::move(text), measured, limit);
}

void TokenReader::remark_at(std::size_t parameter, Severity severity, const Rule& rule, std::string text,
                            double measured, double limit) {
  add(parameter, severity, rule, std::move(text), measured, limit);
}

// Findings on single tokens go through these two, so that a megabyte of rubbish does not make a million of them.
void TokenReader::bad_token(const Rule& rule, std::string text) {
  ok_ = false;
  if (++token_findings_ <= most_findings) fault(rule, std::move(text));
}

void TokenReader::odd_token(Severity severity, const Rule& rule, std::string text) {
  if (++token_findings_ <= most_findings) remark_at(next_ - 1, severity, rule, std::move(text));
}

// The record has ended and there is no default: said once.
void TokenReader::missing(const char* wanted) {
  if (lost_) return;
  fault_at(next_, rules::too_few, fmt::format("the record ends before parameter {}, {}", next_, wanted));
  lost_ = true;
}

void TokenReader::lose(const Rule& rule, std::string text, double measured, double limit) {
  if (!lost_) fault(rule, std::move(text), measured, limit);
  lost_ = true;
}

void TokenReader::note(std::string canonical, const Token* given) {
  if (as_given_.notes.size() >= most_notes) return;
  as_given_.notes.push_back({canonical_, std::move(canonical), given ? field_of(*given) : Field{}, given == nullptr});
}

// --- reals ------------------------------------------------------------------------------------------------------

// Matters of style in a real that was read well: an integer in its place, a lower-case exponent. Once a record each.
void TokenReader::style(std::string_view text) {
  if (!integer_for_real_ && text.find('.') == text.npos && !has_any(text, "EeDd")) {
    integer_for_real_ = true;
    odd_token(Severity::Info, rules::real_expected,
              fmt::format("{} is written without a decimal point (said once for this record)", printable(text, 40)));
  }
  if (lower_case_) return;
  const std::string_view tail = text.substr(text.size() - std::min<std::size_t>(text.size(), 5));  // "e-308"
  if (std::none_of(tail.begin(), tail.end(), [](char c) { return c >= 'a'; })) return;
  lower_case_ = true;
  odd_token(Severity::Info, rules::letter_case,
            fmt::format("{} has a lower-case exponent letter (said once for this record)", printable(text, 40)));
}

double TokenReader::decode_real(const Token& token) {
  if (token.kind == Token::Kind::Text) {
    const NumberText<double> number = read_real(token.text);
    if (number) {
      style(token.text);
      return number.value;
    }
    return unread_real(token, number);
  }
  return unread_real(token, {});
}

// Why a token is no real, and what stands for it.
double TokenReader::unread_real(const Token& token, NumberText<double> number) {
  const std::string shown = printable(token.text, 40);
  if (token.kind == Token::Kind::Empty || number.fault == NumberFault::Empty) {
    odd_token(Severity::Warning, rules::too_few, "an empty field where a real has no default; read as 0");
    note(iges_real(0), &token);
  } else if (token.kind == Token::Kind::Hollerith) {
    bad_token(rules::real_expected, fmt::format("the string \"{}\" where a real is expected", shown));
  } else if (number.fault == NumberFault::Overflow) {
    bad_token(rules::real_range, fmt::format("{} is beyond the range of a double", shown));
  } else if (number.fault == NumberFault::Underflow) {
    odd_token(Severity::Warning, rules::real_range, fmt::format("{} is too small for a double; read as 0", shown));
    note(iges_real(number.value), &token);
  } else if (is_not_finite_word(token.text)) {
    bad_token(rules::nan_inf, fmt::format("{} is not a number", shown));
  } else if (has_digit(token.text)) {
    bad_token(rules::real_syntax, fmt::format("{} is not a well-formed real", shown));
  } else {
    bad_token(rules::real_expected, fmt::format("{} where a real is expected", shown));
  }
  return std::isfinite(number.value) ? number.value : 0;
}

double TokenReader::real() {
  const Token* token = next();
  if (token) return decode_real(*token);
  missing("a real");
  return 0;
}

double TokenReader::real_or(double fallback) {
  const Token* token = next();
  if (token && token->kind != Token::Kind::Empty) return decode_real(*token);
  note(iges_real(fallback), token);
  return fallback;
}

void TokenReader::reals(std::span<double> values) {
  for (double& value : values) value = real();
}

std::vector<double> TokenReader::reals(std::size_t count) {
  std::vector<double> values(count);
  reals(std::span<double>(values));
  return values;
}

Xyz TokenReader::xyz() {
  Xyz p;
  p.x = real();
  p.y = real();
  p.z = real();
  return p;
}

Xyz TokenReader::xyz_or(Xyz fallback) {
  Xyz p;
  p.x = real_or(fallback.x);
  p.y = real_or(fallback.y);
  p.z = real_or(fallback.z);
  return p;
}

// --- integers ---------------------------------------------------------------------------------------------------

std::int64_t TokenReader::decode_integer(const Token& token) {
  const NumberText<std::int64_t> number =
      token.kind == Token::Kind::Text ? read_integer(token.text) : NumberText<std::int64_t>{};
  if (token.kind == Token::Kind::Text && number) return number.value;

  return unread_integer(token, number.fault);
}

// Why a token is no integer, and what stands for it.
std::int64_t TokenReader::unread_integer(const Token& token, NumberFault fault) {
  const std::string shown = printable(token.text, 40);
  const NumberText<double> real = token.kind == Token::Kind::Text ? read_real(token.text) : NumberText<double>{};
  std::int64_t value = 0;
  if (token.kind == Token::Kind::Empty || fault == NumberFault::Empty) {
    odd_token(Severity::Warning, rules::too_few, "an empty field where an integer has no default; read as 0");
  } else if (token.kind == Token::Kind::Hollerith) {
    bad_token(rules::integer_expected, fmt::format("the string \"{}\" where an integer is expected", shown));
  } else if (fault == NumberFault::Overflow) {
    bad_token(rules::integer_range, fmt::format("{} needs more than 64 bits", shown));
  } else if (real && std::fabs(real.value) < 1e15 && real.value == std::floor(real.value)) {
    value = static_cast<std::int64_t>(real.value);
    odd_token(Severity::Warning, rules::integer_expected,
              fmt::format("the real {} where an integer is expected; read as {}", shown, value));
  } else {
    bad_token(rules::integer_expected, fmt::format("{} where an integer is expected", shown));
  }
  note(std::to_string(value), &token);
  return value;
}

std::int64_t TokenReader::integer() {
  const Token* token = next();
  if (token) return decode_integer(*token);
  missing("an integer");
  return 0;
}

std::int64_t TokenReader::integer_or(std::int64_t fallback) {
  const Token* token = next();
  if (token && token->kind != Token::Kind::Empty) return decode_integer(*token);
  note(std::to_string(fallback), token);
  return fallback;
}

int TokenReader::narrowed(std::int64_t value) {
  using Range = std::numeric_limits<std::int32_t>;
  if (value >= Range::min() && value <= Range::max()) return static_cast<int>(value);
  bad_token(rules::integer_range, fmt::format("{} needs more than 32 bits", value));
  return 0;
}

int TokenReader::small_integer() { return narrowed(integer()); }
int TokenReader::small_integer_or(int fallback) { return narrowed(integer_or(fallback)); }

bool TokenReader::truth(std::int64_t value, const Token* token) {
  if (value != 0 && value != 1) {
    odd_token(rules::logical_expected.severity, rules::logical_expected,
              fmt::format("{} where a logical is 0 or 1; read as 1", value));
    note("1", token);
  }
  return value != 0;
}

bool TokenReader::logical() {
  const Token* token = next();
  if (token) return truth(decode_integer(*token), token);
  missing("a logical");
  return false;
}

bool TokenReader::logical_or(bool fallback) {
  const Token* token = next();
  if (token && token->kind != Token::Kind::Empty) return truth(decode_integer(*token), token);
  note(fallback ? "1" : "0", token);
  return fallback;
}

// --- strings and whatever else -----------------------------------------------------------------------------------

std::string TokenReader::string_or(std::string fallback) {
  const Token* token = next();
  if (token && token->kind == Token::Kind::Hollerith) {
    if (token->text.empty()) note({}, token);  // "0H"
    const bool printing =
        std::all_of(token->text.begin(), token->text.end(), [](char c) { return c >= ' ' && c <= '~'; });
    if (!printing)
      odd_token(rules::string_bytes.severity, rules::string_bytes,
                fmt::format("\"{}\" holds bytes that are not printing ASCII", printable(token->text, 40)));
    return std::string(token->text);
  }
  if (token && token->kind == Token::Kind::Text) {
    std::string text(trimmed(token->text));
    odd_token(Severity::Warning, rules::hollerith, fmt::format("\"{}\" has no Hollerith count", printable(text, 40)));
    note(hollerith(text), token);
    return text;
  }
  if (!token || !fallback.empty()) note(hollerith(fallback), token);
  return fallback;
}

Field TokenReader::field() {
  const Token* token = next();
  if (token) return field_of(*token);
  missing("a value");
  return {};
}

// --- pointers ---------------------------------------------------------------------------------------------------

Ref TokenReader::signed_ref() {
  const std::int64_t value = integer_or(0);
  using Range = std::numeric_limits<std::int32_t>;
  if (value >= Range::min() && value <= Range::max()) return Ref{static_cast<std::int32_t>(value)};
  odd_token(Severity::Error, rules::dangling,
            fmt::format("pointer {}, which no directory can hold; read as none", value));
  note("0", &tokens_[next_ - 1]);
  return {};
}

Ref TokenReader::ref() {
  const Ref ref = signed_ref();
  if (!ref) return ref;
  if (ref.de < 0)
    odd_token(Severity::Error, rules::dangling, fmt::format("negative pointer {}", ref.de));
  else if (ref.de % 2 == 0)
    odd_token(Severity::Error, rules::even_pointer,
              fmt::format("pointer {} means the second card of a directory entry", ref.de));
  else if (!file_.find(ref))
    odd_token(Severity::Error, rules::dangling, fmt::format("pointer to D{}, which is not in the directory", ref.de));
  return ref;
}

std::vector<Ref> TokenReader::refs(std::size_t count) {
  std::vector<Ref> refs(count);
  for (Ref& r : refs) r = ref();
  return refs;
}

// --- counts -----------------------------------------------------------------------------------------------------

bool TokenReader::room(std::size_t tokens) {
  if (lost_) return false;
  if (tokens <= left() && tokens <= limits_.list_count) return true;
  const std::size_t limit = std::min(left(), limits_.list_count);
  lose(rules::count_over,
       tokens > left() ? fmt::format("{} more parameters are announced, {} are there", tokens, left())
                       : fmt::format("{} parameters are over the limit of {}", tokens, limit),
       static_cast<double>(tokens), static_cast<double>(limit));
  return false;
}

std::size_t TokenReader::count(std::size_t tokens_each, std::int64_t minimum) {
  const bool was_ok = std::exchange(ok_, true);
  const std::int64_t stated = integer();
  const bool read = std::exchange(ok_, ok_ && was_ok);
  if (!read) lost_ = true;
  if (lost_) return 0;

  minimum = std::max<std::int64_t>(minimum, 0);
  if (stated < minimum) {
    lose(rules::count_negative, fmt::format("the count is {}, at least {} is needed", stated, minimum),
         static_cast<double>(stated), static_cast<double>(minimum));
    return 0;
  }
  const auto groups = static_cast<std::size_t>(stated);
  const std::size_t fit = tokens_each > 0 ? left() / tokens_each : limits_.list_count;
  if (groups <= std::min(fit, limits_.list_count)) return groups;
  lose(rules::count_over,
       groups > fit ? fmt::format("the count is {}, but only {} fit in what follows", groups, fit)
                    : fmt::format("a list of {} is over the limit of {}", groups, limits_.list_count),
       static_cast<double>(groups), static_cast<double>(std::min(fit, limits_.list_count)));
  return 0;
}

// --- trailing groups --------------------------------------------------------------------------------------------

// Index after the group that starts at `at`, or 0 when there is no such group: its count is right and every pointer
// reaches an entity of one of `kinds`.
std::size_t TokenReader::group_end(std::size_t at, std::initializer_list<int> kinds) const {
  if (at >= tokens_.size()) return at;
  const auto integer_at = [&](std::size_t i) -> std::int64_t {
    if (tokens_[i].kind == Token::Kind::Empty) return 0;
    if (tokens_[i].kind == Token::Kind::Hollerith) return -1;
    const NumberText<std::int64_t> number = read_integer(tokens_[i].text);
    return number ? number.value : -1;
  };
  const std::int64_t members = integer_at(at);
  if (members < 0 || static_cast<std::uint64_t>(members) > tokens_.size() - at - 1) return 0;
  const std::size_t end = at + 1 + static_cast<std::size_t>(members);
  for (std::size_t i = at + 1; i < end; ++i) {
    const std::int64_t de = integer_at(i);
    if (de <= 0 || de > std::numeric_limits<std::int32_t>::max()) return 0;
    const DirectoryEntry* target = file_.find(Ref{static_cast<std::int32_t>(de)});
    if (!target || std::find(kinds.begin(), kinds.end(), target->type) == kinds.end()) return 0;
  }
  return end;
}

bool TokenReader::groups_fit(std::size_t at) const {
  const std::size_t middle = group_end(at, associativity_kinds);
  return middle != 0 && group_end(middle, property_kinds) == std::max(tokens_.size(), middle);
}

bool TokenReader::groups_start_after(std::size_t tokens) const {
  return left() >= tokens && !groups_fit(next_) && groups_fit(next_ + tokens);
}

void TokenReader::optional_tail(std::size_t tokens) {
  if (left() == 0 || !groups_fit(next_)) return;
  const bool fits_after = left() >= tokens && groups_fit(next_ + tokens);
  if (fits_after) {
    const bool only_zeros = std::all_of(tokens_.end() - static_cast<std::ptrdiff_t>(left()), tokens_.end(),
                                        [](const Token& t) { return t.kind == Token::Kind::Empty || t.text == "0"; });
    if (only_zeros) return;
    remark_at(next_, rules::boundary_ambiguous,
              fmt::format("parameter {} may start the optional end of the record or its pointer groups; the groups are "
                          "taken, because the pointers reach what they should",
                          next_));
  }
  absent_ = tokens;
}

std::vector<Ref> TokenReader::group(const char* name, std::initializer_list<int> kinds) {
  if (broken_groups_ > 0) {
    ++broken_groups_;
    return {};
  }
  const std::size_t start = next_;
  const Token* token = next();
  if (!token || token->kind == Token::Kind::Empty) {
    note("0", token);
    return {};
  }
  const NumberText<std::int64_t> members = read_integer(token->text);
  if (token->kind != Token::Kind::Text || !members || members.value < 0 ||
      static_cast<std::uint64_t>(members.value) > left()) {
    remark_at(start, rules::group_counts,
              fmt::format("\"{}\" is no count of {} pointers; {} parameters follow", printable(token->text, 40), name,
                          left()));
    next_ = start;
    --canonical_;
    broken_groups_ = 1;
    return {};
  }
  std::vector<Ref> group(static_cast<std::size_t>(members.value));
  for (Ref& member : group) {
    member = ref();
    const DirectoryEntry* target = file_.find(member);
    if (target && std::find(kinds.begin(), kinds.end(), target->type) == kinds.end())
      odd_token(rules::group_targets.severity, rules::group_targets,
                fmt::format("D{} in the {} group is of type {}", target->de, name, target->type));
  }
  return group;
}

TrailingGroups TokenReader::trailing_groups() {
  TrailingGroups groups;
  absent_ = 0;
  if (lost_) return groups;
  const bool own_parameters_ok = ok_;  // a bad group takes nothing from them
  groups.associativities = group("associativity", associativity_kinds);
  groups.properties = group("property", property_kinds);
  const bool anything_left = std::any_of(tokens_.end() - static_cast<std::ptrdiff_t>(left()), tokens_.end(),
                                         [](const Token& t) { return t.kind != Token::Kind::Empty; });
  if (broken_groups_ == 0 && anything_left)
    remark_at(next_, rules::too_many, fmt::format("{} parameters are left after the two pointer groups", left()));
  ok_ = own_parameters_ok;
  return groups;
}

// What is still unread here is what trailing_groups() could not make groups of: it stands for their counts and beyond.
AsGiven TokenReader::as_given() {
  as_given_.canonical_count = canonical_ + broken_groups_;
  while (left() > 0 && !lost_) {
    const Token* token = next();
    note(canonical_ <= as_given_.canonical_count ? "0" : "", token);
  }
  while (canonical_ < as_given_.canonical_count) {
    ++canonical_;
    note("0", nullptr);
  }
  return std::move(as_given_);
}

// --- writing ----------------------------------------------------------------------------------------------------

void TokenWriter::real(double value) {
  append_iges_real(text_, value);
  end();
}

void TokenWriter::reals(std::span<const double> values) {
  ends_.reserve(ends_.size() + values.size());
  for (double value : values) real(value);
}

void TokenWriter::xyz(const Xyz& value) {
  real(value.x);
  real(value.y);
  real(value.z);
}

void TokenWriter::integer(std::int64_t value) {
  text_ += std::to_string(value);
  end();
}

void TokenWriter::count(std::size_t value) { integer(static_cast<std::int64_t>(value)); }
void TokenWriter::logical(bool value) { integer(value ? 1 : 0); }

void TokenWriter::string(const std::string& value) {
  text_ += hollerith(value);
  end();
}

void TokenWriter::ref(Ref value) { integer(value.de); }

void TokenWriter::refs(const std::vector<Ref>& values) {
  for (Ref value : values) ref(value);
}

void TokenWriter::empty() { end(); }

void TokenWriter::field(const Field& value) {
  text_ += text_of(value);
  end();
}

void TokenWriter::trailing_groups(const TrailingGroups& groups) {
  count(groups.associativities.size());
  refs(groups.associativities);
  count(groups.properties.size());
  refs(groups.properties);
}

std::vector<std::string> TokenWriter::tokens() const {
  std::vector<std::string> out;
  out.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) out.emplace_back((*this)[i]);
  return out;
}

}  // namespace trimloop::iges
